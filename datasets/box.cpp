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
