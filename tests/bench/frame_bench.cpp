// Whole frames: plume_frame_bench. See --help.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "plume/mesh/error.h"
#include "plume/tests/bench/empty_cells_frames.h"
#include "plume/tests/bench/empty_space_frames.h"
#include "plume/tests/bench/hexahedra_frames.h"
#include "plume/tests/bench/hierarchy_frames.h"
#include "plume/tests/bench/interval_frames.h"
#include "plume/tests/bench/mode_frames.h"
#include "plume/tests/bench/peer_frames.h"
#include "plume/tests/bench/thread_scaling.h"
#include "plume/tests/bench/tolerance_frames.h"

namespace {

constexpr const char* kHelp = R"(plume_frame_bench: whole frames, from the rays to the picture

  --peers          against VTK's ray caster, with each of its integrators, on one thread
  --threads        two threads against one
  --hexahedra      the blunt fin as hexahedra against tetrahedra; orders 1, 2 and 3
  --modes          the modes that show one number a ray, by packets against one by one
  --intervals      two intervals and an isosurface added to a volume against the volume alone;
                   split in data space against the paper's tables
  --tolerance      what is asked for, what the planner chooses, and what that comes to, in all modes
  --hierarchy      an opaque isosurface through the hierarchy of cells against walking to it, of
                   10 million tetrahedra, hexahedra and mixed cells; volumes of which little is
                   seen: only where it is asked for
  --empty-space    passing over what is not seen of a rectilinear grid against walking through it:
                   only where it is asked for
                   all but these two where none is asked for
  --rounds=N       how many frames each (5, with two threads 7); medians are reported
  --cells=N        of the hierarchy's boxes (118) and of the rectilinear grid (256), along each side
  --size=N         pixels along each side (512, with two threads 1024)
  --pictures=DIR   writes the pictures that are compared with VTK's, as PNG files
The blunt fin is read from the directory PLUME_DATASETS, by default ../shared/datasets.
)";

// False where the argument is not `name` and a number.
bool take(const std::string& argument, const std::string& name, int& value) {
  if (argument.rfind(name, 0) != 0) return false;
  value = std::atoi(argument.c_str() + name.size());
  return value > 0;
}

}  // namespace

int main(int argc, char** argv) {
  bool peers = false, threads = false, hexahedra = false, intervals = false, tolerance = false;
  bool hierarchy = false, empty_space = false, modes = false;
  int rounds = 0, size = 0, cells = 0;
  std::string pictures;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--peers")
      peers = true;
    else if (argument == "--threads")
      threads = true;
    else if (argument == "--hexahedra")
      hexahedra = true;
    else if (argument == "--modes")
      modes = true;
    else if (argument == "--hierarchy")
      hierarchy = true;
    else if (argument == "--empty-space")
      empty_space = true;
    else if (argument == "--intervals")
      intervals = true;
    else if (argument == "--tolerance")
      tolerance = true;
    else if (argument.rfind("--pictures=", 0) == 0)
      pictures = argument.substr(11);
    else if (!take(argument, "--rounds=", rounds) && !take(argument, "--size=", size) &&
             !take(argument, "--cells=", cells)) {
      std::fputs(kHelp, argument == "--help" ? stdout : stderr);
      return argument == "--help" ? 0 : 2;
    }
  }
  if (!peers && !threads && !hexahedra && !intervals && !tolerance && !hierarchy && !empty_space &&
      !modes)
    peers = threads = hexahedra = intervals = tolerance = modes = true;
  plume::bench::PeerFrameOptions peer_options;
  plume::bench::HexahedraFrameOptions hexahedra_options;
  plume::bench::IntervalFrameOptions interval_options;
  plume::bench::ModeFrameOptions mode_options;
  plume::bench::ThreadScalingOptions thread_options;
  plume::bench::HierarchyFrameOptions hierarchy_options;
  plume::bench::EmptySpaceOptions empty_options;
  peer_options.pictures = pictures;
  if (rounds > 0)
    peer_options.rounds = thread_options.rounds = hexahedra_options.rounds =
        interval_options.rounds = mode_options.rounds = hierarchy_options.rounds =
            empty_options.rounds = rounds;
  if (size > 0)
    peer_options.size = thread_options.size = hexahedra_options.size = interval_options.size =
        mode_options.size = hierarchy_options.size = empty_options.size = size;
  if (cells > 0) hierarchy_options.cells = empty_options.cells = cells;
  try {
    bool good = true;
    if (peers) good = plume::bench::compare_peer_frames(peer_options) && good;
    if (threads) good = plume::bench::compare_threads(thread_options) && good;
    if (hexahedra) {
      good = plume::bench::compare_with_tetrahedra(hexahedra_options) && good;
      good = plume::bench::compare_orders(hexahedra_options) && good;
    }
    if (modes) good = plume::bench::compare_modes(mode_options) && good;
    if (hierarchy) good = plume::bench::compare_isosurfaces(hierarchy_options) && good;
    if (hierarchy) good = plume::bench::compare_empty_cells(hierarchy_options) && good;
    if (empty_space) good = plume::bench::compare_empty_space(empty_options) && good;
    if (intervals) {
      good = plume::bench::compare_with_volume_alone(interval_options) && good;
      plume::bench::compare_ways(interval_options);
    }
    if (tolerance)
      good = plume::bench::check_tolerances(size > 0 ? size : 256, rounds > 0 ? rounds : 3) && good;
    return good ? 0 : 1;
  } catch (const plume::Error& error) {
    std::fprintf(stderr, "plume_frame_bench: %s\n", error.what());
    return 1;
  }
}
