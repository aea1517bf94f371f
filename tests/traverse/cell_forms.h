/// Generated meshes in every form that has an inside, moved by a smooth map, with a field.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/validate.h"
#include "plume/traverse/trace.h"

namespace plume::test {

/// A mesh made walkable, with its boundary.
template <class Walker>
struct Form {
  Mesh user;
  ScalarField field;
  typename Walker::Mesh mesh;
  BoundaryIndex<Walker> boundary;

  explicit Form(const Mesh& m)
      : user(m), field(select_field(m)), mesh(make(m, field)), boundary(mesh) {}

  std::vector<Segment> segments(const Ray& ray, const ScalarRequest& order) const {
    std::vector<Segment> list;
    auto visit = [&](const Segment& segment) {
      list.push_back(segment);
      return true;
    };
    trace(mesh, boundary, ray, visit, order);
    return list;
  }

 private:
  static typename Walker::Mesh make(const Mesh& m, const ScalarField& field) {
    if constexpr (std::is_same_v<Walker, GridWalker>)
      return make_walkable_grid(m, field, check_structure(m));
    else
      return make_walkable_cells(m, field, check_structure(m), true);
  }
};

/// The mesh with its points moved by `map` and one point field, `of` the moved points.
template <class Map, class Function>
Mesh mapped(Mesh mesh, const Map& map, const Function& of) {
  std::vector<double> points;
  std::vector<float> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    const std::array<double, 3> moved = map(point_at(mesh, p));
    points.insert(points.end(), moved.begin(), moved.end());
    values.push_back(static_cast<float>(of(moved)));
  }
  mesh.points = Array::own(std::move(points));
  mesh.fields = {{"value", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "value";
  return mesh;
}

/// Turns the unit cube's layers about its axis, up to one radian, and bulges it: no cell is
/// left a parallelepiped, but the finer the mesh, the nearer they are to one.
inline std::array<double, 3> twist(const std::array<double, 3>& p) {
  const double x = p[0] - 0.5, y = p[1] - 0.5, angle = p[2];
  const double wide = 1 + 0.3 * std::sin(2 * p[2]) * (1 - x * y);
  return {0.5 + wide * (x * std::cos(angle) - y * std::sin(angle)),
          0.5 + wide * (x * std::sin(angle) + y * std::cos(angle)), p[2] + 0.2 * x * y};
}

inline double smooth_field(const std::array<double, 3>& p) {
  return std::sin(3 * p[0] + 1) * std::cos(2.5 * p[1]) * std::exp(p[2]) + 2 * p[0] * p[1] * p[2];
}

inline double linear_field(const std::array<double, 3>& p) {
  return 0.3 + p[0] - 2 * p[1] + 1.5 * p[2];
}

}  // namespace plume::test
