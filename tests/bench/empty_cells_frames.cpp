#include "plume/tests/bench/empty_cells_frames.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <functional>
#include <utility>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/make_tiles.h"
#include "plume/lib/plume.h"
#include "plume/lib/search_choice.h"
#include "plume/lib/tiles.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/picture_error.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

enum class Way { search, walk, packets };

// Whether it pays or not.
RenderResult make(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                  Way way) {
  RenderResult result;
  Frame frame(scene, camera, settings);
  const Integrator integrator = make_integrator(scene.transfer_function(), settings.integrator);
  const auto pieces = pieces_for_packets(frame);
  const auto maker = way == Way::search ? searched_tiles(frame, integrator)
                     : way == Way::walk ? volume_tiles(frame, integrator)
                                        : packet_tiles(frame, integrator, *pieces);
  make_tiles(frame, *maker, {}, result.statistics);
  result.image = std::move(frame.image());
  return result;
}

// Visible half way between the least and the greatest value, and `width` of the range around.
TransferFunction around_middle(const ScalarField& field, float width) {
  const float range = field.high - field.low, middle = field.low + 0.5f * range;
  TransferFunction function;
  function.knots = {{middle - 0.5f * width * range, {0, {1, 0, 0}}},
                    {middle, {20, {1, 0.5f, 0}}},
                    {middle + 0.5f * width * range, {0, {0, 0, 1}}}};
  return function;
}

bool compare_ways(const Mesh& mesh, const char* what, const HierarchyFrameOptions& options) {
  Scene scene(mesh);
  fmt::print("{} {}\n{:<22}{:>9}{:>9}{:>11}{:>11}{:>9}{:>11}{:>9}{:>10}\n", scene.cell_count(),
             what, "seen of the range", "cells", "visited", "hierarchy", "walker", "ratio", "packets",
             "ratio", "declined");
  bool good = true;
  for (const float width : {0.3f, 0.1f, 0.03f, 0.01f, 0.003f, 0.001f}) {
    scene.set_transfer_function(around_middle(scene.field(), width));
    const double share = visible_share(scene, visible_windows(scene.classification()));
    for (const char* view : {"+x", "iso"}) {
      const Camera camera = named_view(view, scene.bounds());
      RenderSettings settings;
      settings.width = settings.height = options.size;
      const RenderResult ours = make(scene, camera, settings, Way::search);
      const RenderResult twin = make(scene, camera, settings, Way::walk);
      const RenderResult packed = make(scene, camera, settings, Way::packets);
      good = good && ours.image.rgba == twin.image.rgba &&
             picture_error(packed.image, ours.image).largest < 4e-5;
      auto frame_of = [&](Way way) { return [&, way] { make(scene, camera, settings, way); }; };
      const std::vector<std::function<void()>> tasks{frame_of(Way::search), frame_of(Way::walk),
                                                     frame_of(Way::packets)};
      const auto seconds = take_turns(tasks, options.rounds);
      const double search = median(seconds[0]), walk = median(seconds[1]);
      const double packets = median(seconds[2]);
      fmt::print("{:<22}{:>8.2f}%{:>8.2f}%{:>11.1f}{:>11.1f}{:>9.1f}{:>11.1f}{:>9.2f}{:>10}\n",
                 fmt::format("{:g}, {}", width, view), 100 * share,
                 100 * static_cast<double>(ours.statistics.cells_visited) /
                     static_cast<double>(twin.statistics.cells_visited),
                 1e3 * search, 1e3 * walk, walk / search, 1e3 * packets, packets / search,
                 settings.width * settings.height - static_cast<long>(ours.statistics.rays_searched));
      std::fflush(stdout);
    }
  }
  if (!good) std::fputs("plume_frame_bench: the pictures differ\n", stderr);
  return good;
}

}  // namespace

bool compare_empty_cells(const HierarchyFrameOptions& options) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  fmt::print(
      "\nVolumes of which little is seen, {0} x {0} pixels, one thread; milliseconds on the "
      "processor, medians of {1} frames in turns\n",
      options.size, options.rounds);
  bool good =
      compare_ways(generate("box-tetrahedra", {options.cells, 0.2, 1}), "tetrahedra", options);
  good = compare_ways(generate("box-hexahedra", {options.cells, 0.2, 1}), "hexahedra of a grid",
                      options) &&
         good;
  return compare_ways(generate("box-mixed", {options.cells / 2, 0.2, 1}), "cells of all kinds",
                      options) &&
         good;
}

}  // namespace plume::bench
