/// The baseline: the scalar walker through tetrahedra by Plücker coordinates.
///
/// G. Marmitt, "Interactive Volume Ray Tracing" (Saarland University, 2008), sections 6.3.1 to
/// 6.3.5: the optimised approach of table 6.1 and algorithm 9 (left), in single precision, with its
/// 32 bytes a cell and 16 a point, in two forms. One has the products as the thesis defines them
/// (equations 6.1 and 6.3): that is the baseline. The other is as fast as we could make the
/// algorithm in scalar code, so that nobody need wonder what the ratio owes to the baseline's
/// clumsiness. Where the thesis leaves the choice, what was fastest on the meshes of the suite was
/// taken in both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "plume/mesh/tet_adjacency.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/ray.h"

namespace plume::bench {

/// Tetrahedra in the thesis' form. Cells and points have the numbers that they have in the
/// WalkableTets of the same mesh, so that all walkers read memory in the same order.
struct PluckerMesh {
  struct Cell {
    std::array<std::uint32_t, 4> points;
    /// neighbors[i] shares the face opposite to points[i]: its number times 4, plus the number of
    /// its point that is opposite to the common face (30 + 2 bits: "this avoids checking the
    /// face-id with costly conditional statements", section 6.3.5). kNone at the boundary.
    std::array<std::uint32_t, 4> neighbors;
  };
  static_assert(sizeof(Cell) == 32 && sizeof(WalkablePoint) == 16);

  LocalFrame frame;
  std::vector<WalkablePoint> points;
  std::vector<Cell> cells;

  std::size_t bytes() const {
    return cells.size() * sizeof(Cell) + points.size() * sizeof(WalkablePoint);
  }
};

/// Of a mesh and its find_tet_adjacency(); cells list their points in the order of the mesh. Throws
/// Error where 30 bits do not number the cells.
PluckerMesh make_plucker_mesh(const Mesh& mesh, TetAdjacency adjacency);

/// How products of a ray and an edge are computed.
enum class PluckerProducts {
  /// The permuted inner product (6.3) of two lines' coordinates {d : d x o} (6.1).
  thesis,
  /// Relative to a point o on the ray itself the ray's coordinates are {d : 0}, which saves half of
  /// every product; and all edges of a cell that are tested end in the same vertex, whose part is
  /// computed once.
  relative,
};

/// A ray in local coordinates. o is the point nearest to the centre of the mesh, as in our own
/// frame (sheared_frame.h), so that a camera far away costs no precision.
struct PluckerRay {
  PluckerRay(const Ray& ray, const LocalFrame& frame);

