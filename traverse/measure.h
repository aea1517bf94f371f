/// "Faces measure": where a ray crosses a face that the edges have decided it crosses.
///
/// The measurement never overrules the decision: rounding may put the crossing outside of the face;
/// the place is then taken between the edges that the bits say the ray passes between. Computed in
/// double from the sheared, single-precision vertices; the error of z is that of the vertices, some
/// 2e-7 of the mesh's size, divided by the cosine between ray and face, and never beyond the face's
/// own range of z.
#pragma once

#include <algorithm>
#include <cmath>

#include "plume/traverse/sheared_frame.h"

namespace plume {

/// Where a ray crosses a face: z in the sheared frame, and the scalar there.
struct Crossing {
  double z;
  float scalar;
};

/// Where a face's loop crosses y = 0 next to the ray, on its right and on its left: one edge each
/// way, as the bits have it. The ray passes between the two places.
struct Straddle {
  const ShearedPoint* right[2] = {nullptr, nullptr};  ///< low and high end
  const ShearedPoint* left[2] = {nullptr, nullptr};
  double right_product = 0;  ///< low.x * high.y - high.x * low.y >= 0
  double left_product = 0;   ///< its negative, >= 0

  /// Takes an edge of the loop into account; of several on one side, the one nearest to the ray.
  void add(const ShearedPoint& a, const ShearedPoint& b) {
    if (a.up() == b.up()) return;
    const ShearedPoint& low = a.up() ? b : a;
    const ShearedPoint& high = a.up() ? a : b;
    const double product = static_cast<double>(low.x) * static_cast<double>(high.y) -
                           static_cast<double>(high.x) * static_cast<double>(low.y);
    const bool on_right = right_of_ray(low, high) != 0;
    const double distance = std::max(0.0, on_right ? product : -product);
    const ShearedPoint** const ends = on_right ? right : left;
    double& nearest = on_right ? right_product : left_product;
    // Distances along x are products divided by the edge's extent in y.
    if (ends[0] != nullptr && distance * (static_cast<double>(ends[1]->y) - ends[0]->y) >=
                                  nearest * (static_cast<double>(high.y) - low.y))
      return;
    ends[0] = &low;
    ends[1] = &high;
    nearest = distance;
  }

