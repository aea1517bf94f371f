#include "plume/preint/visible_scalars.h"

#include <algorithm>
#include <limits>

namespace plume {

VisibleScalars::VisibleScalars(const TransferFunction& volume) {
  add(volume);
  merge();
}

VisibleScalars::VisibleScalars(const Classification& classification) {
  if (classification.volume) add(*classification.volume);
  for (const IntervalVolume& interval : classification.intervals)
    ranges_.push_back({interval.low, interval.high});
  for (const Isosurface& surface : classification.isosurfaces)
    ranges_.push_back({surface.value, surface.value});
  merge();
}

void VisibleScalars::add(const TransferFunction& volume) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto& knots = volume.knots;
  if (knots.front().optics.extinction > 0) ranges_.push_back({-kInfinity, knots.front().scalar});
  for (std::size_t k = 1; k < knots.size(); ++k)
    if (knots[k - 1].optics.extinction > 0 || knots[k].optics.extinction > 0)
      ranges_.push_back({knots[k - 1].scalar, knots[k].scalar});
  if (knots.back().optics.extinction > 0) ranges_.push_back({knots.back().scalar, kInfinity});
}

void VisibleScalars::merge() {
  std::sort(ranges_.begin(), ranges_.end(),
            [](const Range& a, const Range& b) { return a.low < b.low; });
  std::vector<Range> merged;
  for (const Range& range : ranges_) {
    if (merged.empty() || range.low > merged.back().high)
      merged.push_back(range);
    else
      merged.back().high = std::max(merged.back().high, range.high);
  }
  ranges_ = std::move(merged);
}

}  // namespace plume
