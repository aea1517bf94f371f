/// Rays that lose other tracers: seeded, a third of them aimed exactly at vertices, edges and along
/// the lines of a grid.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/local_frame.h"
#include "plume/traverse/ray.h"

namespace plume::test {

class AdversarialRays {
 public:
  AdversarialRays(const Mesh& mesh, const Bounds& bounds, std::uint64_t seed)
      : mesh_(mesh), cells_(mesh), bounds_(bounds), random_(seed) {}

  /// Number `i`: of six, four are random, the fifth and sixth are aimed at a vertex, an edge's
  /// middle, or along an axis through a vertex, in turn.
  Ray operator()(std::uint64_t i) {
    switch (i % 6 < 4 ? 0 : 1 + (i / 6 * 2 + i % 6) % 3) {
      case 1:
        return towards(random_origin(), random_vertex());
      case 2:
        return towards(random_origin(), random_edge_middle());
      case 3:
        return along_axis(random_vertex());
      default:
        return towards(random_origin(), random_inside());
    }
  }

  double uniform() {  // [0, 1), the same on every machine
    return static_cast<double>(random_() >> 11) * 0x1p-53;
  }

 private:
  using Point = std::array<double, 3>;

  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }
  double extent() const { return bounds_.diagonal(); }

  Point random_inside() {
    Point p;
    for (std::size_t a = 0; a < 3; ++a)
      p[a] = bounds_.low[a] + uniform() * (bounds_.high[a] - bounds_.low[a]);
    return p;
  }
  Point random_origin() {
    Point p;
    double length = 0;
    do {
      length = 0;
      for (double& x : p) {
        x = 2 * uniform() - 1;
        length += x * x;
      }
    } while (length > 1 || length < 0.01);
    for (std::size_t a = 0; a < 3; ++a)
      p[a] = bounds_.center()[a] + 2 * extent() * p[a] / std::sqrt(length);
    return p;
  }
  Point random_vertex() {
    std::vector<std::uint32_t> ids;
    cells_.points(below(cells_.size()), ids);
    return point_at(mesh_, ids[below(ids.size())]);
  }
  Point random_edge_middle() {
    std::vector<std::uint32_t> sizes, ids;
    cells_.faces(below(cells_.size()), sizes, ids);
    const Point a = point_at(mesh_, ids[0]), b = point_at(mesh_, ids[1]);
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
  }
  static Ray towards(const Point& from, const Point& to) {
    Ray ray;
    ray.origin = from;
    const double length = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    for (std::size_t a = 0; a < 3; ++a) ray.direction[a] = (to[a] - from[a]) / length;
    return ray;
  }
  Ray along_axis(const Point& through) {
    Ray ray;
    const std::size_t axis = below(3);
    ray.origin = through;
    ray.origin[axis] -= 2 * extent();
    ray.direction = {0, 0, 0};
    ray.direction[axis] = 1;
    if (below(2) == 1) {
      ray.origin[axis] += 4 * extent();
      ray.direction[axis] = -1;
    }
    return ray;
  }

  const Mesh& mesh_;
  CellReader cells_;
  Bounds bounds_;
  std::mt19937_64 random_;
};

}  // namespace plume::test
