#include "plume/preint/interval_table.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "plume/preint/compositing.h"
#include "plume/preint/interval_optics.h"

namespace plume {
namespace {

// Of an opaque surface, which would be infinite: 1 - 2^-24.
constexpr double kMostDepth = 16.6;

struct Between {
  std::size_t first;
  double weight_of_second;
};

Between locate(double position, std::size_t count) {
  const double last = static_cast<double>(count - 1);
  const double clamped = std::clamp(position, 0.0, last);
  const double first = std::min(std::floor(clamped), last - 1);
  return {static_cast<std::size_t>(first), clamped - first};
}

}  // namespace

IntervalTable::IntervalTable(const Classification& classification,
                             std::array<float, 2> scalar_range, std::array<float, 2> length_range,
                             const IntervalTableSettings& settings)
    : ranges_(classification),
      optics_(classification),
      volume_(classification.volume.value_or(TransferFunction{{{0, {}}}})),
      scalar_count_(static_cast<std::size_t>(settings.scalar_count)),
      length_count_(static_cast<std::size_t>(settings.length_count)),
      lowest_(scalar_range[0]),
      highest_(scalar_range[1]),
      shortest_(length_range[0]),
      longest_(length_range[1]) {
  assert(settings.scalar_count >= 2 && settings.length_count >= 2);
  assert(lowest_ < highest_ && shortest_ > 0 && shortest_ < longest_);
  scalar_density_ =
      static_cast<double>(scalar_count_ - 1) / (static_cast<double>(highest_) - lowest_);
  length_density_ =
      static_cast<double>(length_count_ - 1) / std::log2(static_cast<double>(longest_) / shortest_);
  for (std::size_t i = 0; i < scalar_count_; ++i)
    interval_of_entry_.push_back(ranges_.interval_of(ranges_.range_of(scalar_of(i))));
  for (const IntervalVolume& interval : classification.intervals)
    whole_intervals_.push_back(
        IntervalOptics(interval.profile, IntervalForm::exponential).integrate(0, 1));
  fill();
}

float IntervalTable::scalar_of(std::size_t entry) const {
  if (entry + 1 == scalar_count_) return highest_;
  return static_cast<float>(lowest_ + static_cast<double>(entry) / scalar_density_);
}

std::size_t IntervalTable::nearest(float scalar) const {
  const double position = (static_cast<double>(scalar) - lowest_) * scalar_density_;
  return static_cast<std::size_t>(
      std::lround(std::clamp(position, 0.0, static_cast<double>(scalar_count_ - 1))));
}

// All that lies between two scalars, each interval from where the segment begins or comes into it.
SegmentColor IntervalTable::whole_segment(float s_in, float s_out, double length) const {
  Compositor sum;
  std::size_t range = ranges_.range_of(s_in);
  const std::size_t last = ranges_.range_of(s_out);
  const double way = std::abs(static_cast<double>(s_out) - s_in);
  float scalar = s_in;
  for (;;) {
    const bool rising = last > range;
    const bool at_end = range == last;
    const float next = at_end ? s_out : ranges_.bound(rising ? range : range - 1).scalar;
    const std::int32_t interval = ranges_.interval_of(range);
    ClassifiedPart part{ClassifiedPart::Kind::volume};
    if (interval == ScalarRanges::kNothing) {
      part.from = scalar;
      part.to = next;
      part.share_to = way > 0 ? std::abs(static_cast<double>(next) - scalar) / way : 1;
    } else {
      part = {ClassifiedPart::Kind::interval, interval, ranges_.w_of(interval, scalar),
              ranges_.w_of(interval, next)};
    }
    sum.add(optics_.color(part, length, volume_));
    if (at_end) break;
    const std::int32_t surface = ranges_.bound(rising ? range : range - 1).isosurface;
    if (surface != ScalarRanges::kNothing)
      sum.add(optics_.color({ClassifiedPart::Kind::surface, surface}, 0, volume_));
    scalar = next;
    range = rising ? range + 1 : range - 1;
  }
  return {static_cast<float>(sum.rgb[0]), static_cast<float>(sum.rgb[1]),
          static_cast<float>(sum.rgb[2]), static_cast<float>(sum.alpha())};
}

void IntervalTable::fill() {
  entries_.resize(length_count_ * scalar_count_ * scalar_count_);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, length_count_ * scalar_count_), [&](const auto& rows) {
        for (std::size_t row = rows.begin(); row != rows.end(); ++row) {
          const double level = static_cast<double>(row / scalar_count_);
          const double length = shortest_ * std::exp2(level / length_density_);
          const float back = scalar_of(row % scalar_count_);
          for (std::size_t i = 0; i < scalar_count_; ++i) {
            const SegmentColor color = whole_segment(scalar_of(i), back, length);
            if (!(color.alpha > 0)) continue;
            const double depth =
                std::min(kMostDepth, -std::log1p(-static_cast<double>(color.alpha)));
            const double scale = depth / color.alpha;
            entries_[row * scalar_count_ + i].values = {
                static_cast<float>(color.r * scale), static_cast<float>(color.g * scale),
                static_cast<float>(color.b * scale), static_cast<float>(depth)};
          }
        }
      });
}

