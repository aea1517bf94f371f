/// Where a ray crosses a quadrilateral: z and scalar of the crossings that quad_crossings.h decides
/// on. In double from the sheared, single-precision vertices.
#pragma once

#include <algorithm>
#include <cmath>

#include "plume/traverse/measure.h"
#include "plume/traverse/quad_crossings.h"

namespace plume {

/// z and scalar of the bilinear patch at (u, v).
inline Crossing blend_corners(const Quad& q, double u, double v) {
  auto blend = [u, v](double a, double b, double c, double d) {
    return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * d + u * c);
  };
  return {blend(q.a.z, q.b.z, q.c.z, q.d.z),
          static_cast<float>(blend(q.a.scalar, q.b.scalar, q.c.scalar, q.d.scalar))};
}

/// The place between the edges next to the ray, of a loop that winds about it.
inline Crossing measure_straddle(const Quad& q) {
  Straddle straddle;
  straddle.add(q.a, q.b);
  straddle.add(q.b, q.c);
  straddle.add(q.c, q.d);
  straddle.add(q.d, q.a);
  return straddle.measure();
}

/// Where the ray is on the line of constant v across the patch, 0 to 1 inside. By the coordinate in
/// which the line is longer: where the patch is seen edge-on and v is little more than rounding,
/// the place is still next to the ray.
inline double across_patch(const Quad& q, double v) {
  const double ax = q.a.x, ay = q.a.y, bx = q.b.x, by = q.b.y;
  const double left_x = ax + v * (q.d.x - ax), left_y = ay + v * (q.d.y - ay);
  const double x = bx + v * (q.c.x - bx) - left_x, y = by + v * (q.c.y - by) - left_y;
  return std::abs(x) > std::abs(y) ? -left_x / x : -left_y / y;
}

/// A quadrilateral, planar or twisted, as the bilinear patch
/// (1-v) ((1-u) a + u b) + v ((1-u) d + u c); its crossing in `direction` (1 or -1).
///
/// v is a root of a quadratic. At its two roots the patch's Jacobian is plus and minus the root of
/// the discriminant, so the ray crosses once in each direction, and the winding number says which
/// crossing lies in the unit square (the signed number of crossings inside a loop is its winding
/// number about the ray). So the root is chosen by sign, not by trying the unit square, and that
/// choice is also the numerically stable one for parallelograms, where the other root is at
/// infinity.
///
/// From Ramsey, Potter, Hansen, "Ray Bilinear Patch Intersections" (JGT 2004) we take the
/// elimination of the ray's parameter (here the shear has done it) and the division by the larger
/// of two denominators; not their trying of both roots. From Reshetov, "Cool Patches" (Ray Tracing
/// Gems, 2019), that the root without cancellation is computed and the other would follow from the
/// product of both, so that a leading coefficient of nearly zero needs no case of its own.
///
/// `grazed`: the loop's winding is 0 and both crossings are inside (QuadCrossings::grazed()). All
/// terms of both roots then have one sign, so that they are exact but for rounding and the root of
/// the discriminant, and the two are told apart even where they nearly coincide.
inline Crossing measure_patch(const Quad& q, int direction, bool grazed) {
  const double v0 = edge_product(q.a, q.b), v2 = edge_product(q.d, q.c);
  const double v1 = edge_product(q.a, q.c) - edge_product(q.b, q.d);
  const double slope = 2 * v0 - v1, bend = v1 - v0 - v2;  // bend v^2 + slope v - v0 = 0
  const double root = std::sqrt(std::max(0.0, v1 * v1 - 4 * (v0 * v2)));
  const double jacobian = direction > 0 ? root : -root;
  const double v = slope * jacobian > 0 || bend == 0 ? 2 * v0 / (slope + jacobian)
                                                     : (jacobian - slope) / (2 * bend);
  const double u = across_patch(q, v);
  if (grazed) return blend_corners(q, std::clamp(u, 0.0, 1.0), std::min(v, 1.0));
  // Outside of the patch, or no number at all, only by rounding, where the ray passes by the
  // boundary or the patch is seen edge-on. Then the place between the edges next to the ray is as
  // near to the patch, and on the ray.
  return u >= 0 && u <= 1 && v >= 0 && v <= 1 ? blend_corners(q, u, v) : measure_straddle(q);
}

/// A planar quadrilateral. Where it is a parallelogram, v is a quotient of products: no root is
/// taken; neither where the quadratic term changes v by no more than 2^-24 of itself, single
/// precision's share. Otherwise as a patch, whose blend lies in the plane.
inline Crossing measure_planar(const Quad& q, int direction) {
  const double v0 = edge_product(q.a, q.b), v2 = edge_product(q.d, q.c);
  const double v1 = edge_product(q.a, q.c) - edge_product(q.b, q.d);
  const double slope = 2 * v0 - v1, bend = v1 - v0 - v2;
  constexpr double kLinear = 0x1p-24;
  if (std::abs(v0 * bend) <= kLinear * (slope * slope)) {
    const double v = v0 / slope, u = across_patch(q, v);
    if (u >= 0 && u <= 1 && v >= 0 && v <= 1) return blend_corners(q, u, v);
  }
  return measure_patch(q, direction, false);
}

/// The triangles a, b, c (rank 0) and a, c, d (rank 1).
inline Crossing measure_half(const Quad& q, int rank) {
  return rank == 0 ? measure_triangle(q.a, q.b, q.c) : measure_triangle(q.a, q.c, q.d);
}

}  // namespace plume
