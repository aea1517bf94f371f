/// The baseline: the thesis' scalar walker through tetrahedra, by Plücker coordinates.
///
/// G. Marmitt, "Interactive Volume Ray Tracing", sections 6.3.1 to 6.3.5: the optimised approach of
/// table 6.1 and algorithm 9 (left), in single precision, with its 32 bytes a cell and 16 a point.
/// It is meant to be as fast as that algorithm can be made in scalar code, so that a ratio to it
/// means something; where we were free to choose, the fastest of what we tried was taken.
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
/// WalkableTets of the same mesh, so that both walkers read memory in the same order.
struct PluckerMesh {
  struct Cell {
    std::array<std::uint32_t, 4> points;
    /// neighbors[i] shares the face opposite to points[i]: its number times 4, plus which of the
    /// neighbour's points is opposite to that face (section 6.3.5: 30 + 2 bits, "avoids checking
    /// the face-id with costly conditional statements"). kNone at the boundary.
    std::array<std::uint32_t, 4> neighbors;
  };
  static_assert(sizeof(Cell) == 32 && sizeof(WalkablePoint) == 16);

  LocalFrame frame;
  std::vector<WalkablePoint> points;
  std::vector<Cell> cells;

  std::size_t bytes() const { return cells.size() * sizeof(Cell) + points.size() * 16; }
};

/// Requires fewer than 2^30 - 1 cells.
PluckerMesh make_plucker_mesh(TetAdjacency adjacency);

/// A ray {d : d x o} in local coordinates. o is the ray's point nearest to the centre of the mesh,
/// as in our own frame (sheared_frame.h), so that a far camera costs the baseline no precision.
struct PluckerRay {
  float d[3], q[3], o[3];
  /// t = dot(d, point) * t_per_length + t_offset, in world units, for a point on the ray.
  float t_per_length, t_offset;

  PluckerRay(const Ray& ray, const LocalFrame& frame);
};

/// Where the ray crosses a face.
struct PluckerCrossing {
  float t, scalar;
};

/// No audit: what is timed.
struct NoAudit {
  void add_tests(std::uint64_t) {}
  bool accept(float, float, float) { return true; }
};

/// Counts Plücker tests, and stops the ray where the three products of the face it is sent through
/// contradict each other: it passes that face's edges on different sides, so it does not cross it.
struct CountingAudit {
  std::uint64_t tests = 0;
  bool contradiction = false;

  void add_tests(std::uint64_t count) { tests += count; }
  bool accept(float w0, float w1, float w2) {
    contradiction = w0 < 0 || w1 < 0 || w2 < 0;
    return !contradiction;
  }
};

/// A walk that has not left the mesh after so many cells goes round in a circle. (No ray through
/// 50 million tetrahedra of even shape meets a tenth as many.)
inline constexpr std::uint32_t kPluckerLongest = 1u << 16;

/// How a walk of the baseline ended.
struct PluckerWalk {
  std::uint32_t cells = 0;
  /// Ended by the audit, or by kPluckerLongest.
  bool lost = false;
};

namespace detail {

struct PluckerVertex {
  std::uint32_t id;
  float x, y, z;
};

#ifndef FORM
#define FORM 2
#endif

}  // namespace detail

