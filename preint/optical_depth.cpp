#include "plume/preint/optical_depth.h"

#include <algorithm>
#include <utility>

#include "plume/preint/segment_optics.h"

namespace plume {

OpticalDepth::OpticalDepth(Pieces pieces) : pieces_(std::move(pieces)) {
  // From the first real knot on: the knots at the far ends are only there for the search.
  below_knot_.resize(pieces_.knot_count());
  for (std::size_t knot = 2; knot + 1 < pieces_.knot_count(); ++knot) {
    const double area =
        (pieces_.scalar(knot) - pieces_.scalar(knot - 1)) *
        (0.5 * (pieces_.optics(knot).extinction + pieces_.optics(knot - 1).extinction));
    const Sum& before = below_knot_[knot - 1];
    // Knuth's two-sum: `rounding` is exactly what the addition lost.
    const double high = before.high + area;
    const double added = high - before.high;
    const double rounding = (before.high - (high - added)) + (area - added);
    below_knot_[knot] = {high, before.low + rounding};
  }
}

double OpticalDepth::mean_extinction(double s_in, double s_out) const {
  const double low = std::min(s_in, s_out);
  const double high = std::max(s_in, s_out);
  const std::size_t first = pieces_.piece_above(low);
  if (low == high) return pieces_.at(first, low).extinction;
  const std::size_t last = pieces_.piece_below(high);
  const double extinction_low = pieces_.at(first, low).extinction;
  const double extinction_high = pieces_.at(last, high).extinction;
  if (first == last) return 0.5 * (extinction_low + extinction_high);
  const std::size_t next = first + 1;
  const double area_low =
      (pieces_.scalar(next) - low) * (0.5 * (extinction_low + pieces_.optics(next).extinction));
  const double area_high =
      (high - pieces_.scalar(last)) * (0.5 * (pieces_.optics(last).extinction + extinction_high));
  const double area_between = (below_knot_[last].high - below_knot_[next].high) +
                              (below_knot_[last].low - below_knot_[next].low);
  return (area_low + area_between + area_high) / (high - low);
}

float OpticalDepth::operator()(float s_in, float s_out, float length) const {
  if (is_empty_segment(s_in, s_out, length)) return 0;
  return saturated_float(length * mean_extinction(s_in, s_out));
}

}  // namespace plume
