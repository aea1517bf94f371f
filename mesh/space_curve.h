/// Order along a Hilbert curve, so that what is near in space is near in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace plume {

/// Position along the Hilbert curve of order 21 through [-1, 1]^3: 63 bits; coordinates outside are
/// clamped. Skilling, "Programming the Hilbert curve" (AIP Conf. Proc. 707, 2004).
std::uint64_t hilbert_key(const std::array<float, 3>& position);

/// The order of `count` items along the curve: result[new] = old. `position(i)` gives item i's
/// place in [-1, 1]^3. Items at one place keep their order.
std::vector<std::uint32_t> hilbert_order(
    std::size_t count, const std::function<std::array<float, 3>(std::size_t)>& position);

}  // namespace plume
