/// The rays of the soak: every second one aimed at what is degenerate in a mesh of tetrahedra.
#pragma once

#include <cstdint>

#include "plume/tests/traverse/mesh_spots.h"

namespace plume::test {

/// Even numbers: from around the mesh through a random place in its bounds. Odd numbers, in turn:
/// through a vertex; through the middle of an edge; along an axis through a vertex; along an axis
/// through the middle of an edge; from one vertex through another; along an edge; in the plane of a
/// face, from one of its corners; from a vertex along a diagonal of the axes, as a lattice's edges
/// run. The last four start on the mesh: t_min is such that they are seen whole, like all others.
class AimedRays {
 public:
  static constexpr std::uint64_t kKinds = 8;

  AimedRays(const Mesh& mesh, const Bounds& bounds, std::uint64_t seed)
      : spots_(mesh, bounds, seed) {}

  Ray operator()(std::uint64_t i) {
    Ray ray = i % 2 == 0 ? through(spots_.inside()) : aimed(i / 2 % kKinds);
    ray.t_min = -std::numeric_limits<double>::infinity();
    return ray;
  }

 private:
  Ray through(const Place& place) { return ray_towards(spots_.around(), place); }

  Place edge_middle() {
    const auto t = spots_.triangle();
    return middle(t[0], t[1]);
  }

  Ray aimed(std::uint64_t kind) {
    switch (kind) {
      case 0:
        return through(spots_.vertex());
      case 1:
        return through(edge_middle());
      case 2:
        return spots_.along_axis(spots_.vertex());
      case 3:
        return spots_.along_axis(edge_middle());
      case 4: {
        const Place from = spots_.vertex();
        return ray_towards(from, spots_.vertex());
      }
      case 5: {
        const auto t = spots_.triangle();
        return ray_towards(t[0], t[1]);
      }
      case 6: {
        const auto t = spots_.triangle();
        // A place on the opposite edge, in quarters: exact where the points are.
        const double share = 0.25 * static_cast<double>(1 + spots_.below(3));
        Place place;
        for (std::size_t a = 0; a < 3; ++a) place[a] = t[1][a] + share * (t[2][a] - t[1][a]);
        return ray_towards(t[0], place);
      }
      default: {
        const Place from = spots_.vertex();
        Place to = from;
        for (double& x : to)
          x += (static_cast<double>(spots_.below(3)) - 1) * spots_.extent();  // -1, 0 or 1
        return ray_towards(from, to);
      }
    }
  }

  MeshSpots spots_;
};

}  // namespace plume::test
