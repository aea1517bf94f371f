/// How much of a line lies in an axis-aligned box: the textbook's slabs, in double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plume::reference {

/// Length of the part of the line origin + t * direction (of length one) inside of the box.
inline double box_chord(const std::array<double, 3>& low, const std::array<double, 3>& high,
                        const std::array<double, 3>& origin,
                        const std::array<double, 3>& direction) {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < 3; ++a) {
    if (direction[a] == 0) {
      if (origin[a] < low[a] || origin[a] > high[a]) return 0;
      continue;
    }
    const double t0 = (low[a] - origin[a]) / direction[a];
    const double t1 = (high[a] - origin[a]) / direction[a];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return std::max(0.0, leave - enter);
}

}  // namespace plume::reference
