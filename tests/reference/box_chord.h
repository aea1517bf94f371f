/// How much of a line lies in an axis-aligned box: the textbook's slabs, in double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plume::reference {

/// Where the line origin + t * direction enters and leaves the box; empty (first above second)
/// where it misses.
inline std::array<double, 2> box_span(const std::array<double, 3>& low,
                                      const std::array<double, 3>& high,
                                      const std::array<double, 3>& origin,
                                      const std::array<double, 3>& direction) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double enter = -kInfinity, leave = kInfinity;
  for (std::size_t a = 0; a < 3; ++a) {
    if (direction[a] == 0) {
      if (origin[a] < low[a] || origin[a] > high[a]) return {kInfinity, -kInfinity};
      continue;
    }
    const double t0 = (low[a] - origin[a]) / direction[a];
    const double t1 = (high[a] - origin[a]) / direction[a];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return {enter, leave};
}

/// Length of that part; `direction` has length one.
inline double box_chord(const std::array<double, 3>& low, const std::array<double, 3>& high,
                        const std::array<double, 3>& origin,
                        const std::array<double, 3>& direction) {
  const auto span = box_span(low, high, origin, direction);
  return std::max(0.0, span[1] - span[0]);
}

/// What rounding may make of a chord: that with the box made smaller and larger by `slack` on every
/// side, and `slack` on top. A ray in the plane of a side sees all or nothing of it.
inline std::array<double, 2> box_chord_range(std::array<double, 3> low, std::array<double, 3> high,
                                             const std::array<double, 3>& origin,
                                             const std::array<double, 3>& direction, double slack) {
  std::array<double, 3> inner_low = low, inner_high = high;
  for (std::size_t a = 0; a < 3; ++a) {
    inner_low[a] += slack;
    inner_high[a] -= slack;
    low[a] -= slack;
    high[a] += slack;
  }
  return {box_chord(inner_low, inner_high, origin, direction) - slack,
          box_chord(low, high, origin, direction) + slack};
}

}  // namespace plume::reference
