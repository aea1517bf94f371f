/// Seeded places of a mesh that rays are aimed at.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/local_frame.h"
#include "plume/traverse/ray.h"

namespace plume::test {

using Place = std::array<double, 3>;

/// A ray from one place towards another, its direction of length one; NaN where they are the same.
inline Ray ray_towards(const Place& from, const Place& to) {
  Ray ray;
  ray.origin = from;
  const double length = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  for (std::size_t a = 0; a < 3; ++a) ray.direction[a] = (to[a] - from[a]) / length;
  return ray;
}

/// Draws places, the same ones on every machine. Keeps references: mesh and places alike in world
/// coordinates.
class MeshSpots {
 public:
  MeshSpots(const Mesh& mesh, const Bounds& bounds, std::uint64_t seed)
      : mesh_(mesh), cells_(mesh), bounds_(bounds), random_(seed) {}

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }  // [0, 1)
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }
  double extent() const { return bounds_.diagonal(); }

  /// Anywhere in the bounds.
  Place inside() {
    Place p;
    for (std::size_t a = 0; a < 3; ++a)
      p[a] = bounds_.low[a] + uniform() * (bounds_.high[a] - bounds_.low[a]);
    return p;
  }
  /// On a sphere around the bounds, two diagonals from their centre.
  Place around() {
    Place p;
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
  /// A point of the mesh, exactly.
  Place vertex() {
    cells_.points(below(cells_.size()), ids_);
    return point_at(mesh_, ids_[below(ids_.size())]);
  }
  /// The first edge of a cell's first face.
  std::array<Place, 2> edge() {
    cells_.faces(below(cells_.size()), sizes_, ids_);
    return {point_at(mesh_, ids_[0]), point_at(mesh_, ids_[1])};
  }
  /// Three points of a tetrahedron, in any order.
  std::array<Place, 3> triangle() {
    cells_.points(below(cells_.size()), ids_);
    std::swap(ids_[3], ids_[below(4)]);
    std::swap(ids_[0], ids_[below(3)]);
    std::swap(ids_[1], ids_[1 + below(2)]);
    return {point_at(mesh_, ids_[0]), point_at(mesh_, ids_[1]), point_at(mesh_, ids_[2])};
  }
  /// A ray along an axis, forwards or backwards, that starts outside of the bounds.
  Ray along_axis(const Place& through) {
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

 private:
  const Mesh& mesh_;
  CellReader cells_;
  Bounds bounds_;
  std::mt19937_64 random_;
  std::vector<std::uint32_t> sizes_, ids_;
};

/// Halfway between two places, without rounding where that is possible.
inline Place middle(const Place& a, const Place& b) {
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

}  // namespace plume::test
