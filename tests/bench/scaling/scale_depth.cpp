// Cost against what lies behind each other along a ray: cells, and parts of the mesh.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plume/datasets/grid.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/scaling/scaling_frames.h"
#include "plume/tests/bench/scaling/scaling_series.h"

namespace plume::bench {
namespace {

// A cube of so many layers of hexahedra along x, with `across` along y and z.
Mesh layered_cube(int layers, int across) {
  const datasets::Box box{{layers, across, across}, {0, 0, 0}, {1, 1, 1}};
  std::vector<float> points;
  datasets::append_box_points(box, 0.2, 1, points);
  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.dimensions = {layers + 1, across + 1, across + 1};
  datasets::add_box_fields(mesh);
  return mesh;
}

// A cube of size^3 cuboids of six tetrahedra each, in so many slabs along x with gaps between; they
// divide its size.
Mesh sliced_cube(int slabs, int size) {
  std::vector<float> points;
  std::vector<std::int32_t> connectivity;
  for (int s = 0; s < slabs; ++s) {
    const datasets::Box box{{size / slabs, size, size},
                            {static_cast<double>(s) / slabs, 0, 0},
                            {(s + 0.8) / slabs, 1, 1}};
    const auto first = static_cast<std::int32_t>(points.size() / 3);
    datasets::append_box_points(box, 0.2, static_cast<std::uint64_t>(s), points);
    datasets::for_each_cuboid(box, [&](int i, int j, int k) {
      auto corners = box.corners(i, j, k);
      for (std::int32_t& corner : corners) corner += first;
      datasets::append_kuhn_tetrahedra(corners, connectivity);
    });
  }
  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.cells = datasets::cells_of(CellType::tetrahedron, std::move(connectivity));
  datasets::add_box_fields(mesh);
  return mesh;
}

struct Subject {
  std::vector<std::unique_ptr<Scene>> scenes;
  std::vector<ScalingFrame> frames;

  void add(const Mesh& mesh, int size) {
    scenes.push_back(std::make_unique<Scene>(mesh));
    Scene& scene = *scenes.back();
    scene.set_transfer_function(seven_knots(scene));
    frames.push_back(iso_frame(scene, size));
    frames.back().camera = named_view("+x", scene.bounds());
    orbit(frames.back().camera, 3, 2);
  }
};

}  // namespace

void scale_depth(const ScalingOptions& options, const SeriesMade& made) {
  const int pixels = options.quick ? 32 : 512, size = options.quick ? 4 : 32;
  for (const bool hexahedra : {false, true}) {
    Subject subject;
    for (int layers = options.quick ? 2 : 8; layers <= (options.quick ? 8 : 512); layers *= 2) {
      const Mesh grid = layered_cube(layers, size);
      subject.add(hexahedra ? grid : cut_into_tetrahedra(grid), pixels);
    }
    ScalingSeries series{"depth",
                         hexahedra ? "layers of hexahedra" : "layers of tetrahedra",
                         "cells a ray",
                         {"frame, ms", "ns a cell met"},
                         {}};
    for (const FrameCost& cost : frame_costs(subject.frames, options.rounds))
      series.points.push_back({cost.cells_per_ray, {1e3 * cost.seconds, cost.ns_per_cell()}});
    made(series);
  }
  Subject subject;
  for (int slabs = 1; slabs <= size; slabs *= 2) subject.add(sliced_cube(slabs, size), pixels);
  ScalingSeries series{"depth",
                       "slabs of tetrahedra, " + std::to_string(6 * size * size * size) + " in all",
                       "ways in a ray",
                       {"cells a ray", "frame, ms", "ns a cell met"},
                       {}};
  for (const FrameCost& cost : frame_costs(subject.frames, options.rounds))
    series.points.push_back(
        {cost.entries_per_ray, {cost.cells_per_ray, 1e3 * cost.seconds, cost.ns_per_cell()}});
  made(series);
}

}  // namespace plume::bench
