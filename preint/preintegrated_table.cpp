#include "plume/preint/preintegrated_table.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace plume {

namespace {

/// Sums over all windows of `width` neighbours of a list, front to back along the list or, where
/// `reversed`, the other way: the van Herk algorithm, for compositing.
class WindowSums {
 public:
  WindowSums(const std::vector<PreciseColor>& steps, std::size_t width, bool reversed)
      : width_(width), reversed_(reversed), prefix_(steps), suffix_(steps) {
    for (std::size_t i = 1; i < steps.size(); ++i)
      if (i % width != 0) prefix_[i] = composited(prefix_[i - 1], steps[i]);
    for (std::size_t i = steps.size() - 1; i-- > 0;)
      if ((i + 1) % width != 0) suffix_[i] = composited(steps[i], suffix_[i + 1]);
  }

  /// Of steps first to first + width - 1.
  PreciseColor operator()(std::size_t first) const {
    return first % width_ == 0 ? prefix_[first + width_ - 1]
                               : composited(suffix_[first], prefix_[first + width_ - 1]);
  }

 private:
  PreciseColor composited(PreciseColor low, PreciseColor high) const {
    if (reversed_) std::swap(low, high);
    low.add_behind(high);
    return low;
  }

  std::size_t width_;
  bool reversed_;
  std::vector<PreciseColor> prefix_, suffix_;
};

std::string line(const char* format, double first, double second = 0) {
  char text[160];
  std::snprintf(text, sizeof text, format, first, second);
  return text;
}

}  // namespace

std::optional<std::string> TableSettings::problem() const {
  if (scalar_count < 2 || length_count < 2)
    return line("a table of %g scalars and %g lengths: at least 2 of each", scalar_count,
                length_count);
  const auto is_range = [](const std::array<float, 2>& range, float least) {
    return range[0] > least && range[0] < range[1] && range[1] <= std::numeric_limits<float>::max();
  };
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (scalar_range && !is_range(*scalar_range, -infinity))
    return line("a table of scalars from %g to %g: both must be finite, and ascend",
                (*scalar_range)[0], (*scalar_range)[1]);
  if (length_range && !is_range(*length_range, 0))
    return line("a table of lengths from %g to %g: both must be finite, above 0, and ascend",
                (*length_range)[0], (*length_range)[1]);
  if (constant_length && !(*constant_length > 0 && std::isfinite(*constant_length)))
    return line("a table of segments of length %g: it must be finite and above 0",
                *constant_length);
  return std::nullopt;
}

std::array<float, 2> table_lengths(const TransferFunction& transfer_function,
                                   double mean_extinction,
                                   const std::optional<std::array<float, 2>>& length_range) {
  if (mean_extinction == 0) return {0, 0};
  if (length_range) return *length_range;
  double greatest = 0;
  for (const auto& knot : transfer_function.knots)
    greatest = std::max(greatest, static_cast<double>(knot.optics.extinction));
  constexpr double smallest_float = std::numeric_limits<float>::min();
  return {saturated_float(std::max(0.01 / greatest, smallest_float)),
          saturated_float(100 / mean_extinction)};
}

PreintegratedTable::PreintegratedTable(const TransferFunction& transfer_function,
                                       const TableSettings& settings)
    : closed_form_(transfer_function), depth_(transfer_function) {
  assert(!settings.problem());
  const auto start = std::chrono::steady_clock::now();
  const auto& knots = transfer_function.knots;
  const auto [lowest, highest] =
      settings.scalar_range.value_or(std::array{knots.front().scalar, knots.back().scalar});
  if (lowest == highest) return;
  const double mean = depth_.mean_extinction(lowest, highest);
  const auto lengths = table_lengths(transfer_function, mean, settings.length_range);
  if (!(lengths[1] > 0)) return;
  if (settings.constant_length) {
    shortest_ = longest_ = *settings.constant_length;
    reach_ = std::numeric_limits<float>::max();
    lengths_ = TableAxis(std::log2(shortest_), std::log2(shortest_), 1);
  } else {
    shortest_ = lengths[0];
    longest_ = reach_ = lengths[1];
    lengths_ = TableAxis(std::log2(shortest_), std::log2(longest_),
                         static_cast<std::size_t>(settings.length_count));
  }
  scalars_ = TableAxis(lowest, highest, static_cast<std::size_t>(settings.scalar_count));
  fill();
  report_.bytes = entries_.size() * sizeof(TableEntry);
  report_.build_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  measure();
}

