/// A ray in world coordinates.
#pragma once

#include <array>
#include <limits>

namespace plume {

/// From an origin along a direction, between two distances.
struct Ray {
  std::array<double, 3> origin{0, 0, 0};  ///< where t is 0
  /// Of length one: then t is a distance in world units. A direction that is zero or not finite
  /// meets nothing.
  std::array<double, 3> direction{0, 0, 1};
  /// Only what lies between is seen; t_min < 0 looks behind the origin.
  double t_min = 0;
  /// The far end.
  double t_max = std::numeric_limits<double>::infinity();
};

}  // namespace plume
