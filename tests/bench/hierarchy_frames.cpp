#include "plume/tests/bench/hierarchy_frames.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <functional>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/mesh/validate.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

// Times what a scene takes to be made walkable, and its hierarchy; each round anew.
void compare_builds(const Mesh& mesh, int rounds) {
  const ScalarField field = select_field(mesh);
  const Bounds bounds = check_structure(mesh);
  std::vector<double> walkable, hierarchy, ratios;
  double bytes = 0;
  for (int round = 0; round < rounds; ++round) {
    const double start = thread_seconds();
    const WalkableTets tets = make_walkable_tets(mesh, field, bounds, false);
    const double between = thread_seconds();
    const CellHierarchy made = make_cell_hierarchy(tets);
    hierarchy.push_back(thread_seconds() - between);
    walkable.push_back(between - start);
    ratios.push_back(hierarchy.back() / walkable.back());
    bytes = static_cast<double>(made.bytes()) / static_cast<double>(tets.cell_count());
  }
  fmt::print("walkable form {:.2f} s, hierarchy {:.2f} s: {:.2f} of it; {:.2f} bytes a cell\n\n",
             median(walkable), median(hierarchy), median(ratios), bytes);
}

// An opaque isosurface half way between the least and the greatest value: through the hierarchy,
// ray by ray, and by packets. Packets are made to make it by a volume beside it that shows nothing,
// but has too much extinction everywhere to be passed over.
bool compare_ways(const Mesh& mesh, const char* what, const HierarchyFrameOptions& options) {
  Scene scene(mesh);
  const float value = 0.5f * (scene.field().low + scene.field().high);
  Classification alone;
  alone.isosurfaces.push_back({value, 1, {1, 1, 1}});
  Classification beside_nothing = alone;
  beside_nothing.volume = scene.transfer_function();
  for (auto& knot : beside_nothing.volume->knots) knot.optics.extinction = 1e-20f;
  fmt::print("{} {}\n{:<14}{:>11}{:>11}{:>9}{:>11}{:>9}{:>11}{:>11}\n", scene.cell_count(), what,
             "view", "hierarchy", "walker", "ratio", "packets", "ratio", "rays hit", "declined");
  bool same = true;
  for (const NamedCamera& view : frame_cameras(scene.bounds())) {
    RenderSettings searched;
    searched.width = searched.height = options.size;
    searched.threads = 1;
    // The channel keeps packets from what they would do.
    RenderSettings by_hierarchy = searched;
    by_hierarchy.channels = {"depth"};
    RenderSettings walked = by_hierarchy;
    walked.scalar_twin = true;
    scene.set_classification(alone);
    const RenderResult ours = render(scene, view.camera, by_hierarchy);
    const RenderResult twin = render(scene, view.camera, walked);
    same = same && ours.image.rgba == twin.image.rgba &&
           ours.image.channels[0].values == twin.image.channels[0].values;
    auto frame_of = [&](const Classification& classification, const RenderSettings& settings) {
      return [&] {
        scene.set_classification(classification);
        render(scene, view.camera, settings);
      };
    };
    const std::vector<std::function<void()>> tasks{
        frame_of(alone, by_hierarchy), frame_of(alone, walked), frame_of(beside_nothing, searched)};
    const auto seconds = take_turns(tasks, options.rounds);
    const double hierarchy = median(seconds[0]), walker = median(seconds[1]);
    const double packets = median(seconds[2]);
    fmt::print("{:<14}{:>11.1f}{:>11.1f}{:>9.1f}{:>11.1f}{:>9.1f}{:>11}{:>11}\n", view.name,
               1e3 * hierarchy, 1e3 * walker, walker / hierarchy, 1e3 * packets,
               packets / hierarchy, ours.statistics.surfaces,
               ours.statistics.rays - ours.statistics.rays_searched);
    std::fflush(stdout);
  }
  if (!same) std::fputs("plume_frame_bench: the pictures differ\n", stderr);
  return same;
}

}  // namespace

bool compare_isosurfaces(const HierarchyFrameOptions& options) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  fmt::print(
      "\nAn opaque isosurface, {0} x {0} pixels, one thread; milliseconds on the processor, "
      "medians "
      "of {1} frames in turns\n",
      options.size, options.rounds);
  const Mesh tetrahedra = generate("box-tetrahedra", {options.cells, 0.2, 1});
  compare_builds(tetrahedra, options.rounds);
  bool same = compare_ways(tetrahedra, "tetrahedra", options);
  same = compare_ways(generate("box-hexahedra", {options.cells, 0.2, 1}), "hexahedra of a grid",
                      options) &&
         same;
  return compare_ways(generate("box-mixed", {options.cells / 2, 0.2, 1}), "cells of all kinds",
                      options) &&
         same;
}

}  // namespace plume::bench
