#include "plume/io/read_point_merge.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace plume {
namespace {

template <class T>
using Point = std::array<std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>, 3>;

// The coordinates' bits. Adding zero makes -0 the 0 that it equals.
template <class T>
Point<T> bits_of(const T* coordinates) {
  Point<T> bits;
  for (std::size_t axis = 0; axis < 3; ++axis)
    bits[axis] = std::bit_cast<typename Point<T>::value_type>(coordinates[axis] + T(0));
  return bits;
}

// splitmix64's finalizer, which spreads the few bits in which neighbouring coordinates differ.
std::size_t mix(std::uint64_t h) {
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return static_cast<std::size_t>(h ^ (h >> 31));
}

// Open addressing over the numbers of points, whose coordinates stay where they are.
template <class T>
class PointTable {
 public:
  PointTable(const std::vector<T>& points, std::size_t count)
      : points_(points), slots_(std::bit_ceil(2 * count + 2), -1) {}

  // The first point with these coordinates, or -1.
  std::int64_t find(const T* coordinates) const { return slots_[slot_of(bits_of(coordinates))]; }

  void insert(std::int64_t point) {
    auto& slot = slots_[slot_of(bits_of(&points_[3 * static_cast<std::size_t>(point)]))];
    if (slot < 0) slot = point;
  }

 private:
  std::size_t slot_of(const Point<T>& bits) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = mix(bits[0] + mix(bits[1] + mix(bits[2]))) & mask;
    while (slots_[slot] >= 0 &&
           bits_of(&points_[3 * static_cast<std::size_t>(slots_[slot])]) != bits)
      slot = (slot + 1) & mask;
    return slot;
  }

  const std::vector<T>& points_;
  std::vector<std::int64_t> slots_;
};

template <class T>
void merge(std::vector<T>& points, std::vector<std::vector<std::int64_t>>& ids) {
  PointTable<T> table(points, points.size() / 3);
  std::int64_t next = 0;
  for (auto& block : ids) {
    const std::int64_t first_of_block = next;
    for (auto& id : block) {
      const T* const from = &points[3 * static_cast<std::size_t>(id)];
      const std::int64_t earlier = table.find(from);
      if (earlier >= 0) {
        id = earlier;
        continue;
      }
      // Points that stay move down over those that went: never past one still to be read.
      std::memmove(&points[3 * static_cast<std::size_t>(next)], from, 3 * sizeof(T));
      id = next++;
    }
    // Only now, so that a block's points never merge with one another.
    for (std::int64_t point = first_of_block; point < next; ++point) table.insert(point);
  }
  points.resize(3 * static_cast<std::size_t>(next));
}

}  // namespace

void merge_block_points(std::vector<float>& points, std::vector<std::vector<std::int64_t>>& ids) {
  merge(points, ids);
}

void merge_block_points(std::vector<double>& points, std::vector<std::vector<std::int64_t>>& ids) {
  merge(points, ids);
}

}  // namespace plume
