#include "plume/preint/preintegrated_table.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace plume {

namespace {

/// Where a position on an axis falls between two entries.
struct Between {
  std::size_t first;
  float weight_of_second;
};

Between locate(float position, std::size_t count) {
  const float last_first = static_cast<float>(count - 2);
  const float clamped = std::clamp(position, 0.0f, last_first + 1);
  const float first = std::min(std::floor(clamped), last_first);
  return {static_cast<std::size_t>(first), clamped - first};
}

/// Entry i of n on a line from `first` to `last`, both exact.
double on_line(double first, double last, std::size_t i, std::size_t n) {
  if (i + 1 == n) return last;
  return first + (last - first) * (static_cast<double>(i) / static_cast<double>(n - 1));
}

}  // namespace

PreintegratedTable::PreintegratedTable(const TransferFunction& transfer_function,
                                       const TableSettings& settings)
    : closed_form_(transfer_function),
      depth_(transfer_function),
      scalar_count_(static_cast<std::size_t>(settings.scalar_count)),
      length_count_(static_cast<std::size_t>(settings.length_count)) {
  assert(settings.scalar_count >= 2 && settings.length_count >= 2);
  choose_ranges(transfer_function, settings);
  if (longest_ > 0) fill();
}

void PreintegratedTable::choose_ranges(const TransferFunction& transfer_function,
                                       const TableSettings& settings) {
  const auto& knots = transfer_function.knots;
  const auto [lowest, highest] =
      settings.scalar_range.value_or(std::array{knots.front().scalar, knots.back().scalar});
  assert(!settings.scalar_range || lowest < highest);
  if (lowest == highest) return;
  const double mean = depth_.mean_extinction(lowest, highest);
  if (mean == 0) return;
  lowest_ = lowest;
  highest_ = highest;
  scalar_density_ = static_cast<double>(scalar_count_ - 1) /
                    (static_cast<double>(highest) - static_cast<double>(lowest));
  if (settings.length_range) {
    shortest_ = (*settings.length_range)[0];
    longest_ = (*settings.length_range)[1];
    assert(shortest_ > 0 && shortest_ < longest_);
  } else {
    double greatest = 0;
    for (const auto& knot : knots) {
      greatest = std::max(greatest, static_cast<double>(knot.optics.extinction));
    }
    constexpr double smallest_float = std::numeric_limits<float>::min();
    shortest_ = saturated_float(std::max(0.01 / greatest, smallest_float));
    longest_ = saturated_float(100 / mean);
  }
  shortest_log2_ = std::log2(shortest_);
  length_density_ = static_cast<float>(length_count_ - 1) / (std::log2(longest_) - shortest_log2_);
}

void PreintegratedTable::fill() {
  entries_.resize(length_count_ * scalar_count_ * scalar_count_);
  const auto scalar_of = [this](std::size_t i) {
    return static_cast<float>(on_line(lowest_, highest_, i, scalar_count_));
  };
  const std::size_t rows = length_count_ * scalar_count_;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows), [&](const auto& range) {
    for (std::size_t row = range.begin(); row != range.end(); ++row) {
      const float back = scalar_of(row % scalar_count_);
      const auto length = static_cast<float>(std::exp2(
          on_line(shortest_log2_, std::log2(longest_), row / scalar_count_, length_count_)));
      for (std::size_t i = 0; i < scalar_count_; ++i) {
        const float front = scalar_of(i);
        const SegmentColor color = closed_form_.integrate(front, back, length);
        if (color.alpha == 0) continue;
        const double mean = depth_.mean_extinction(front, back);
        const double scale = mean / color.alpha;
        entries_[row * scalar_count_ + i].values = {
            saturated_float(color.r * scale), saturated_float(color.g * scale),
            saturated_float(color.b * scale), saturated_float(mean)};
      }
    }
  });
}

PreintegratedTable::Entry PreintegratedTable::blend(const Entry& first, const Entry& second,
                                                    float weight_of_second) {
  Entry result;
  for (std::size_t i = 0; i < 4; ++i) {
    result.values[i] =
        first.values[i] * (1 - weight_of_second) + second.values[i] * weight_of_second;
  }
  return result;
}

SegmentColor PreintegratedTable::integrate(float s_in, float s_out, float length) const {
  // Written so that NaN, and every scalar where there is no table, goes to the closed form.
  const auto covered = [this](float scalar) { return scalar >= lowest_ && scalar <= highest_; };
  if (entries_.empty() || !covered(s_in) || !covered(s_out) || !(length > 0) || length > longest_) {
    return closed_form_.integrate(s_in, s_out, length);
  }
  const auto position = [this](float scalar) {
    return static_cast<float>((static_cast<double>(scalar) - lowest_) * scalar_density_);
  };
  const Between front = locate(position(s_in), scalar_count_);
  const Between back = locate(position(s_out), scalar_count_);
  const Between level =
      locate((std::log2(length) - shortest_log2_) * length_density_, length_count_);

  const auto along_front = [&](std::size_t level_index, std::size_t back_index) {
    const Entry* entry =
        &entries_[(level_index * scalar_count_ + back_index) * scalar_count_ + front.first];
    return blend(entry[0], entry[1], front.weight_of_second);
  };
  const auto along_both = [&](std::size_t level_index) {
    return blend(along_front(level_index, back.first), along_front(level_index, back.first + 1),
                 back.weight_of_second);
  };
  const Entry found =
      blend(along_both(level.first), along_both(level.first + 1), level.weight_of_second);

  const float mean = found.values[3];
  if (!(mean > 0)) return {};
  const float alpha = -std::expm1(-mean * length);
  const float scale = alpha / mean;
  return {found.values[0] * scale, found.values[1] * scale, found.values[2] * scale, alpha};
}

}  // namespace plume
