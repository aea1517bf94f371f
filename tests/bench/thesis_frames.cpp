// Frames a second of the thesis' two grids, beside what it reports.

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <functional>
#include <optional>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/mesh/validate.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/hexahedra_frames.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/timing.h"
#include "plume/traverse/boundary.h"

namespace plume::bench {
namespace {

// G. Marmitt, "Interactive Volume Ray Tracing" (2008): frames a second on one core.
struct Thesis {
  const char* mesh;
  int size;
  double iso_plucker, iso_hybrid;    // table 6.6, and 6.10 for the hybrid
  double semi_plucker, semi_hybrid;  // table 6.7, and 6.10 for the hybrid
  double initial, mip;               // table 6.10
};
constexpr Thesis kThesis[] = {{"blunt-fin", 512, 0.97, 1.20, 0.78, 1.01, 14.23, 1.23},
                              {"blunt-fin", 1024, 0.24, 0.31, 0.19, 0.25, 3.89, 0.31},
                              {"combustor", 512, 1.24, 1.34, 1.60, 1.77, 9.36, 0.70},
                              {"combustor", 1024, 0.31, 0.34, 0.41, 0.45, 2.60, 0.17}};

// The first hits of all rays of a picture.
class FirstHits {
 public:
  explicit FirstHits(const Mesh& mesh)
      : grid_(make_walkable_grid(mesh, select_field(mesh), check_structure(mesh))),
        boundary_(grid_) {}

  void find(const Camera& camera, int size) {
    const PixelRays rays(camera, size, size);
    for (int y = 0; y < size; y += kTile)
      for (int x = 0; x < size; x += kTile) {
        frame_at_.clear();
        list_at_.clear();
        for (int i = 0; i < kTile * kTile; ++i) {
          const auto at = static_cast<std::size_t>(i);
          lists_[at].clear();
          if (!frames_[at].set(rays(x + i % kTile + 0.5, y + i / kTile + 0.5), grid_.frame))
            continue;
          frame_at_.push_back(&frames_[at]);
          list_at_.push_back(&lists_[at]);
        }
        boundary_.first_entries(frame_at_, list_at_);
      }
  }

 private:
  static constexpr int kTile = 16;
  const WalkableGrid grid_;
  const BoundaryIndex<GridWalker> boundary_;
  std::array<ShearedFrame, kTile * kTile> frames_;
  std::array<EntryList, kTile * kTile> lists_;
  std::vector<const ShearedFrame*> frame_at_;
  std::vector<EntryList*> list_at_;
};

void compare_on(const Mesh& mesh, const Thesis& thesis, int size, int rounds) {
  Scene scene(mesh);
  scene.set_transfer_function(seven_knots(scene));
  FirstHits first_hits(mesh);
  RenderSettings volume;
  volume.width = volume.height = size;
  volume.threads = 1;
  RenderSettings twin = volume, maximum = volume;
  twin.scalar_twin = true;
  maximum.mode = plume::Mode::maximum;

  std::array<double, 4> fps{};  // the mean of four views, as the thesis has it
  const auto views = frame_cameras(scene.bounds());
  for (std::size_t v = 0; v < 4; ++v) {
    const Camera& camera = views[v].camera;
    const std::vector<std::function<void()>> tasks{
        [&] { first_hits.find(camera, size); }, [&] { render(scene, camera, volume); },
        [&] { render(scene, camera, twin); }, [&] { render(scene, camera, maximum); }};
    const auto seconds = take_turns(tasks, rounds);
    for (std::size_t i = 0; i < fps.size(); ++i) fps[i] += 0.25 / median(seconds[i]);
  }
  fmt::print(
      "{:<11}{:>6}{:>9.2f}{:>8.1f}{:>12.2f}{:>8.2f}{:>9.2f}{:>8.2f}{:>10.2f}{:>8.2f}{:>12.2f}"
      "{:>8.2f}\n",
      thesis.mesh, size, thesis.initial, fps[0], thesis.semi_plucker, thesis.semi_hybrid, fps[2],
      fps[1], thesis.mip, fps[3], thesis.iso_plucker, thesis.iso_hybrid);
  std::fflush(stdout);
}

}  // namespace

void compare_with_thesis_frames(const HexahedraFrameOptions& options) {
  fmt::print(
      "\nFrames a second, first hits included, one thread here, one core of a 2 GHz Opteron 870 in "
      "the thesis\n(tables 6.6, 6.7, 6.10; P: Plücker, H: hybrid); the mean of four views, medians "
      "of {} frames.\nRatios between its hardware and this are no measure of the method. Early "
      "termination: at 1e-4 here, \"if the\naccumulated intensity reaches one\" there. There is no "
      "isosurface in render().\n\n",
      options.rounds);
  if (options.size != 512)
    fmt::print("(The thesis' pictures are {} times as wide.)\n\n", 512.0 / options.size);
  fmt::print("{:<17}{:>17}{:>37}{:>18}{:>20}\n", "", "initial", "semi-transparent", "maximum",
             "isosurface");
  fmt::print("{:<11}{:>6}{:>9}{:>8}{:>12}{:>8}{:>9}{:>8}{:>10}{:>8}{:>12}{:>8}\n", "grid", "size",
             "thesis", "here", "thesis: P", "H", "scalar", "packets", "thesis: H", "scalar",
             "thesis: P", "H");
  for (const MeshSource& source : mesh_sources(Family::hexahedra)) {
    if (source.name == "twisted") continue;
    const std::optional<Mesh> mesh = source.load();
    if (!mesh) continue;
    for (const Thesis& thesis : kThesis)
      if (source.name == thesis.mesh)
        compare_on(*mesh, thesis, thesis.size * options.size / 512, options.rounds);
  }
}

}  // namespace plume::bench
