/// Order along a Hilbert curve, so that what is near in space is near in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace plume {

/// Position along the Hilbert curve of an order from 1 to 21 through [-1, 1]^3: 3 * order bits;
/// coordinates outside are clamped. Skilling, "Programming the Hilbert curve" (AIP Conf. Proc. 707,
/// 2004).
std::uint64_t hilbert_key(const std::array<float, 3>& position, int order = 21);

/// The order of `count` items along the curve: result[new] = old. `position(i)` gives item i's
/// place in [-1, 1]^3. Items at one place keep their order, as do those of one cell of a lattice
/// that has some 64 cells for each item: a finer curve would cost more time than it saves.
std::vector<std::uint32_t> hilbert_order(
    std::size_t count, const std::function<std::array<float, 3>(std::size_t)>& position);

}  // namespace plume
