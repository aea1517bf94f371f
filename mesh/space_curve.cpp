#include "plume/mesh/space_curve.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

namespace plume {

std::uint64_t hilbert_key(const std::array<float, 3>& position, int order) {
  std::array<std::uint32_t, 3> x;
  for (std::size_t a = 0; a < 3; ++a) {
    const float unit = std::clamp(0.5f * (position[a] + 1.0f), 0.0f, 1.0f);
    x[a] = std::min(static_cast<std::uint32_t>(unit * static_cast<float>(1u << order)),
                    (1u << order) - 1);
  }
  // Skilling's AxestoTranspose.
  for (std::uint32_t q = 1u << (order - 1); q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (auto& axis : x) {
      if (axis & q) {
        x[0] ^= p;
      } else {
        const std::uint32_t t = (x[0] ^ axis) & p;
        x[0] ^= t;
        axis ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (order - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  std::uint64_t key = 0;
  for (int bit = order - 1; bit >= 0; --bit)
    for (const auto axis : x) key = (key << 1) | (((axis ^ t) >> bit) & 1u);
  return key;
}

std::vector<std::uint32_t> hilbert_order(
    std::size_t count, const std::function<std::array<float, 3>(std::size_t)>& position) {
  struct Item {
    std::uint64_t key;
    std::uint32_t index;
    bool operator<(const Item& other) const {
      return key != other.key ? key < other.key : index < other.index;
    }
  };
  std::vector<Item> items(count);
  int order = 2;
  while (order < 21 && std::uint64_t{1} << (3 * order) < 64 * count) ++order;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      items[i] = {hilbert_key(position(i), order), static_cast<std::uint32_t>(i)};
  });
  tbb::parallel_sort(items);
  std::vector<std::uint32_t> sorted(count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) sorted[i] = items[i].index;
  });
  return sorted;
}

}  // namespace plume
