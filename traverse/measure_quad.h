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

/// A quadrilateral, planar or twisted, as the bilinear patch
/// (1-v) ((1-u) a + u b) + v ((1-u) d + u c); its crossing in `direction` (1 or -1).
///
/// u and v are roots of two quadratics of one discriminant. At its roots the patch's Jacobian is
/// plus and minus the discriminant's root, so the ray crosses once in each direction, and the
/// winding number says which crossing lies in the unit square (the signed number of crossings
/// inside a loop is its winding number about the ray). So the root is chosen by sign, not by trying
/// the unit square, and that choice is also the numerically stable one for parallelograms, where
/// the other root is at infinity.
///
/// From Ramsey, Potter, Hansen, "Ray Bilinear Patch Intersections" (JGT 2004) we take the
/// elimination of the ray's parameter (here the shear has done it); not their order of trying both
/// roots and discarding those outside of the square, nor their tests for coefficients that are
/// zero. From Reshetov, "Cool Patches" (Ray Tracing Gems, 2019), that the root without cancellation
/// is computed and the other follows from the product of both, so that a leading coefficient of
/// nearly zero needs no case of its own; not his solving for one parameter alone, as the second
/// quadratic here costs one division that waits for nothing.
///
/// `grazed`: the loop's winding is 0 and both crossings are inside (QuadCrossings::grazed()). All
/// terms of both roots then have one sign, so that they are exact but for rounding and the root of
/// the discriminant, and the two are told apart even where they nearly coincide.
inline Crossing measure_patch(const Quad& q, int direction, bool grazed) {
  const PatchQuadratics k(q);
  const double root = std::sqrt(std::max(0.0, k.v1 * k.v1 - 4 * (k.v0 * k.v2)));
  const double jacobian = direction > 0 ? root : -root;
  // c0 + c1 t + c2 t^2 = 0, the derivative being the Jacobian.
  auto solve = [jacobian](double c0, double c1, double c2) {
    return c1 * jacobian > 0 || c2 == 0 ? -2 * c0 / (c1 + jacobian) : (jacobian - c1) / (2 * c2);
  };
  const double v = solve(-k.v0, 2 * k.v0 - k.v1, k.v1 - k.v0 - k.v2);
  const double u = solve(k.u0, k.u1 - 2 * k.u0, k.u0 - k.u1 + k.u2);
  if (grazed) return blend_corners(q, std::min(u, 1.0), std::min(v, 1.0));
  // Outside of the patch, or no number at all, only by rounding, where the ray passes by the
  // boundary or the patch is seen edge-on. Then the place between the edges next to the ray is as
  // near to the patch, and on the ray.
  return u >= 0 && u <= 1 && v >= 0 && v <= 1 ? blend_corners(q, u, v) : measure_straddle(q);
}

/// A planar quadrilateral. Where it is a parallelogram, u and v are quotients of products: no root
/// is taken. So it is, too, where the quadratic terms change neither by more than 2^-24 of itself,
/// single precision's share. Otherwise as a patch, whose blend lies in the plane.
inline Crossing measure_planar(const Quad& q, int direction) {
  const PatchQuadratics k(q);
  const double v_slope = 2 * k.v0 - k.v1, u_slope = 2 * k.u0 - k.u1;
  const double v_bend = k.v1 - k.v0 - k.v2, u_bend = k.u1 - k.u0 - k.u2;
  constexpr double kLinear = 0x1p-24;
  if (std::abs(k.v0 * v_bend) <= kLinear * (v_slope * v_slope) &&
      std::abs(k.u0 * u_bend) <= kLinear * (u_slope * u_slope)) {
    const double u = k.u0 / u_slope, v = k.v0 / v_slope;
    if (u >= 0 && u <= 1 && v >= 0 && v <= 1) return blend_corners(q, u, v);
  }
  return measure_patch(q, direction, false);
}

/// The triangles a, b, c (rank 0) and a, c, d (rank 1).
inline Crossing measure_half(const Quad& q, int rank) {
  return rank == 0 ? measure_triangle(q.a, q.b, q.c) : measure_triangle(q.a, q.c, q.d);
}

}  // namespace plume
