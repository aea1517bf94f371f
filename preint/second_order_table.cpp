#include "plume/preint/second_order_table.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "plume/preint/curved_pieces.h"
#include "plume/preint/preintegrated_table.h"

namespace plume {

namespace {

/// Of what the table's entries are integrated to, in shares of the largest colour: far below what
/// interpolation leaves.
constexpr double entry_tolerance = 1e-5;

}  // namespace

std::optional<std::string> SecondOrderTableSettings::problem() const {
  return TableSettings{scalar_count, length_count, scalar_range, length_range, constant_length}
      .problem();
}

SecondOrderTable::SecondOrderTable(const TransferFunction& transfer_function,
                                   const SecondOrderTableSettings& settings)
    : closed_form_(transfer_function), exact_(transfer_function, 1e-7) {
  assert(!settings.problem());
  const auto start = std::chrono::steady_clock::now();
  const auto& knots = transfer_function.knots;
  const auto [lowest, highest] =
      settings.scalar_range.value_or(std::array{knots.front().scalar, knots.back().scalar});
  if (lowest == highest) return;
  const double mean = OpticalDepth(exact_.pieces()).mean_extinction(lowest, highest);
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
  double largest_color = 0;
  for (const auto& knot : knots)
    for (const float channel : knot.optics.color)
      largest_color = std::max(largest_color, static_cast<double>(channel));
  fill(largest_color);
  report_.bytes = entries_.size() * sizeof(TableEntry);
  report_.build_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  measure();
}

void SecondOrderTable::fill(double largest_color) {
  const std::size_t n = scalars_.count;
  entries_.resize(lengths_.count * n * n * n);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n * n), [&](const auto& rows) {
    std::vector<CurvedPiece> pieces;
    for (std::size_t row = rows.begin(); row != rows.end(); ++row) {
      const double middle = scalars_.value(row % n), back = scalars_.value(row / n);
      for (std::size_t i = 0; i < n; ++i) {
        cut_at_knots(exact_.pieces(), ScalarPolynomial::quadratic(scalars_.value(i), middle, back),
                     pieces);
        double mean = 0;
        for (const CurvedPiece& piece : pieces) mean += piece.share * piece.depth(1);
        for (std::size_t level = 0; level < lengths_.count; ++level)
          entries_[(level * n * n + row) * n + i] =
              TableEntry::of(integrate_curved(pieces, std::exp2(lengths_.value(level)),
                                              entry_tolerance, largest_color),
                             mean);
      }
    }
  });
}

void SecondOrderTable::measure() {
  const auto between = [](const TableAxis& axis, double share) {
    return axis.low + (axis.high - axis.low) * share;
  };
  measure_error(report_, [&](const std::array<double, 4>& place) {
    const auto scalar = ScalarPolynomial::quadratic(
        between(scalars_, place[0]), between(scalars_, place[1]), between(scalars_, place[2]));
    const auto length = static_cast<float>(std::exp2(between(lengths_, place[3])));
    return std::pair(integrate(scalar, length), exact_.integrate(scalar, length));
  });
}

SegmentColor SecondOrderTable::integrate(const ScalarPolynomial& scalar, float length) const {
  assert(scalar.degree() <= highest_degree);
  if (!scalar.is_finite() || !(length > 0)) return {};
  const std::array<double, 3> values{scalar(0), scalar(0.5), scalar(1)};
  const auto [least, most] = std::minmax({values[0], values[1], values[2]});
  if (entries_.empty() || !(least >= scalars_.low) || !(most <= scalars_.high) || length > reach_)
    return exact_.integrate(scalar, length);
  const TableAxis::Place front = scalars_.place(values[0]), middle = scalars_.place(values[1]),
                         back = scalars_.place(values[2]);
  const TableAxis::Place level =
      lengths_.count > 1 ? lengths_.place(std::log2(length)) : TableAxis::Place{0, 0};
  const std::size_t n = scalars_.count;
  TableEntry found;
  for (std::size_t l = 0; l < (lengths_.count > 1 ? 2u : 1u); ++l) {
    const float level_weight = l == 0 ? 1 - level.weight : level.weight;
    for (std::size_t b = 0; b < 2; ++b) {
      const float back_weight = level_weight * (b == 0 ? 1 - back.weight : back.weight);
      const TableEntry* pair =
          &entries_[(((level.first + l) * n + back.first + b) * n + middle.first) * n +
                    front.first];
      for (const float weight : {back_weight * (1 - middle.weight), back_weight * middle.weight}) {
        found.add(pair[0], weight * (1 - front.weight));
        found.add(pair[1], weight * front.weight);
        pair += n;
      }
    }
  }
  return found.color(length);
}

}  // namespace plume
