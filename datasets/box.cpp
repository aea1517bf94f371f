#include <algorithm>

#include "plume/datasets/families.h"
#include "plume/datasets/grid.h"

namespace plume::datasets {

Mesh box_tetrahedra(const GenerateOptions& options) {
  const int size = size_or(options, 32);
  Mesh mesh;
  mesh.points = Array::own(unit_box_points(size, options));

  const Box box = Box::unit(size);
  const auto n = static_cast<std::size_t>(size);
  std::vector<std::int32_t> connectivity;
  connectivity.reserve(24 * n * n * n);
  for_each_cuboid(box, [&](int i, int j, int k) {
    append_kuhn_tetrahedra(box.corners(i, j, k), connectivity);
  });
  mesh.cells = cells_of(CellType::tetrahedron, std::move(connectivity));
  add_box_fields(mesh);
  add_cell_radius(mesh);
  return mesh;
}

Mesh box_hexahedra(const GenerateOptions& options) {
  const int size = size_or(options, 32);
  Mesh mesh;
  mesh.points = Array::own(unit_box_points(size, options));
  mesh.dimensions = {size + 1, size + 1, size + 1};
  add_box_fields(mesh);
  add_cell_radius(mesh);
  return mesh;
}

Mesh box_rectilinear(const GenerateOptions& options) {
  const int size = size_or(options, 32);
  require_int32_ids(std::pow(size + 1.0, 3), size);
  const double jitter = std::min(options.jitter, 0.45);
  Mesh mesh;
  mesh.dimensions = {size + 1, size + 1, size + 1};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (int i = 0; i <= size; ++i) {
      const bool inside = i > 0 && i < size;
      const double moved =
          inside && jitter > 0
              ? jitter * random_offset(options.seed, static_cast<std::uint64_t>(i), axis)
              : 0;
      along.push_back((i + moved) / size);
    }
    mesh.axes[static_cast<std::size_t>(axis)] = Array::own(std::move(along));
  }
  add_box_fields(mesh);
  std::vector<float> radius;
  for_each_cuboid(Box::unit(size), [&](int i, int j, int k) {
    Point middle;
    const int index[3] = {i, j, k};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto at = static_cast<std::size_t>(index[a]);
      middle[a] = 0.5 * (mesh.axes[a].at<double>(at) + mesh.axes[a].at<double>(at + 1));
    }
    radius.push_back(static_cast<float>(distance(middle, {0.5, 0.5, 0.5})));
  });
  mesh.fields.push_back({"cell_radius", Association::cell, 1, Array::own(std::move(radius))});
  return mesh;
}

Mesh box_wedges(const GenerateOptions& options) {
  const int size = size_or(options, 24);
  Mesh mesh;
  mesh.points = Array::own(unit_box_points(size, options));

  const Box box = Box::unit(size);
  std::vector<std::int32_t> connectivity;
  for_each_cuboid(box,
                  [&](int i, int j, int k) { append_wedges(box.corners(i, j, k), connectivity); });
  mesh.cells = cells_of(CellType::wedge, std::move(connectivity));
  add_box_fields(mesh);
  return mesh;
}

}  // namespace plume::datasets
