/// Generated meshes moved by a map, with a field of one's own.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/scalar_field.h"

namespace plume::test {

using Vector = std::array<double, 3>;

/// The mesh with its points moved by map(Vector).
template <class Map>
Mesh moved_mesh(Mesh mesh, const Map& map) {
  std::vector<double> points;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    const Vector moved = map(point_at(mesh, p));
    points.insert(points.end(), moved.begin(), moved.end());
  }
  mesh.points = Array::own(std::move(points));
  return mesh;
}

/// of(place) at the mesh's points, rounded to single precision.
template <class Function>
ScalarField point_field(const Mesh& mesh, const Function& of) {
  ScalarField field;
  field.name = "of points";
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    field.values.push_back(static_cast<float>(of(point_at(mesh, p))));
  return field;
}

/// of(mean of a cell's points) for each cell.
template <class Function>
ScalarField cell_field(const Mesh& mesh, const Function& of) {
  ScalarField field;
  field.name = "of cells";
  field.association = Association::cell;
  const CellReader cells(mesh);
  std::vector<std::uint32_t> ids;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    cells.points(c, ids);
    Vector mean{0, 0, 0};
    for (const std::uint32_t id : ids)
      for (std::size_t a = 0; a < 3; ++a)
        mean[a] += point_at(mesh, id)[a] / static_cast<double>(ids.size());
    field.values.push_back(static_cast<float>(of(mean)));
  }
  return field;
}

/// The unit cube turned by layers, up to a radian, and bulged: smooth, but nothing stays straight.
inline Vector twisted_cube(const Vector& p) {
  const double x = p[0] - 0.5, y = p[1] - 0.5, wide = 1 + 0.3 * std::sin(2 * p[2]) * (1 - x * y);
  return {0.5 + wide * (x * std::cos(p[2]) - y * std::sin(p[2])),
          0.5 + wide * (x * std::sin(p[2]) + y * std::cos(p[2])), p[2] + 0.2 * x * y};
}

}  // namespace plume::test
