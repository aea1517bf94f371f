#include "plume/tests/bench/hexahedra_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <optional>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/picture_error.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

constexpr double kAim = 1.3;
// Of linear RGBA, RMS: a cut hexahedron's scalar is another one between its corners.
constexpr double kSameThing = 0.02;

}  // namespace

bool compare_with_tetrahedra(const HexahedraFrameOptions& options) {
  const std::optional<Mesh> grid = mesh_sources(Family::hexahedra).front().load();
  if (!grid) return true;
  Scene hexahedra(*grid), tetrahedra(cut_into_tetrahedra(*grid));
  hexahedra.set_transfer_function(seven_knots(hexahedra));
  tetrahedra.set_transfer_function(hexahedra.transfer_function());
  RenderSettings settings;
  settings.width = settings.height = options.size;
  settings.threads = 1;
  settings.early_termination = 0;

  fmt::print(
      "\nThe blunt fin as {0} hexahedra and as {1} tetrahedra, {2} x {2} pixels, order 1, one "
      "thread;\nmilliseconds on the processor, medians of {3} frames in turns. Range: of the "
      "ratio from round to round.\nRMS: of linear, premultiplied RGBA from one to the other.\n\n",
      hexahedra.cell_count(), tetrahedra.cell_count(), options.size, options.rounds);
  fmt::print("{:<14}{:>11}{:>11}{:>9}{:>16}{:>10}\n", "view", "hexahedra", "tetrahedra", "ratio",
             "range", "RMS");
  bool same = true;
  double sums[2] = {0, 0};
  for (const NamedCamera& view : frame_cameras(hexahedra.bounds())) {
    auto picture = [&](const Scene& scene) { return render(scene, view.camera, settings).image; };
    const double rms = picture_error(picture(hexahedra), picture(tetrahedra)).rms;
    same = same && rms < kSameThing;
    const std::vector<std::function<void()>> tasks{[&] { picture(hexahedra); },
                                                   [&] { picture(tetrahedra); }};
    const auto seconds = take_turns(tasks, options.rounds);
    std::vector<double> ratios;
    for (std::size_t round = 0; round < seconds[0].size(); ++round)
      ratios.push_back(seconds[1][round] / seconds[0][round]);
    const double ours = median(seconds[0]), theirs = median(seconds[1]);
    sums[0] += ours;
    sums[1] += theirs;
    fmt::print("{:<14}{:>11.1f}{:>11.1f}{:>9.2f}{:>16}{:>10.1e}\n", view.name, 1e3 * ours,
               1e3 * theirs, theirs / ours,
               fmt::format("{:.2f} to {:.2f}", *std::min_element(ratios.begin(), ratios.end()),
                           *std::max_element(ratios.begin(), ratios.end())),
               rms);
  }
  fmt::print("{:<14}{:>11.1f}{:>11.1f}{:>9.2f}   (aimed at: {})\n", "all", 1e3 * sums[0],
             1e3 * sums[1], sums[1] / sums[0], kAim);
  std::fflush(stdout);
  if (!same)
    std::fputs("plume_frame_bench: hexahedra and tetrahedra are not of the same thing\n", stderr);
  return same;
}

}  // namespace plume::bench
