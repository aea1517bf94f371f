/// Large arrays in large pages of memory.
#pragma once

#include <cstddef>
#include <vector>

namespace plume {

/// Asks the system to back an array that was not yet written to by pages of 2 MB, where it knows
/// such and only for those that lie within the array as a whole. They are faster to come by, and to
/// find again where an array is read here and there. Changes no value; may do nothing at all.
void prefer_huge_pages(void* data, std::size_t bytes);

/// Resizes an empty vector that has not allocated yet, with prefer_huge_pages().
template <class T>
void resize_in_huge_pages(std::vector<T>& values, std::size_t size) {
  values.reserve(size);
  prefer_huge_pages(values.data(), size * sizeof(T));
  values.resize(size);
}

}  // namespace plume
