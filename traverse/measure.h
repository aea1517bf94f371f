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
///
/// The same bits whatever the order of a, b and c: both cells at a face, and whoever comes to it by
/// another way, measure the same.
inline Crossing measure_triangle(const ShearedPoint& a, const ShearedPoint& b,
                                 const ShearedPoint& c) {
  const bool ab = a.up() != b.up(), ac = a.up() != c.up();
  const ShearedPoint& lone = ab && ac ? a : ab ? b : c;
  const ShearedPoint& p = ab && !ac ? a : b;
  const ShearedPoint& q = ac && !ab ? a : c;
  const double lone_x = lone.x, lone_y = lone.y;
  // Where the edge to p crosses y = 0, how far from the ray, times p_height; the same for q.
  const double p_height = p.y - lone_y, q_height = q.y - lone_y;
  // If both edges pass through the ray, the place is half way between them.
  constexpr double kNothing = 1e-200;
  const double p_distance = std::max(std::abs(lone_x * p.y - p.x * lone_y), kNothing);
  const double q_distance = std::max(std::abs(lone_x * q.y - q.x * lone_y), kNothing);
  const double share = -lone_y / (p_distance * q_height + q_distance * p_height);
  const double of_p = q_distance * share, of_q = p_distance * share;
  auto blend = [&](double at_lone, double at_p, double at_q) {
    return at_lone + (of_p * (at_p - at_lone) + of_q * (at_q - at_lone));
  };
  return {blend(lone.z, p.z, q.z), static_cast<float>(blend(lone.scalar, p.scalar, q.scalar))};
}

}  // namespace plume
