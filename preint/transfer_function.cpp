#include "plume/preint/transfer_function.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

namespace plume {

namespace {

std::string describe(std::size_t index, float scalar, const char* what, float value) {
  char line[160];
  std::snprintf(line, sizeof line, "knot %zu (scalar %g): %s is %g", index,
                static_cast<double>(scalar), what, static_cast<double>(value));
  return line;
}

bool is_finite_and_not_negative(float value) { return std::isfinite(value) && value >= 0; }

}  // namespace

std::optional<std::string> TransferFunction::problem() const {
  if (knots.empty()) return "a transfer function needs at least one knot";
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const float scalar = knots[i].scalar;
    const Optics& optics = knots[i].optics;
    if (!std::isfinite(scalar)) {
      return describe(i, scalar, "the scalar", scalar) + ", but must be finite";
    }
    if (i >= 1 && scalar < knots[i - 1].scalar) {
      return describe(i, scalar, "the scalar before it", knots[i - 1].scalar) +
             ", but scalars must ascend";
    }
    if (i >= 2 && scalar == knots[i - 2].scalar) {
      return describe(i, scalar, "the scalar of the two knots before it", scalar) +
             " as well, but a step has two knots";
    }
    if (!is_finite_and_not_negative(optics.extinction)) {
      return describe(i, scalar, "the extinction", optics.extinction) +
             ", but must be finite and not negative";
    }
    constexpr const char* channel_names[] = {"red", "green", "blue"};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      if (!is_finite_and_not_negative(optics.color[channel])) {
        return describe(i, scalar, channel_names[channel], optics.color[channel]) +
               ", but must be finite and not negative";
      }
    }
  }
  return std::nullopt;
}

Optics TransferFunction::at(float scalar) const {
  assert(!problem());
  if (std::isnan(scalar)) return {};
  // The first knot above the scalar; hence at a step the later knot is the one below.
  const auto above =
      std::upper_bound(knots.begin(), knots.end(), scalar,
                       [](float value, const Knot& knot) { return value < knot.scalar; });
  if (above == knots.begin()) return knots.front().optics;
  if (above == knots.end()) return knots.back().optics;
  const auto below = above - 1;
  // In double, since the difference of two floats may exceed the largest float.
  const double low = below->scalar;
  const double width = above->scalar - low;
  const double weight_above = (scalar - low) / width;
  const double weight_below = (above->scalar - static_cast<double>(scalar)) / width;
  const auto blend = [&](float value_below, float value_above) {
    return static_cast<float>(weight_below * value_below + weight_above * value_above);
  };
  Optics result;
  result.extinction = blend(below->optics.extinction, above->optics.extinction);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    result.color[channel] = blend(below->optics.color[channel], above->optics.color[channel]);
  }
  return result;
}

}  // namespace plume
