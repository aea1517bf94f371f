/// "Faces measure": where a ray crosses a face that the edges have decided it crosses.
///
/// The measurement never overrules the decision: rounding may put the crossing outside of the face,
/// and is then clamped to it. Computed in double from the sheared, single-precision vertices; the
/// error of z is that of the vertices, some 2e-7 of the mesh's size, divided by the cosine between
/// ray and face, and never beyond the face's own range of z.
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

/// A triangle: barycentric coordinates from the three Plücker products of ray and edges. Where all
/// vanish (a triangle seen edge-on), its centre.
inline Crossing measure_triangle(const ShearedPoint& a, const ShearedPoint& b,
                                 const ShearedPoint& c, int winding) {
  auto product = [winding](const ShearedPoint& p, const ShearedPoint& q) {
    const double value = static_cast<double>(p.x) * static_cast<double>(q.y) -
                         static_cast<double>(p.y) * static_cast<double>(q.x);
    return std::max(0.0, winding > 0 ? value : -value);
  };
  double wa = product(b, c), wb = product(c, a), wc = product(a, b);
  double sum = wa + wb + wc;
  if (!(sum > 0)) {
    wa = wb = wc = 1;
    sum = 3;
  }
  auto blend = [&](double va, double vb, double vc) { return (wa * va + wb * vb + wc * vc) / sum; };
  return {blend(a.z, b.z, c.z), static_cast<float>(blend(a.scalar, b.scalar, c.scalar))};
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
  // Not a number only where the patch is seen edge-on: then any point of it will do.
  v = std::isnan(v) ? 0.5 : std::clamp(v, 0.0, 1.0);
  const Vector across{e.x + g.x * v, e.y + g.y * v};
  double u = std::abs(across.x) > std::abs(across.y) ? (h.x - f.x * v) / across.x
                                                     : (h.y - f.y * v) / across.y;
  u = std::isnan(u) ? 0.5 : std::clamp(u, 0.0, 1.0);
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
    if (w * winding > 0) return measure_triangle(center, *from, to, winding);
    from = &to;
  }
  return {center.z, center.scalar};  // not reached for winding != 0
}

}  // namespace plume
