/// Rays aimed at what is special about a mesh.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "plume/tests/traverse/mesh_spots.h"

namespace plume::atlas {

enum class Aim : std::uint8_t {
  inside,        ///< anywhere: the control
  vertex,        ///< through a vertex, from around the mesh
  edge,          ///< through the middle of an edge
  along_edge,    ///< along an edge of a cell
  in_face,       ///< in the plane of a face, from one of its corners
  along_axis,    ///< along an axis, through a vertex
  two_vertices,  ///< from a vertex through another
  tangent,       ///< touches the bounds at a corner or an edge, or lies in one of its sides
};

/// Seeded. Rays see the whole line: t_min is -infinity.
class SceneRays {
 public:
  SceneRays(const Mesh& mesh, const Bounds& bounds, std::uint64_t seed)
      : mesh_(mesh), cells_(mesh), bounds_(bounds), spots_(mesh, bounds, seed) {}

  std::vector<Ray> operator()(const std::vector<Aim>& aims, std::size_t count) {
    std::vector<Ray> rays;
    while (rays.size() < count) {
      Ray ray = one(aims[rays.size() % aims.size()]);
      ray.t_min = -std::numeric_limits<double>::infinity();
      if (ray.direction[0] == ray.direction[0]) rays.push_back(ray);  // not from a place to itself
    }
    return rays;
  }

 private:
  using Place = test::Place;

  Ray one(Aim aim) {
    switch (aim) {
      case Aim::inside:
        return through(spots_.inside());
      case Aim::vertex:
        return through(spots_.vertex());
      case Aim::edge: {
        const auto face = any_face();
        return through(test::middle(face[0], face[1]));
      }
      case Aim::along_edge: {
        const auto face = any_face();
        return test::ray_towards(face[0], face[1]);
      }
      case Aim::in_face: {
        const auto face = any_face();
        // A place on an edge that the corner is not on, in quarters: exact where the points are.
        const double share = 0.25 * static_cast<double>(1 + spots_.below(3));
        Place place;
        for (std::size_t a = 0; a < 3; ++a)
          place[a] = face[1][a] + share * (face[2][a] - face[1][a]);
        return test::ray_towards(face[0], place);
      }
      case Aim::along_axis:
        return spots_.along_axis(spots_.vertex());
      case Aim::two_vertices: {
        const Place from = spots_.vertex();
        return test::ray_towards(from, spots_.vertex());
      }
      case Aim::tangent:
        return tangent();
    }
    return {};
  }

  Ray through(const Place& place) {
    const Place from = spots_.around();
    return test::ray_towards(from, place);
  }

  // The corners of a face, beginning with any of them.
  std::vector<Place> any_face() {
    cells_.faces(spots_.below(cells_.size()), sizes_, ids_);
    std::size_t face = spots_.below(sizes_.size()), first = 0;
    for (std::size_t f = 0; f < face; ++f) first += sizes_[f];
    const std::size_t size = sizes_[face], turn = spots_.below(size);
    std::vector<Place> corners;
    for (std::size_t i = 0; i < size; ++i)
      corners.push_back(point_at(mesh_, ids_[first + (i + turn) % size]));
    return corners;
  }

  Ray tangent() {
    Place at, towards = spots_.inside();
    for (std::size_t a = 0; a < 3; ++a)
      at[a] = spots_.below(2) == 0 ? bounds_.low[a] : bounds_.high[a];
    const std::size_t across = spots_.below(3);
    Ray ray;
    if (spots_.below(2) == 0) {  // in a side
      towards[across] = at[across];
      ray = test::ray_towards(at, towards);
    } else {  // past an edge or a corner: outwards along one axis, inwards along the others
      const std::size_t flat = spots_.below(4);  // 3: none
      for (std::size_t a = 0; a < 3; ++a) {
        const bool low = at[a] == bounds_.low[a];
        towards[a] = at[a];
        if (a != flat)
          towards[a] += (low == (a == (flat + 1) % 3) ? -1 : 1) * (0.25 + spots_.uniform());
      }
      ray = test::ray_towards(at, towards);
    }
    for (std::size_t a = 0; a < 3; ++a) ray.origin[a] -= ray.direction[a] * spots_.extent();
    return ray;
  }

  const Mesh& mesh_;
  CellReader cells_;
  Bounds bounds_;
  test::MeshSpots spots_;
  std::vector<std::uint32_t> sizes_, ids_;
};

}  // namespace plume::atlas
