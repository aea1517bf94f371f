#include "plume/mesh/coincident_points.h"

#include <tbb/parallel_sort.h>

#include <cstddef>
#include <numeric>

namespace plume {
namespace {

// -1, 0 or 1 as coordinates of a come before, with or after those of b.
int compare(const double* a, const double* b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a[axis] < b[axis]) return -1;
    if (a[axis] > b[axis]) return 1;
  }
  return 0;
}

}  // namespace

std::vector<std::uint32_t> first_coincident(std::span<const double> points) {
  std::vector<std::uint32_t> order(points.size() / 3);
  std::iota(order.begin(), order.end(), 0u);
  const auto at = [&](std::uint32_t point) { return points.data() + 3 * std::size_t{point}; };
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int order_of_two = compare(at(a), at(b));
    return order_of_two != 0 ? order_of_two < 0 : a < b;
  });
  std::vector<std::uint32_t> first;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (compare(at(order[i - 1]), at(order[i])) != 0) continue;
    if (first.empty()) {
      first.resize(order.size());
      std::iota(first.begin(), first.end(), 0u);
    }
    first[order[i]] = first[order[i - 1]];
  }
  return first;
}

}  // namespace plume