/// Follows a ray from a boundary face until it leaves the mesh or `visit` returns false.
template <bool kMeasure, class Visit, class Audit>
PluckerWalk walk_plucker(const PluckerMesh& mesh, const PluckerRay& ray,
                         const WalkableTets::Boundary& entry, Visit&& visit, Audit&& audit) {
  struct Vertex {
    std::uint32_t id;
    float x, y, z, t, scalar;
  };
  const float dx = ray.d[0], dy = ray.d[1], dz = ray.d[2];
  const float qx = ray.q[0], qy = ray.q[1], qz = ray.q[2];
  auto load = [&](std::uint32_t id) {
    const WalkablePoint& p = mesh.points[id];
    Vertex v{id, p.position[0], p.position[1], p.position[2], 0, p.scalar};
#if FORM == 1 || FORM == 3
    v.x -= ray.o[0]; v.y -= ray.o[1]; v.z -= ray.o[2];
#endif
    if constexpr (kMeasure) v.t = dx * v.x + dy * v.y + dz * v.z;
    return v;
  };
  struct M { float x, y, z, c; };
  auto moment = [&](const Vertex& e) -> M {
#if FORM == 2
    return {dy * e.z - dz * e.y - qx, dz * e.x - dx * e.z - qy, dx * e.y - dy * e.x - qz, qx * e.x + qy * e.y + qz * e.z};
#elif FORM == 3
    return {dy * e.z - dz * e.y, dz * e.x - dx * e.z, dx * e.y - dy * e.x, 0};
#else
    (void)e;
    return {};
#endif
  };
  auto product = [&](const Vertex& s, const Vertex& e, const M& m) {
#if FORM == 0
    const float ex = e.x - s.x, ey = e.y - s.y, ez = e.z - s.z;
    const float cx = e.y * s.z - e.z * s.y, cy = e.z * s.x - e.x * s.z, cz = e.x * s.y - e.y * s.x;
    (void)m;
    return (dx * cx + dy * cy + dz * cz) + (qx * ex + qy * ey + qz * ez);
#elif FORM == 1
    (void)m;
    return dx * (e.y * s.z - e.z * s.y) + dy * (e.z * s.x - e.x * s.z) + dz * (e.x * s.y - e.y * s.x);
#elif FORM == 3
    (void)e;
    return m.x * s.x + m.y * s.y + m.z * s.z;
#else
    return m.x * s.x + m.y * s.y + m.z * s.z + m.c;
#endif
  };
  Vertex v0 = load(entry.loop[0]), v1 = load(entry.loop[1]), v2 = load(entry.loop[2]);
  float w01 = product(v0, v1, moment(v1)), w12 = product(v1, v2, moment(v2)), w20 = product(v2, v0, moment(v0));
  if (w01 + w12 + w20 < 0) {
    std::swap(v1, v2);
    const float t = w01;
    w01 = -w20; w20 = -t; w12 = -w12;
  }
  std::uint32_t cell = entry.cell;
  std::uint32_t apex = entry.apex;
  auto measure = [&] {
    float a = w12, b = w20, c = w01, sum = a + b + c;
    if (!(sum > 0)) { a = b = c = 1; sum = 3; }
    const float r = 1 / sum;
    return PluckerCrossing{(a * v0.t + b * v1.t + c * v2.t) * r * ray.t_per_length + ray.t_offset,
                           (a * v0.scalar + b * v1.scalar + c * v2.scalar) * r};
  };
  PluckerCrossing in{};
  if constexpr (kMeasure) in = measure();
  PluckerWalk walk;
#if VAR == 0
  for (;;) {
    ++walk.cells;
    const Vertex v3 = load(apex);
    const M m = moment(v3);
    const float w03 = product(v0, v3, m), w13 = product(v1, v3, m);
    std::uint32_t behind;
    if (w03 < 0 && w13 > 0) {
      behind = v2.id;
      v2 = v3;
      w12 = w13; w20 = -w03;
      audit.add_tests(2);
    } else {
      audit.add_tests(3);
      const float w23 = product(v2, v3, m);
      if (w23 > 0) {
        behind = v0.id;
        v0 = v3;
        w01 = -w13; w20 = w23;
      } else {
        behind = v1.id;
        v1 = v3;
        w01 = w03; w12 = -w23;
      }
    }
    if (!audit.accept(w01, w12, w20)) { walk.lost = true; return walk; }
    if constexpr (kMeasure) {
      const PluckerCrossing out = measure();
      if (!visit(in.t, out.t, in.scalar, out.scalar)) return walk;
      in = out;
    }
    const PluckerMesh::Cell& record = mesh.cells[cell];
    std::size_t face = 0;
    while (record.points[face] != behind) ++face;
    const std::uint32_t next = record.neighbors[face];
    if (next == kNone) return walk;
    if (walk.cells == kPluckerLongest) { walk.lost = true; return walk; }
    cell = next >> 2;
    apex = mesh.cells[cell].points[next & 3];
  }
#elif VAR == 1
  for (;;) {
    ++walk.cells;
    const Vertex v3 = load(apex);
    const M m = moment(v3);
    const float w03 = product(v0, v3, m), w13 = product(v1, v3, m);
    std::uint32_t behind;
    if (w03 < 0 && w13 > 0) {
      behind = v2.id;
      v2 = v3;
      w12 = w13; w20 = -w03;
      audit.add_tests(2);
    } else {
      audit.add_tests(3);
      const float w23 = product(v2, v3, m);
      if (w23 > 0) {
        behind = v0.id;
        v0 = v3;
        w01 = -w13; w20 = w23;
      } else {
        behind = v1.id;
        v1 = v3;
        w01 = w03; w12 = -w23;
      }
    }
    const PluckerMesh::Cell& record = mesh.cells[cell];
    std::size_t face = 0;
    while (record.points[face] != behind) ++face;
    const std::uint32_t next = record.neighbors[face];
    if (!audit.accept(w01, w12, w20)) { walk.lost = true; return walk; }
    if constexpr (kMeasure) {
      const PluckerCrossing out = measure();
      if (!visit(in.t, out.t, in.scalar, out.scalar)) return walk;
      in = out;
    }
    if (next == kNone) return walk;
    if (walk.cells == kPluckerLongest) { walk.lost = true; return walk; }
    cell = next >> 2;
    apex = mesh.cells[cell].points[next & 3];
  }
#elif VAR == 2
  auto leave = [&](std::uint32_t behind) {
    const PluckerMesh::Cell& record = mesh.cells[cell];
    std::size_t face = 0;
    while (record.points[face] != behind) ++face;
    const std::uint32_t next = record.neighbors[face];
    if (!audit.accept(w01, w12, w20)) { walk.lost = true; return false; }
    if constexpr (kMeasure) {
      const PluckerCrossing out = measure();
      if (!visit(in.t, out.t, in.scalar, out.scalar)) return false;
      in = out;
    }
    if (next == kNone) return false;
    if (walk.cells == kPluckerLongest) { walk.lost = true; return false; }
    cell = next >> 2;
    apex = mesh.cells[cell].points[next & 3];
    return true;
  };
  for (;;) {
    ++walk.cells;
    const Vertex v3 = load(apex);
    const M m = moment(v3);
    const float w03 = product(v0, v3, m), w13 = product(v1, v3, m);
    if (w03 < 0 && w13 > 0) {
      const auto behind = v2.id;
      v2 = v3;
      w12 = w13; w20 = -w03;
      audit.add_tests(2);
      if (!leave(behind)) return walk;
    } else {
      audit.add_tests(3);
      const float w23 = product(v2, v3, m);
      if (w23 > 0) {
        const auto behind = v0.id;
        v0 = v3;
        w01 = -w13; w20 = w23;
        if (!leave(behind)) return walk;
      } else {
        const auto behind = v1.id;
        v1 = v3;
        w01 = w03; w12 = -w23;
        if (!leave(behind)) return walk;
      }
    }
  }
#elif VAR == 3
  // four explicit stages? rotate roles: newest always v2
  for (;;) {
    ++walk.cells;
    const Vertex v3 = load(apex);
    const M m = moment(v3);
    const float w03 = product(v0, v3, m), w13 = product(v1, v3, m);
    std::uint32_t behind;
    if (w03 < 0 && w13 > 0) {
      behind = v2.id;
      w12 = w13; w20 = -w03;
      audit.add_tests(2);
    } else {
      audit.add_tests(3);
      const float w23 = product(v2, v3, m);
      if (w23 > 0) {
        behind = v0.id;
        v0 = v1; v1 = v2;
        w01 = w12; w12 = w23; w20 = -w13;
      } else {
        behind = v1.id;
        v1 = v0; v0 = v2;
        w01 = w20; w12 = w03; w20 = -w23;
      }
    }
    v2 = v3;
    const PluckerMesh::Cell& record = mesh.cells[cell];
    std::size_t face = 0;
    while (record.points[face] != behind) ++face;
    const std::uint32_t next = record.neighbors[face];
    if (!audit.accept(w01, w12, w20)) { walk.lost = true; return walk; }
    if constexpr (kMeasure) {
      const PluckerCrossing out = measure();
      if (!visit(in.t, out.t, in.scalar, out.scalar)) return walk;
      in = out;
    }
    if (next == kNone) return walk;
    if (walk.cells == kPluckerLongest) { walk.lost = true; return walk; }
    cell = next >> 2;
    apex = mesh.cells[cell].points[next & 3];
  }
#endif
}

}  // namespace plume::bench