  /// The place on the line between the two where the ray passes: on the ray whatever the rounding,
  /// as x = y = 0 there by construction. All weights are >= 0. Requires an edge on the right.
  Crossing measure() const {
    // Where right or left edge cross y = 0, times their extent in y, weighted by the distance to
    // the other; if both edges pass through the ray, one of them will do.
    const bool both = left[0] != nullptr && left_product + right_product > 0;
    const double of_right = both ? left_product : 1;
    const double of_left = both ? right_product : 0;
    double sum = 0, z = 0, scalar = 0;
    auto add_end = [&](double weight, const ShearedPoint& p) {
      sum += weight;
      z += weight * p.z;
      scalar += weight * static_cast<double>(p.scalar);
    };
    add_end(of_right * right[1]->y, *right[0]);
    add_end(of_right * -right[0]->y, *right[1]);
    if (both) {
      add_end(of_left * left[1]->y, *left[0]);
      add_end(of_left * -left[0]->y, *left[1]);
    }
    return {z / sum, static_cast<float>(scalar / sum)};
  }
};

/// A triangle that winds about the ray: the place between the two edges that cross y = 0. They meet
/// in the corner that has its side of y = 0 for itself. The same as barycentric coordinates from
/// three Plücker products, of which two may contradict the bits, and each other, where the triangle
/// is seen edge-on; the place would then lie beside the ray.
inline Crossing measure_triangle(const ShearedPoint& a, const ShearedPoint& b,
                                 const ShearedPoint& c) {
  const bool ab = a.up() != b.up(), ac = a.up() != c.up();
  const ShearedPoint& lone = ab && ac ? a : ab ? b : c;
  const ShearedPoint& p = ab && !ac ? a : b;
  const ShearedPoint& q = ac && !ab ? a : c;
  const double lone_x = lone.x, lone_y = lone.y;
  // Where the edge to p crosses y = 0, how far from the ray, times p_height; the same for q.
  const double p_height = p.y - lone_y, q_height = q.y - lone_y;
  const double p_distance = std::abs(lone_x * p.y - p.x * lone_y);
  // If both edges pass through the ray, one of them will do.
  constexpr double kNothing = 1e-200;
  const double q_distance = std::max(std::abs(lone_x * q.y - q.x * lone_y), kNothing);
  const double share = -lone_y / (p_distance * q_height + q_distance * p_height);
  const double of_p = q_distance * share, of_q = p_distance * share;
  auto blend = [&](double at_lone, double at_p, double at_q) {
    return at_lone + of_p * (at_p - at_lone) + of_q * (at_q - at_lone);
  };
  return {blend(lone.z, p.z, q.z), static_cast<float>(blend(lone.scalar, p.scalar, q.scalar))};
}

/// A quadrilateral, planar or twisted: the bilinear patch through a, b, c, d in the order of the
/// loop, which must be the same for the cells on both sides.
///
/// (u, v) solve a quadratic in v. At its two roots the patch's Jacobian is plus and minus the root
/// of the discriminant, so the ray crosses once in each direction, and the winding number says
/// which crossing lies in the unit square (the signed number of crossings inside a loop is its
/// winding number about the ray). So the root is chosen by sign, not by trying the unit square, and
/// that choice is also the numerically stable one for parallelograms, where the other root is at
/// infinity. Patch: Ramsey, Potter, Hansen, "Ray Bilinear Patch Intersections" (JGT 2004); stable
/// roots: Reshetov, "Cool Patches" (Ray Tracing Gems, 2019).
inline Crossing measure_patch(const ShearedPoint& a, const ShearedPoint& b, const ShearedPoint& c,
                              const ShearedPoint& d, int winding) {
  struct Vector {
    double x, y;
  };
  auto cross = [](const Vector& p, const Vector& q) { return p.x * q.y - p.y * q.x; };
  const double ax = a.x, ay = a.y;
  const Vector e{b.x - ax, b.y - ay};
  const Vector f{d.x - ax, d.y - ay};
  const Vector g{ax - b.x + c.x - d.x, ay - b.y + c.y - d.y};
  const Vector h{-ax, -ay};
  const double k0 = cross(h, e), k1 = cross(h, g) + cross(e, f), k2 = cross(g, f);
  const double root = std::sqrt(std::max(0.0, k1 * k1 - 4 * k0 * k2));
  const double jacobian = winding > 0 ? root : -root;
  double v = k1 * jacobian > 0 || k2 == 0 ? -2 * k0 / (k1 + jacobian) : (jacobian - k1) / (2 * k2);
  // Outside of the patch, or no number at all, only by rounding, where the ray passes by the
  // boundary or the patch is seen edge-on. Then the place between the edges next to the ray is as
  // near to the patch, and on the ray.
  auto between_edges = [&] {
    Straddle straddle;
    straddle.add(a, b);
    straddle.add(b, c);
    straddle.add(c, d);
    straddle.add(d, a);
    return straddle.measure();
  };
  if (!(v >= 0 && v <= 1)) return between_edges();
  const Vector across{e.x + g.x * v, e.y + g.y * v};
  const double u = std::abs(across.x) > std::abs(across.y) ? (h.x - f.x * v) / across.x
                                                           : (h.y - f.y * v) / across.y;
  if (!(u >= 0 && u <= 1)) return between_edges();
  auto blend = [u, v](double va, double vb, double vc, double vd) {
    return (1 - v) * ((1 - u) * va + u * vb) + v * ((1 - u) * vd + u * vc);
  };
  return {blend(a.z, b.z, c.z, d.z),
          static_cast<float>(blend(a.scalar, b.scalar, c.scalar, d.scalar))};
}

/// A polygon: the fan of triangles around its centre (the mean of its points and of their
/// scalars), planar or not. The windings of the fan's triangles sum to the polygon's, so one of
/// them has its sign; the first such is crossed.
template <class Loop>
Crossing measure_polygon(const Loop& loop, int winding) {
  ShearedPoint center{0, 0, 0, 0};
  for (const ShearedPoint& p : loop) {
    center.x += p.x;
    center.y += p.y;
    center.z += p.z;
    center.scalar += p.scalar;
  }
  const float count = static_cast<float>(loop.size());
  center = {center.x / count, center.y / count, center.z / count, center.scalar / count};
  const ShearedPoint* from = &loop[loop.size() - 1];
  for (const ShearedPoint& to : loop) {
    const int w = crossing(center, *from) + crossing(*from, to) + crossing(to, center);
    if (w * winding > 0) return measure_triangle(center, *from, to);
    from = &to;
  }
  return {center.z, center.scalar};  // not reached for winding != 0
}

}  // namespace plume
