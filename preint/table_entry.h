/// An entry of a pre-integrated table, and how entries are read.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "plume/preint/precise_color.h"
#include "plume/preint/psi.h"

namespace plume {

/// q for red, green and blue, then m: the mean extinction m, which no length changes, and q = m * C
/// / alpha, the colour weighted by it. Both stay finite and smooth from the shortest to the longest
/// segment, and entries without extinction lend no colour to their neighbours.
struct alignas(16) TableEntry {
  std::array<float, 4> values{0, 0, 0, 0};  ///< q for red, green, blue; then m

  /// Of a segment with that mean extinction.
  static TableEntry of(const PreciseColor& color, double mean_extinction) {
    if (!(color.alpha > 0)) return {{0, 0, 0, saturated_float(mean_extinction)}};
    const double scale = mean_extinction / color.alpha;
    return {{saturated_float(color.rgb[0] * scale), saturated_float(color.rgb[1] * scale),
             saturated_float(color.rgb[2] * scale), saturated_float(mean_extinction)}};
  }

  /// Adds a share of another: what interpolation sums up.
  void add(const TableEntry& other, float weight) {
    for (std::size_t i = 0; i < 4; ++i) values[i] += weight * other.values[i];
  }

  /// alpha = 1 - exp(-m length), C = q * alpha / m.
  SegmentColor color(float length) const {
    const float mean = values[3];
    if (!(mean > 0)) return {};
    const auto alpha = static_cast<float>(absorbed(static_cast<double>(mean) * length));
    const float scale = alpha / mean;
    return {values[0] * scale, values[1] * scale, values[2] * scale, alpha};
  }
};

}  // namespace plume
