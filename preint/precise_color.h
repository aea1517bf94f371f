/// What a segment adds to a picture, before it is rounded to floats.
#pragma once

#include <array>
#include <cstddef>

#include "plume/preint/segment_optics.h"

namespace plume {

/// As SegmentColor. Opacity, not transparency, so that it keeps its relative precision where a
/// segment is nearly transparent.
struct PreciseColor {
  std::array<double, 3> rgb{0, 0, 0};  ///< radiance, premultiplied
  double alpha = 0;                    ///< opacity, 0 to 1

  /// Composites what lies behind.
  void add_behind(const PreciseColor& behind) {
    const double transparency = 1 - alpha;
    for (std::size_t channel = 0; channel < 3; ++channel)
      rgb[channel] += transparency * behind.rgb[channel];
    alpha += transparency * behind.alpha;
  }

  /// In single precision.
  SegmentColor rounded() const {
    return {saturated_float(rgb[0]), saturated_float(rgb[1]), saturated_float(rgb[2]),
            saturated_float(alpha)};
  }
};

}  // namespace plume
