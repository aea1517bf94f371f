#include "plume/tests/bench/hierarchy_frames.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/mesh/validate.h"
#include "plume/tests/bench/bench_views.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/packet_walker.h"
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

// Pixels along a Z-curve, so that rays that share packets are neighbours.
void for_each_along_curve(int size, const std::function<void(int, int)>& visit) {
  int whole = 1;
  while (whole < size) whole *= 2;
  for (std::uint32_t place = 0; place < static_cast<std::uint32_t>(whole * whole); ++place) {
    int x = 0, y = 0;
    for (int bit = 0; bit < 15; ++bit) {
      x |= static_cast<int>(place >> (2 * bit) & 1) << bit;
      y |= static_cast<int>(place >> (2 * bit + 1) & 1) << bit;
    }
    if (x < size && y < size) visit(x, y);
  }
}

}  // namespace

bool compare_isosurfaces(const HierarchyFrameOptions& options) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Mesh mesh = generate("box-tetrahedra", {options.cells, 0.2, 1});
  Scene scene(mesh);
  const float value = 0.5f * (scene.field().low + scene.field().high);
  Classification classification;
  classification.isosurfaces.push_back({value, 1, {1, 1, 1}});
  scene.set_classification(classification);
  fmt::print(
      "\nAn opaque isosurface of {0} tetrahedra, {1} x {1} pixels, one thread; milliseconds on the "
      "processor,\nmedians of {2} frames in turns\n",
      scene.cell_count(), options.size, options.rounds);
  compare_builds(mesh, options.rounds);

  // What packets read.
  BenchMesh bench;
  bench.bounds = scene.bounds();
  bench.tets = make_walkable_tets(mesh, select_field(mesh), bench.bounds, false);
  bench.optics = BenchOptics(value, scene.field().low, scene.field().high, 1);
  const BoundaryIndex<TetWalker> boundary(bench.tets);

  fmt::print("{:<14}{:>11}{:>11}{:>9}{:>13}{:>9}{:>11}{:>11}\n", "view", "hierarchy", "walker",
             "ratio", "packets", "ratio", "rays hit", "declined");
  bool same = true;
  for (const NamedCamera& view : frame_cameras(scene.bounds())) {
    RenderSettings searched;
    searched.width = searched.height = options.size;
    searched.threads = 1;
    RenderSettings walked = searched;
    walked.scalar_twin = true;
    const RenderResult ours = render(scene, view.camera, searched);
    same = same && ours.image.rgba == render(scene, view.camera, walked).image.rgba;
    const PixelRays pixel_rays(view.camera, options.size, options.size);
    std::vector<Ray> rays;
    for_each_along_curve(options.size,
                         [&](int x, int y) { rays.push_back(pixel_rays(x + 0.5, y + 0.5)); });
    const BenchView passages = make_view(bench, boundary, view.name, rays);
    std::vector<PassageSum> sums(passages.passages.size());
    const std::vector<std::function<void()>> tasks{
        [&] { render(scene, view.camera, searched); }, [&] { render(scene, view.camera, walked); },
        [&] { walk_packet_passages(bench, passages, bench::Mode::isosurface, sums); }};
    const auto seconds = take_turns(tasks, options.rounds);
    const double hierarchy = median(seconds[0]), walker = median(seconds[1]);
    const double packets = median(seconds[2]);
    fmt::print("{:<14}{:>11.1f}{:>11.1f}{:>9.1f}{:>13.1f}{:>9.1f}{:>11}{:>11}\n", view.name,
               1e3 * hierarchy, 1e3 * walker, walker / hierarchy, 1e3 * packets,
               packets / hierarchy, ours.statistics.surfaces,
               ours.statistics.rays - ours.statistics.rays_searched);
    std::fflush(stdout);
  }
  if (!same) std::fputs("plume_frame_bench: the pictures differ\n", stderr);
  return same;
}

}  // namespace plume::bench
