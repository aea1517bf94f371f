/// Which crossings a ray has with a quadrilateral: a function of its four corners in the sheared
/// frame, in the order of its loop, and of nothing else. Both cells at a face go around it from the
/// same corner in the same direction, so they agree, bit for bit, on how often and in which
/// directions it is crossed, whatever the rounding.
///
/// Three surfaces span the loop, each with its own rule. Whatever the rule, the directions sum to
/// the loop's winding number about the ray, so the crossings of a closed cell's faces balance.
#pragma once

#include "plume/traverse/sheared_frame.h"

namespace plume {

/// The corners of a face, in the order of its loop.
struct Quad {
  const ShearedPoint& a;
  const ShearedPoint& b;
  const ShearedPoint& c;
  const ShearedPoint& d;
};

/// The crossings of a quadrilateral, at most two. Their rank is their place in `direction`: 1 where
/// the loop winds about the ray positively, -1 where it does negatively, 0 for no crossing.
struct QuadCrossings {
  int direction[2] = {0, 0};

  /// In through a twisted face and out again.
  bool grazed() const { return direction[0] * direction[1] < 0; }
};

/// -2 to 2; beyond 1 by rounding only.
inline int winding(const Quad& q) {
  return crossing_unbranched(q.a, q.b) + crossing_unbranched(q.b, q.c) +
         crossing_unbranched(q.c, q.d) + crossing_unbranched(q.d, q.a);
}

/// The loop of a planar quadrilateral: as many crossings as its winding number. (A planar one that
/// is concave or a bow-tie has parts where the bilinear patch is folded, but both its crossings
/// are then at the same place.)
inline QuadCrossings planar_crossings(int winding) {
  const int direction = (winding > 0) - (winding < 0);
  return {{direction, winding - direction}};
}

/// Twice the area of the triangle of the ray and an edge: exact but for one rounding, with and
/// without fused multiply-add, as the products of two floats are exact.
inline double edge_product(const ShearedPoint& p, const ShearedPoint& q) {
  return static_cast<double>(p.x) * static_cast<double>(q.y) -
         static_cast<double>(q.x) * static_cast<double>(p.y);
}

/// On which side of an edge's line the ray passes: 1 where that product is positive, else -1.
///
/// The windings must not be contradicted: of an edge that crosses y = 0, its one bit says it
/// (right_of_ray()), though rounding may have had a hand in it. Of others the product does; where
/// that is zero, the ray is taken as moved a little, in +x and less in -y, as the bits have it.
inline int edge_side(const ShearedPoint& p, const ShearedPoint& q) {
  if (p.up() != q.up()) return (q.up() ? right_of_ray(p, q) : 1 - right_of_ray(q, p)) * 2 - 1;
  const double product = edge_product(p, q);
  if (product != 0) return product > 0 ? 1 : -1;
  return p.y > q.y || (p.y == q.y && p.x > q.x) ? 1 : -1;
}

/// Whether the ray crosses the bilinear patch of a loop of winding 0 twice, once in each direction.
///
/// The lines of constant v across the patch, and those of constant u, pass through the ray where a
/// quadratic in v (u) is 0: v0 (1-v)^2 + v1 v (1-v) + v2 v^2, and both have the discriminant
/// v1^2 - 4 v0 v2. A quadratic has two roots between 0 and 1 if and only if its outer Bernstein
/// coefficients have the same sign, the middle one the other, and the square of the middle one
/// exceeds the product of the outer ones: signs of edges and diagonals, and one comparison of
/// products. Two edges settle it where the ray passes beside a face that it sees as convex, but in
/// the sectors at its corners. Nothing is divided and no root taken. Where the patch only just
/// touches the ray the answer hangs on rounding, of the vertices above all; but it is the same from
/// both sides.
inline bool is_grazed(const Quad& q) {
  const int v0 = edge_side(q.a, q.b);
  if (v0 != edge_side(q.d, q.c)) return false;
  const int u0 = edge_side(q.a, q.d);
  if (u0 != edge_side(q.b, q.c)) return false;
  const double ac = edge_product(q.a, q.c), bd = edge_product(q.b, q.d);
  const double v1 = ac - bd, u1 = ac + bd;
  return v0 * v1 < 0 && u0 * u1 < 0 &&
         v1 * v1 > 4 * (edge_product(q.a, q.b) * edge_product(q.d, q.c));
}

/// The bilinear patch through the corners of a loop of this winding. Inside of it there is at most
/// one crossing in each direction (measure_quad.h), so the winding says all but whether there are
/// none or both.
inline QuadCrossings patch_crossings(const Quad& q, int winding) {
  if (winding == 0 && is_grazed(q)) return {{1, -1}};
  return planar_crossings(winding);
}

/// The triangles a, b, c and a, c, d: one crossing for each that winds about the ray.
inline QuadCrossings triangle_crossings(const Quad& q, int winding) {
  const int first = crossing(q.a, q.b) + crossing(q.b, q.c) - crossing(q.a, q.c);
  return {{first, winding - first}};
}

}  // namespace plume
