/// The coordinates that a walkable mesh is kept in: about its centre, of size one.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "plume/mesh/array.h"

namespace plume {

/// Axis-aligned bounds in world coordinates.
struct Bounds {
  std::array<double, 3> low{0, 0, 0};   ///< least x, y, z
  std::array<double, 3> high{0, 0, 0};  ///< greatest x, y, z

  /// Halfway between low and high.
  std::array<double, 3> center() const {
    return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
  }
  /// Distance of low from high.
  double diagonal() const {
    return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  }
};

/// A point as walkers read it: 16 bytes, position in the local frame and the scalar.
struct WalkablePoint {
  float position[3];  ///< in the local frame
  float scalar;       ///< 0 where the field is on cells
};

/// Maps world to local coordinates: (world - center) * scale. The mesh comes to lie in [-1, 1]^3,
/// so that float's whole precision serves its extent, wherever it lies and however large it is;
/// scale is a power of two, so that scaling a mesh by one changes no decision of any ray.
struct LocalFrame {
  std::array<double, 3> center{0, 0, 0};  ///< what becomes 0, in world coordinates
  double scale = 1;                       ///< a power of two

  /// The one for these bounds.
  static LocalFrame of(const Bounds& bounds) {
    LocalFrame frame;
    frame.center = bounds.center();
    double half = 0;
    for (std::size_t a = 0; a < 3; ++a) half = std::fmax(half, bounds.high[a] - frame.center[a]);
    if (half > 0) frame.scale = std::exp2(-std::ceil(std::log2(half)));
    return frame;
  }

  /// No coordinate is -0, so that none is in a sheared frame, where signs are bits.
  WalkablePoint local(double x, double y, double z, float scalar) const {
    return {{coordinate(x, 0), coordinate(y, 1), coordinate(z, 2)}, scalar};
  }

 private:
  float coordinate(double x, std::size_t axis) const {
    return static_cast<float>((x - center[axis]) * scale) + 0.0f;
  }
};

/// Bounds of interleaved x, y, z. Throws Error, naming the first point, where a coordinate is NaN
/// or infinite, and where there is no point at all.
Bounds bounds_of(const Array& points);

}  // namespace plume
