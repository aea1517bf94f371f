#include "plume/mesh/radix_sort.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace plume {
namespace {

// As many places are written to in turn as digits have values: more would not stay in the cache.
constexpr int kDigitBits = 11;
constexpr std::size_t kStretch = std::size_t{1} << 16;

// Moves all items to where the digit at `shift` wants them.
void sort_by_digit(const SortItems& from, SortItems& to, int shift, int bits) {
  const std::size_t digits = std::size_t{1} << bits;
  const std::size_t stretches = (from.size + kStretch - 1) / kStretch;
  const auto digit = [&](std::uint64_t item) { return (item >> shift) & (digits - 1); };
  std::vector<std::size_t> places(stretches * digits, 0);
  const tbb::blocked_range<std::size_t> all(0, stretches, 1);
  tbb::parallel_for(all, [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      std::size_t* const counts = &places[s * digits];
      const std::size_t end = std::min(from.size, (s + 1) * kStretch);
      for (std::size_t i = s * kStretch; i < end; ++i) ++counts[digit(from[i])];
    }
  });
  std::size_t place = 0;
  for (std::size_t d = 0; d < digits; ++d)
    for (std::size_t s = 0; s < stretches; ++s)
      place += std::exchange(places[s * digits + d], place);
  tbb::parallel_for(all, [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      std::size_t* const next = &places[s * digits];
      const std::size_t end = std::min(from.size, (s + 1) * kStretch);
      for (std::size_t i = s * kStretch; i < end; ++i) to[next[digit(from[i])]++] = from[i];
    }
  });
}

}  // namespace

void radix_sort(SortItems& items, int low, int high) {
  if (items.size < 2 || low >= high) return;
  const int passes = (high - low + kDigitBits - 1) / kDigitBits;
  SortItems other(items.size);
  for (int pass = 0; pass < passes; ++pass) {
    const int begin = low + (high - low) * pass / passes;
    const int end = low + (high - low) * (pass + 1) / passes;
    sort_by_digit(items, other, begin, end - begin);
    std::swap(items, other);
  }
}

}  // namespace plume
