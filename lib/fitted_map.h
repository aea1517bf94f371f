/// A first colour map for values that nobody has looked at yet.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "plume/lib/color_map.h"

namespace plume {

/// As many of the values, spread evenly over all, as are enough for percentiles: all of fewer than
/// 200,000, else 100,000 and more. A sample's sample is the sample.
std::vector<float> sample_for_map(std::span<const float> values);

/// The colours of "turbo" over the values' 1st to 99th percentile, in which a value is the more
/// opaque the rarer it is: the free stream stays clear, and what differs from it is seen. Values
/// that are NaN are passed over; a constant field is shown in one colour, half transparent.
///
/// With a `range`, low below high, the colours run over that instead, and what the values do not
/// reach counts as rare: the first of a series of fields whose range is known beforehand.
ColorMap fitted_color_map(std::span<const float> values,
                          const std::optional<std::array<double, 2>>& range = {});

}  // namespace plume