  float d[3], o[3];
  /// t = t_offset + t_per_length * dot(d, p - o), in world units, for a point p on the ray.
  float t_offset, t_per_length;
};

/// What is timed: no audit.
struct NoAudit {
  void come_to(std::uint32_t) {}
  void count_tests(std::uint64_t) {}
  bool contradicted(float, float, float) { return false; }
};

/// Counts Plücker tests, and notices a face whose three products contradict each other: the ray
/// passes its edges on different sides, so it was sent through a face that it does not cross.
struct CountingAudit {
  std::uint64_t tests = 0;
  void come_to(std::uint32_t) {}
  void count_tests(std::uint64_t count) { tests += count; }
  bool contradicted(float w01, float w12, float w20) { return w01 < 0 || w12 < 0 || w20 < 0; }
};

/// How a walk of the baseline ended.
struct PluckerWalk {
  std::uint32_t cells = 0;
  /// It contradicted itself (seen by an audit only), or goes round in a circle.
  bool lost = false;
};

/// A walk that has passed so many cells goes round in a circle: no ray of the suite's meshes meets
/// a tenth as many.
inline constexpr std::uint32_t kPluckerLongest = 1u << 16;

/// Follows a ray from a boundary face until it leaves the mesh or the consumer has seen enough (see
/// passage_consumers.h). A consumer that does not measure costs no measuring: the walk alone.
///
/// Where the ray meets a vertex or an edge, products are zero or have the sign that rounding gives
/// them, in each cell anew. The walk goes on through some face, and may leave the ray for good or
/// run in a circle: that is what "lost" means.
template <PluckerProducts kProducts, class Consumer, class Audit>
PluckerWalk walk_plucker(const PluckerMesh& mesh, const PluckerRay& ray,
                         const WalkableTets::Boundary& entry, Consumer& consumer, Audit& audit) {
  struct Vector {
    float x, y, z;
  };
  struct Vertex {
    std::uint32_t id;
    Vector at;            // for relative products: from o
    float along, scalar;  // along the ray, in local units
  };
  const Vector d{ray.d[0], ray.d[1], ray.d[2]};
  const Vector o{ray.o[0], ray.o[1], ray.o[2]};
  auto cross = [](const Vector& p, const Vector& q) {
    return Vector{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  };
  auto dot = [](const Vector& p, const Vector& q) { return p.x * q.x + p.y * q.y + p.z * q.z; };
  auto minus = [](const Vector& p, const Vector& q) {
    return Vector{p.x - q.x, p.y - q.y, p.z - q.z};
  };
  const Vector d_x_o = cross(d, o);
  auto vertex = [&](std::uint32_t id) {
    const WalkablePoint& p = mesh.points[id];
    Vertex v{id, {p.position[0], p.position[1], p.position[2]}, 0, p.scalar};
    const Vector from_o = minus(v.at, o);
    if constexpr (kProducts == PluckerProducts::relative) v.at = from_o;
    if constexpr (Consumer::kMeasures) v.along = dot(d, from_o);
    return v;
  };
  auto product = [&](const Vertex& from, const Vertex& to) {
    if constexpr (kProducts == PluckerProducts::relative) return dot(cross(d, to.at), from.at);
    const Vector edge = minus(to.at, from.at);
    return dot(d, cross(edge, from.at)) + dot(d_x_o, edge);
  };

  // The face by which the ray is in the cell, seen such that its products are positive.
  Vertex v0 = vertex(entry.loop[0]), v1 = vertex(entry.loop[1]), v2 = vertex(entry.loop[2]);
  float w01 = product(v0, v1), w12 = product(v1, v2), w20 = product(v2, v0);
  if (w01 + w12 + w20 < 0) {
    std::swap(v1, v2);
    const float w02 = w20;
    w20 = -w01;
    w01 = -w02;
    w12 = -w12;
  }
  // "Plücker products provide the scaled barycentric coordinates" (6.5); of a face without area,
  // its centre.
  struct Crossing {
    float t, scalar;
  };
  auto measure = [&] {
    float u0 = w12, u1 = w20, u2 = w01;
    float sum = u0 + u1 + u2;
    if (!(sum > 0)) {
      u0 = u1 = u2 = 1;
      sum = 3;
    }
    const float share = 1 / sum;
    const float along = (u0 * v0.along + u1 * v1.along + u2 * v2.along) * share;
    return Crossing{ray.t_offset + ray.t_per_length * along,
                    (u0 * v0.scalar + u1 * v1.scalar + u2 * v2.scalar) * share};
  };
  Crossing in{0, 0};
  if constexpr (Consumer::kMeasures) in = measure();

  PluckerWalk walk;
  std::uint32_t cell = entry.cell;
  std::uint32_t apex = entry.apex;
  for (;;) {
    ++walk.cells;
    audit.come_to(cell);
    const Vertex v3 = vertex(apex);
    const float w03 = product(v0, v3), w13 = product(v1, v3);
    // The new vertex takes the place of the one that is left behind: then each of the three ways
    // out is as likely as the others, and there are 2 + 2/3 tests a cell. (With the new vertex
    // always last there would be 2.9.)
    std::uint32_t behind;
    if (w03 < 0 && w13 > 0) {
      behind = std::exchange(v2, v3).id;
      w12 = w13;
      w20 = -w03;
      audit.count_tests(2);
    } else {
      const float w23 = product(v2, v3);
      audit.count_tests(3);
      if (w23 > 0) {
        behind = std::exchange(v0, v3).id;
        w01 = -w13;
        w20 = w23;
      } else {
        behind = std::exchange(v1, v3).id;
        w01 = w03;
        w12 = -w23;
      }
    }
    const PluckerMesh::Cell& record = mesh.cells[cell];
    std::size_t face = 0;
    while (record.points[face] != behind) ++face;
    const std::uint32_t next = record.neighbors[face];
    if (audit.contradicted(w01, w12, w20)) {
      walk.lost = true;
      return walk;
    }
    if constexpr (Consumer::kMeasures) {
      const Crossing out = measure();
      if (!consumer.add(in.t, out.t, in.scalar, out.scalar)) return walk;
      in = out;
    }
    if (next == kNone) return walk;
    if (walk.cells == kPluckerLongest) {
      walk.lost = true;
      return walk;
    }
    cell = next >> 2;
    apex = mesh.cells[cell].points[next & 3];
  }
}

}  // namespace plume::bench