SegmentColor IntervalTable::look_up(float s_in, float s_out, float length) const {
  auto position = [&](float s) { return (static_cast<double>(s) - lowest_) * scalar_density_; };
  const Between front = locate(position(s_in), scalar_count_);
  const Between back = locate(position(s_out), scalar_count_);
  const double within = std::clamp(length, shortest_, longest_);
  Between level = locate(std::log2(within / shortest_) * length_density_, length_count_);
  // Optical depths are linear in the length itself.
  const double low = shortest_ * std::exp2(static_cast<double>(level.first) / length_density_);
  const double high = shortest_ * std::exp2(static_cast<double>(level.first + 1) / length_density_);
  level.weight_of_second = std::clamp((within - low) / (high - low), 0.0, 1.0);
  std::array<double, 4> sum{0, 0, 0, 0};
  for (const std::size_t l : {0u, 1u})
    for (const std::size_t b : {0u, 1u})
      for (const std::size_t f : {0u, 1u}) {
        const double weight = (l == 1 ? level.weight_of_second : 1 - level.weight_of_second) *
                              (b == 1 ? back.weight_of_second : 1 - back.weight_of_second) *
                              (f == 1 ? front.weight_of_second : 1 - front.weight_of_second);
        const Entry& entry =
            entries_[((level.first + l) * scalar_count_ + back.first + b) * scalar_count_ +
                     front.first + f];
        for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * entry.values[c];
      }
  if (!(sum[3] > 0)) return {};
  const double alpha = -std::expm1(-sum[3]), scale = alpha / sum[3];
  return {static_cast<float>(sum[0] * scale), static_cast<float>(sum[1] * scale),
          static_cast<float>(sum[2] * scale), static_cast<float>(alpha)};
}

SegmentColor IntervalTable::add(State& state, float s_in, float s_out, float length) const {
  if (!std::isfinite(s_in) || !std::isfinite(s_out)) {
    state = {};
    return {};
  }
  const std::int32_t first = interval_of_entry_[nearest(s_in)];
  const std::int32_t second = interval_of_entry_[nearest(s_out)];
  SegmentColor before{};
  if (!state.inside) {
    state.inside = true;
    if (first != ScalarRanges::kNothing) {
      // Section 6.4: a ray that begins inside sees all of the interval.
      before = whole_intervals_[static_cast<std::size_t>(first)];
      state.direction = 0;
      state.interval = first;
    }
  }
  const int direction = s_out > s_in ? 1 : s_out < s_in ? -1 : 0;
  float from = s_in;
  bool nothing = false;
  if (first != ScalarRanges::kNothing && state.interval == first) {
    const bool onwards = direction != 0 && direction == state.direction;
    // What of the segment is left lies beyond the extreme, or beyond the interval.
    const bool leaves = second != first;
    const float exit = direction > 0 ? ranges_.high(first) : ranges_.low(first);
    const float limit = onwards ? state.threshold : exit;
    const bool beyond = direction > 0 ? s_out > limit : s_out < limit;
    if (onwards && beyond)
      from = direction > 0 ? std::max(s_in, limit) : std::min(s_in, limit);
    else if (leaves && beyond)
      from = exit;
    else
      nothing = true;
    if (onwards && beyond) state.threshold = s_out;
  }
  if (second == ScalarRanges::kNothing) {
    state.direction = 0;
    state.interval = ScalarRanges::kNothing;
  } else if (second != state.interval) {
    state.direction = direction;
    state.interval = second;
    state.threshold = s_out;
  }
  SegmentColor color{};
  if (!nothing) {
    const double way = static_cast<double>(s_out) - s_in;
    const double share = way != 0 ? (static_cast<double>(s_out) - from) / way : 1;
    color = look_up(from, s_out, static_cast<float>(share * length));
  }
  if (!(before.alpha > 0)) return color;
  Compositor both;
  both.add(before);
  both.add(color);
  return {static_cast<float>(both.rgb[0]), static_cast<float>(both.rgb[1]),
          static_cast<float>(both.rgb[2]), static_cast<float>(both.alpha())};
}

}  // namespace plume
