/// Small meshes written out by hand.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume::test {

/// A mesh of explicit cells, all of one type, with the point field "x" = first coordinate.
inline Mesh make_mesh(CellType type, std::vector<double> points, std::vector<std::int32_t> ids) {
  Mesh mesh;
  std::vector<double> x;
  for (std::size_t i = 0; i < points.size(); i += 3) x.push_back(points[i]);
  mesh.points = Array::own(std::move(points));
  mesh.cells.types = Array::own(std::vector<std::uint8_t>{static_cast<std::uint8_t>(type)});
  mesh.cells.connectivity = Array::own(std::move(ids));
  mesh.fields.push_back({"x", Association::point, 1, Array::own(std::move(x))});
  return mesh;
}

/// Two tetrahedra that share the triangle 1, 2, 3.
inline Mesh two_tetrahedra() {
  return make_mesh(CellType::tetrahedron, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1},
                   {0, 1, 2, 3, 4, 1, 3, 2});
}

/// The corners of the unit cube in VTK's order.
inline std::vector<double> cube_points() {
  return {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
}

/// A polyhedron whose faces are given as a stream: number of faces, then sizes and ids.
inline Mesh one_polyhedron(std::vector<double> points, std::vector<std::int32_t> faces) {
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < points.size() / 3; ++i) ids.push_back(static_cast<std::int32_t>(i));
  const auto count = static_cast<std::int32_t>(ids.size());
  Mesh mesh = make_mesh(CellType::polyhedron, std::move(points), std::move(ids));
  mesh.cells.offsets = Array::own(std::vector<std::int32_t>{0, count});
  mesh.cells.polyhedron_locations = Array::own(std::vector<std::int32_t>{0});
  mesh.cells.polyhedron_faces = Array::own(std::move(faces));
  return mesh;
}

}  // namespace plume::test
