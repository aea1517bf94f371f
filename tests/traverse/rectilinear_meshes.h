/// Seeded rectilinear grids, and rays that aim at what is special about them.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "adversarial_rays.h"
#include "plume/mesh/rectilinear_axes.h"
#include "plume/mesh/validate.h"
#include "plume/traverse/trace_rectilinear.h"

namespace plume::test {

struct GridCase {
  const char* name;
  std::array<int, 3> cells{8, 8, 8};
  /// By how much of a width planes are moved; 0 for a regular grid.
  double uneven = 0;
  /// Axes of these bits descend.
  unsigned descending = 0;
  double scale = 1, offset = 0;
};

/// A grid with one random value in [0, 1) a point, or a cell.
inline Mesh rectilinear(const GridCase& c, Association association = Association::point,
                        std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Mesh mesh;
  for (std::size_t a = 0; a < 3; ++a) {
    const int n = c.cells[a];
    std::vector<double> axis;
    for (int i = 0; i <= n; ++i) {
      const double moved = i > 0 && i < n ? c.uneven * (uniform() - 0.5) : 0;
      axis.push_back((i + moved) / n * c.scale + c.offset);
    }
    if ((c.descending >> a & 1) != 0) std::reverse(axis.begin(), axis.end());
    mesh.dimensions[a] = n + 1;
    mesh.axes[a] = Array::own(std::move(axis));
  }
  std::vector<float> values(association == Association::point ? mesh.point_count()
                                                              : mesh.cell_count());
  for (float& value : values) value = static_cast<float>(uniform());
  mesh.fields.push_back({"random", association, 1, Array::own(std::move(values))});
  return mesh;
}

/// Besides AdversarialRays: along grid lines, in grid planes, in the outermost ones, and past the
/// outside so that they only touch.
class RectilinearRays {
 public:
  RectilinearRays(const Mesh& mesh, const Bounds& bounds, std::uint64_t seed)
      : bounds_(bounds), spots_(mesh, bounds, seed), general_(mesh, bounds, seed + 1) {}

  Ray operator()(std::uint64_t i) {
    const std::uint64_t which = i % 12;
    Ray ray = general_(i);
    if (which < 6) return ray;
    if (which == 6) return spots_.along_axis(spots_.vertex());
    if (which == 7) return spots_.along_axis(corner());
    // Through two vertices: ties wherever the grid is regular.
    if (which == 8) {
      const Place from = spots_.vertex();
      Place to = spots_.vertex();
      while (to == from) to = spots_.vertex();
      return from_behind(from, to);
    }
    if (which == 9) {  // in a plane of the grid
      const Place from = spots_.vertex();
      Place to = spots_.inside();
      const std::size_t across = spots_.below(3);
      to[across] = from[across];
      return from_behind(from, to);
    }
    if (which == 10) {  // in an outermost plane
      Place from = spots_.inside(), to = spots_.inside();
      const std::size_t across = spots_.below(3);
      from[across] = to[across] = corner()[across];
      return from_behind(from, to);
    }
    // Past an edge or a corner of the box: up along one axis, down along another.
    const Place at = corner();
    ray.origin = at;
    const std::size_t flat = spots_.below(4);  // 3: none
    for (std::size_t a = 0; a < 3; ++a) {
      const bool low = at[a] == bounds_.low[a];
      const bool outwards = a == (flat + 1) % 3;
      ray.direction[a] = a == flat ? 0 : (low == outwards ? -1 : 1) * (0.1 + spots_.uniform());
    }
    return from_behind(
        at, {at[0] + ray.direction[0] * spots_.extent(), at[1] + ray.direction[1] * spots_.extent(),
             at[2] + ray.direction[2] * spots_.extent()});
  }

 private:
  Place corner() {
    Place p;
    for (std::size_t a = 0; a < 3; ++a)
      p[a] = spots_.below(2) == 0 ? bounds_.low[a] : bounds_.high[a];
    return p;
  }
  Ray from_behind(const Place& from, const Place& to) {
    Ray ray = ray_towards(from, to);
    for (std::size_t a = 0; a < 3; ++a) ray.origin[a] -= ray.direction[a] * spots_.extent();
    return ray;
  }

  Bounds bounds_;
  MeshSpots spots_;
  AdversarialRays general_;
};

}  // namespace plume::test
