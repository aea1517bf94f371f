/// An axis of a pre-integrated table, and what a table says of itself.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "plume/preint/segment_optics.h"

namespace plume {

/// Entries at even distances from `low` to `high`.
struct TableAxis {
  double low = 0;         ///< where the first entry is
  double high = 0;        ///< where the last is
  std::size_t count = 1;  ///< of entries
  /// Entries per unit; 0 where there is only one entry.
  double density = 0;

  TableAxis() = default;
  /// From the first entry to the last.
  TableAxis(double from, double to, std::size_t entries)
      : low(from),
        high(to),
        count(entries),
        density(entries > 1 ? static_cast<double>(entries - 1) / (to - from) : 0) {}

  /// Of entry i; of the first and the last exactly the ends.
  double value(std::size_t i) const {
    if (i + 1 == count) return count == 1 ? low : high;
    return low + (high - low) * (static_cast<double>(i) / static_cast<double>(count - 1));
  }

  /// The entry below a value and the weight of the next one; at the ends, the ends. Where there is
  /// one entry, it is that one alone.
  struct Place {
    std::size_t first;  ///< the entry below
    float weight;       ///< of the entry above, 0 to 1
  };
  /// Of a value; beyond the ends, at the nearer end.
  Place place(double value) const {
    const double position = std::max(0.0, (value - low) * density);
    const std::size_t last = count > 1 ? count - 2 : 0;
    const std::size_t first =
        position < static_cast<double>(last) ? static_cast<std::size_t>(position) : last;
    return {first, static_cast<float>(std::min(1.0, position - static_cast<double>(first)))};
  }
  /// From the first entry of a place to the second, in entries along this axis.
  std::size_t step() const { return count > 1 ? 1 : 0; }
};

/// What a table costs and how far it is from what it tabulates.
struct TableReport {
  std::size_t bytes = 0;     ///< of the entries
  double build_seconds = 0;  ///< on the wall
  /// Of a colour channel or alpha, over 4096 segments spread evenly over the table (the scalars and
  /// the logarithm of the length). No bound: what lies between them may be worse.
  float largest_error = 0;
  float rms_error = 0;  ///< over the same segments and all four channels
};

/// Measures a table's error: `pair(place)` gives what the table and what the exact integrator make
/// of the segment at a place in the unit cube of four dimensions.
template <class Pair>
void measure_error(TableReport& report, const Pair& pair) {
  constexpr int count = 4096;
  // A lattice of rank one with the generalised golden ratio, x^5 = x + 1, which fills the cube
  // evenly however many dimensions of it are used (Roberts, "The unreasonable effectiveness of
  // quasirandom sequences", 2018).
  constexpr double ratio = 1.1673039782614187;
  double squares = 0;
  for (int i = 0; i < count; ++i) {
    std::array<double, 4> place;
    double step = 1;
    for (double& x : place) {
      step /= ratio;
      x = std::fmod(0.5 + step * (i + 1), 1.0);
    }
    const auto [found, exact] = pair(place);
    for (const float difference :
         {found.r - exact.r, found.g - exact.g, found.b - exact.b, found.alpha - exact.alpha}) {
      report.largest_error = std::max(report.largest_error, std::abs(difference));
      squares += static_cast<double>(difference) * static_cast<double>(difference);
    }
  }
  report.rms_error = static_cast<float>(std::sqrt(squares / (4 * count)));
}

}  // namespace plume
