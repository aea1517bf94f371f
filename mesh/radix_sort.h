/// Sorting of many integers by some of their bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "plume/mesh/huge_pages.h"

namespace plume {

/// Integers that nobody has to set to zero first.
struct SortItems {
  explicit SortItems(std::size_t count)
      : values(std::make_unique_for_overwrite<std::uint64_t[]>(count)), size(count) {
    prefer_huge_pages(values.get(), count * sizeof(std::uint64_t));
  }

  std::uint64_t& operator[](std::size_t i) { return values[i]; }
  std::uint64_t operator[](std::size_t i) const { return values[i]; }

  std::unique_ptr<std::uint64_t[]> values;
  std::size_t size;
};

/// Sorts by the bits from `low` up to, but not including, `high`, both within [0, 64]; items that
/// are equal in these keep their order. In parallel, and the same for any number of threads. Takes
/// 8 further bytes an item while it runs.
///
/// Least significant digit first (Knuth, "The Art of Computer Programming", vol. 3, 5.2.5,
/// algorithm R), with a histogram for each stretch of the items.
void radix_sort(SortItems& items, int low, int high);

}  // namespace plume
