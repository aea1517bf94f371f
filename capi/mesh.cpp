#include <fmt/format.h>

#include <memory>

#include "plume/capi/handles.h"

namespace plume::capi {

Array borrow(const plume_array& array, const char* what) {
  if (array.count > 0 && array.data == nullptr)
    throw Error(fmt::format("{}: {} numbers at NULL", what, array.count));
  auto values = [&]<class T>(const T* first) {
    return Array::borrow(std::span<const T>(first, array.count));
  };
  switch (array.type) {
    case PLUME_UINT8:
      return values(static_cast<const std::uint8_t*>(array.data));
    case PLUME_INT32:
      return values(static_cast<const std::int32_t*>(array.data));
    case PLUME_INT64:
      return values(static_cast<const std::int64_t*>(array.data));
    case PLUME_FLOAT32:
      return values(static_cast<const float*>(array.data));
    case PLUME_FLOAT64:
      return values(static_cast<const double*>(array.data));
  }
  throw Error(fmt::format("{}: no type has the number {}; see plume_type", what,
                          static_cast<int>(array.type)));
}

}  // namespace plume::capi

using namespace plume::capi;

plume_status plume_mesh_of_cells(plume_array points, plume_array types, plume_array offsets,
                                 plume_array connectivity, plume_mesh** mesh) {
  return guarded([&] {
    require(mesh, "plume_mesh_of_cells: mesh");
    auto made = std::make_unique<plume_mesh>();
    made->mesh.points = borrow(points, "points");
    made->mesh.cells.types = borrow(types, "types");
    made->mesh.cells.offsets = borrow(offsets, "offsets");
    made->mesh.cells.connectivity = borrow(connectivity, "connectivity");
    *mesh = made.release();
    return PLUME_OK;
  });
}

plume_status plume_mesh_set_polyhedra(plume_mesh* mesh, plume_array faces, plume_array locations) {
  return guarded([&] {
    require(mesh, "plume_mesh_set_polyhedra: mesh");
    const plume::Array borrowed_faces = borrow(faces, "faces");
    mesh->mesh.cells.polyhedron_locations = borrow(locations, "locations");
    mesh->mesh.cells.polyhedron_faces = borrowed_faces;
    return PLUME_OK;
  });
}

plume_status plume_mesh_of_grid(int64_t ni, int64_t nj, int64_t nk, plume_array points,
                                plume_mesh** mesh) {
  return guarded([&] {
    require(mesh, "plume_mesh_of_grid: mesh");
    if (ni < 2 || nj < 2 || nk < 2)
      throw plume::Error(fmt::format("a grid of {} x {} x {} points: at least 2 each", ni, nj, nk));
    auto made = std::make_unique<plume_mesh>();
    made->mesh.points = borrow(points, "points");
    made->mesh.dimensions = {ni, nj, nk};
    *mesh = made.release();
    return PLUME_OK;
  });
}

plume_status plume_mesh_of_axes(plume_array x, plume_array y, plume_array z, plume_mesh** mesh) {
  return guarded([&] {
    require(mesh, "plume_mesh_of_axes: mesh");
    for (const plume_array* axis : {&x, &y, &z})
      if (axis->count < 2)
        throw plume::Error(fmt::format("an axis of {} coordinates: at least 2 each", axis->count));
    auto made = std::make_unique<plume_mesh>();
    made->mesh.axes = {borrow(x, "x"), borrow(y, "y"), borrow(z, "z")};
    for (std::size_t a = 0; a < 3; ++a)
      made->mesh.dimensions[a] = static_cast<std::int64_t>(made->mesh.axes[a].size());
    *mesh = made.release();
    return PLUME_OK;
  });
}

plume_status plume_mesh_add_field(plume_mesh* mesh, const char* name, plume_association association,
                                  int components, plume_array values) {
  return guarded([&] {
    require(mesh, "plume_mesh_add_field: mesh");
    require(name, "plume_mesh_add_field: name");
    if (components < 1)
      throw plume::Error(fmt::format("field '{}' of {} components: at least 1", name, components));
    if (association != PLUME_POINT && association != PLUME_CELL)
      throw plume::Error(fmt::format("field '{}': no association has the number {}", name,
                                     static_cast<int>(association)));
    mesh->mesh.fields.push_back(
        {name, association == PLUME_POINT ? plume::Association::point : plume::Association::cell,
         components, borrow(values, name)});
    return PLUME_OK;
  });
}

void plume_mesh_free(plume_mesh* mesh) { delete mesh; }
