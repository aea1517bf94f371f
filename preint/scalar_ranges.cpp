#include "plume/preint/scalar_ranges.h"

#include <algorithm>
#include <cassert>

namespace plume {

ScalarRanges::ScalarRanges(const Classification& classification) {
  assert(!classification.problem());
  const auto& intervals = classification.intervals;
  for (const IntervalVolume& interval : intervals) {
    ends_.push_back({interval.low, interval.high});
    const bool touched = std::any_of(intervals.begin(), intervals.end(),
                                     [&](const auto& other) { return other.low == interval.high; });
    bounds_.push_back({interval.low, false});
    if (!touched) bounds_.push_back({interval.high, true});
  }
  for (std::size_t i = 0; i < classification.isosurfaces.size(); ++i)
    bounds_.push_back({classification.isosurfaces[i].value, false, static_cast<std::int32_t>(i)});
  // Of bounds at the same place, that of an isosurface first: it stays when the others go.
  std::sort(bounds_.begin(), bounds_.end(), [](const Bound& a, const Bound& b) {
    if (a.scalar != b.scalar) return a.scalar < b.scalar;
    if (a.equal_is_below != b.equal_is_below) return b.equal_is_below;
    return a.isosurface > b.isosurface;
  });
  const auto end = std::unique(bounds_.begin(), bounds_.end(), [](const Bound& a, const Bound& b) {
    return a.scalar == b.scalar && a.equal_is_below == b.equal_is_below;
  });
  bounds_.erase(end, bounds_.end());

  interval_of_range_.assign(bounds_.size() + 1, kNothing);
  for (std::size_t range = 1; range < bounds_.size(); ++range)
    for (std::size_t i = 0; i < ends_.size(); ++i)
      if (ends_[i].low <= bounds_[range - 1].scalar && bounds_[range].scalar <= ends_[i].high)
        interval_of_range_[range] = static_cast<std::int32_t>(i);
}

std::size_t ScalarRanges::range_of(float scalar) const {
  const auto above = std::partition_point(bounds_.begin(), bounds_.end(), [&](const Bound& bound) {
    return bound.equal_is_below ? bound.scalar < scalar : bound.scalar <= scalar;
  });
  return static_cast<std::size_t>(above - bounds_.begin());
}

float ScalarRanges::w_of(std::int32_t interval, float scalar) const {
  const double low = this->low(interval), high = this->high(interval);
  return static_cast<float>(std::clamp((scalar - low) / (high - low), 0.0, 1.0));
}

float ScalarRanges::scalar_of(std::int32_t interval, float w) const {
  const double low = this->low(interval), high = this->high(interval);
  return static_cast<float>(w < 1 ? low + w * (high - low) : high);
}

}  // namespace plume
