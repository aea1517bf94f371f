/// Segments, front to back, into one pixel.
#pragma once

#include <array>

#include "plume/preint/segment_optics.h"

namespace plume {

/// Accumulates segments in the order in which a ray meets them, the nearest first.
///
/// Sums are kept in double: a million segments add no more than 1e-9 to the error of each, which is
/// that of its float alpha and colour (3e-8 of their value).
struct Compositor {
  /// Radiance so far, linear RGB, premultiplied.
  std::array<double, 3> rgb{0, 0, 0};
  /// How much of what lies behind is still seen, in [0, 1].
  double transmittance = 1;

  /// Puts a segment behind all that were added before it.
  void add(const SegmentColor& segment) {
    rgb[0] += transmittance * segment.r;
    rgb[1] += transmittance * segment.g;
    rgb[2] += transmittance * segment.b;
    transmittance -= transmittance * segment.alpha;
  }

  /// Opacity so far, in [0, 1].
  double alpha() const { return 1 - transmittance; }

  /// True where the ray may stop (early ray termination). All that lies behind would change a
  /// colour channel by at most `threshold` times the largest value of that channel in the transfer
  /// function, and alpha by at most `threshold`. A threshold of 0 is never reached early: it stops
  /// no ray but one that nothing can change.
  bool opaque(double threshold) const { return transmittance <= threshold; }
};

}  // namespace plume
