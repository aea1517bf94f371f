/// Order along a Hilbert curve, so that what is near in space is near in memory.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "plume/mesh/radix_sort.h"

namespace plume {

/// Position along the Hilbert curve of an order from 1 to 21 through [-1, 1]^3: 3 * order bits;
/// coordinates outside are clamped. The key of a lower order is the leading bits of that of a
/// higher one. Skilling, "Programming the Hilbert curve" (AIP Conf. Proc. 707, 2004).
std::uint64_t hilbert_key(const std::array<float, 3>& position, int order = 21);

/// The order of the curve by which `count` items are sorted first, from 1 to 10: that of a lattice
/// of 1 to 8 cells an item, or of fewer where there are more than 2^30 items.
int lattice_order(std::size_t count);

/// The second half of hilbert_order(): items are their key of lattice_order() times 2^32 plus their
/// number, in ascending order of the latter.
std::vector<std::uint32_t> sort_along_curve(
    SortItems items, const std::function<std::array<float, 3>(std::size_t)>& position);

/// The order of `count` items along the curve: result[new] = old. `position(i)` gives item i's
/// place in [-1, 1]^3, and is called by many threads at once.
///
/// Items within one cell of a lattice of lattice_order() keep their order: a finer curve would cost
/// more time than it saves. Only where more than kCrowdedCell of them are in one cell, as in
/// boundary layers, are they ordered along the finest curve.
/// The result does not depend on the number of threads. Takes 16 bytes an item while it runs, and
/// where cells are crowded 16 more for each item there.
template <class Position>
std::vector<std::uint32_t> hilbert_order(std::size_t count, const Position& position) {
  SortItems items(count);
  const int order = lattice_order(count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 2048), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      items[i] = hilbert_key(position(i), order) << 32 | i;
  });
  return sort_along_curve(std::move(items), position);
}

/// See hilbert_order().
inline constexpr std::size_t kCrowdedCell = 64;

}  // namespace plume
