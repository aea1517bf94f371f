/// Rays that lose other tracers: seeded, a third of them aimed exactly at vertices, edges and along
/// the lines of a grid.
#pragma once

#include <cstdint>

#include "plume/tests/traverse/mesh_spots.h"

namespace plume::test {

class AdversarialRays {
 public:
  AdversarialRays(const Mesh& mesh, const Bounds& bounds, std::uint64_t seed)
      : spots_(mesh, bounds, seed) {}

  /// Number `i`: of six, four are random, the fifth and sixth are aimed at a vertex, an edge's
  /// middle, or along an axis through a vertex, in turn.
  Ray operator()(std::uint64_t i) {
    switch (i % 6 < 4 ? 0 : 1 + (i / 6 * 2 + i % 6) % 3) {
      case 1:
        return from_around([this] { return spots_.vertex(); });
      case 2:
        return from_around([this] {
          const auto edge = spots_.edge();
          return middle(edge[0], edge[1]);
        });
      case 3:
        return spots_.along_axis(spots_.vertex());
      default:
        return from_around([this] { return spots_.inside(); });
    }
  }

 private:
  template <class Target>
  Ray from_around(const Target& target) {
    const Place from = spots_.around();
    return ray_towards(from, target());
  }

  MeshSpots spots_;
};

}  // namespace plume::test