void PreintegratedTable::fill() {
  const std::size_t n = scalars_.count;
  entries_.resize(lengths_.count * n * n);
  const Pieces& pieces = depth_.pieces();
  // What lies within each step from a scalar to the next, where no knot does: nearly everywhere.
  std::vector<std::size_t> piece_of(n - 1);
  std::vector<PreciseOptics> above(n), below(n);
  constexpr std::size_t several = static_cast<std::size_t>(-1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t rising = pieces.piece_above(scalars_.value(i));
    above[i] = pieces.at(rising, scalars_.value(i));
    const std::size_t falling = pieces.piece_below(scalars_.value(i));
    below[i] = pieces.at(falling, scalars_.value(i));
    if (i + 1 < n)
      piece_of[i] = rising == pieces.piece_below(scalars_.value(i + 1)) ? rising : several;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, lengths_.count * n), [&](const auto& tasks) {
    std::vector<PreciseColor> rising(n - 1), falling(n - 1);
    for (std::size_t task = tasks.begin(); task != tasks.end(); ++task) {
      const std::size_t level = task / n, apart = task % n;
      const double length = std::exp2(lengths_.value(level));
      TableEntry* const entries = &entries_[level * n * n];
      if (apart == 0) {
        for (std::size_t i = 0; i < n; ++i)
          entries[i * n + i] =
              TableEntry::of(integrate_linear(above[i], above[i], length), above[i].extinction);
        continue;
      }
      const double step = length / static_cast<double>(apart);
      for (std::size_t i = 0; i + 1 < n; ++i) {
        if (piece_of[i] != several) {
          rising[i] = integrate_linear(above[i], below[i + 1], step);
          falling[i] = integrate_linear(below[i + 1], above[i], step);
        } else {
          rising[i] = integrate_linear(pieces, scalars_.value(i), scalars_.value(i + 1), step);
          falling[i] = integrate_linear(pieces, scalars_.value(i + 1), scalars_.value(i), step);
        }
      }
      const WindowSums up(rising, apart, false), down(falling, apart, true);
      for (std::size_t low = 0; low + apart < n; ++low) {
        const std::size_t high = low + apart;
        const double mean = depth_.mean_extinction(scalars_.value(low), scalars_.value(high));
        entries[high * n + low] = TableEntry::of(up(low), mean);
        entries[low * n + high] = TableEntry::of(down(low), mean);
      }
    }
  });
}

void PreintegratedTable::measure() {
  const auto between = [](const TableAxis& axis, double share) {
    return axis.low + (axis.high - axis.low) * share;
  };
  measure_error(report_, [&](const std::array<double, 4>& place) {
    const auto s_in = static_cast<float>(between(scalars_, place[0]));
    const auto s_out = static_cast<float>(between(scalars_, place[1]));
    const auto length = static_cast<float>(std::exp2(between(lengths_, place[2])));
    return std::pair(integrate(s_in, s_out, length), closed_form_.integrate(s_in, s_out, length));
  });
}

SegmentColor PreintegratedTable::integrate(float s_in, float s_out, float length) const {
  // Written so that NaN, and every scalar where there is no table, goes to the closed form.
  const auto covered = [this](float scalar) {
    return scalar >= scalars_.low && scalar <= scalars_.high;
  };
  if (entries_.empty() || !covered(s_in) || !covered(s_out) || !(length > 0) || length > reach_)
    return closed_form_.integrate(s_in, s_out, length);
  const TableAxis::Place front = scalars_.place(s_in), back = scalars_.place(s_out);
  const TableAxis::Place level =
      lengths_.count > 1 ? lengths_.place(std::log2(length)) : TableAxis::Place{0, 0};
  const std::size_t n = scalars_.count;
  const TableEntry* const first = &entries_[(level.first * n + back.first) * n + front.first];
  TableEntry found;
  const auto add = [&](const TableEntry* pair, float weight) {
    found.add(pair[0], weight * (1 - front.weight));
    found.add(pair[1], weight * front.weight);
  };
  add(first, (1 - level.weight) * (1 - back.weight));
  add(first + n, (1 - level.weight) * back.weight);
  if (lengths_.count > 1) {
    const TableEntry* const next = first + n * n;
    add(next, level.weight * (1 - back.weight));
    add(next + n, level.weight * back.weight);
  }
  return found.color(length);
}

}  // namespace plume
