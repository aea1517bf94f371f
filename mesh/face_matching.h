/// Which faces of a mesh are one and the same: the adjacency of cells.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace plume {

/// Absence of a cell, a face or a point.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

/// A face of the boundary: a cell and the number of its face.
struct BoundaryFace {
  std::uint32_t cell;
  std::uint32_t face;
};

/// Finds the pairs of equal faces among `slots` faces of cells.
///
/// `key(slot)` gives a face's three smallest point ids in ascending order, the first kNone for a
/// face that takes no part; `same(a, b)` tells whether two faces with equal keys are the same.
/// `pair(a, b)` is called for each pair, a < b, and `extra(slot)` for a third and further cell at a
/// face, both possibly from several threads at once and for each slot at most once. The result does
/// not depend on the number of threads. Linear in time; 16 bytes a face while it runs.
template <class Key, class Same, class Pair, class Extra>
void match_faces(std::size_t points, std::size_t slots, const Key& key, const Same& same,
                 const Pair& pair, const Extra& extra) {
  struct Entry {
    std::uint32_t second, third, slot;
    bool operator<(const Entry& other) const {
      if (second != other.second) return second < other.second;
      if (third != other.third) return third < other.third;
      return slot < other.slot;
    }
  };
  // Faces are put into buckets by their smallest point, then sorted within a bucket.
  std::vector<std::uint32_t> begin(points + 1, 0);
  const tbb::blocked_range<std::size_t> all(0, slots, 4096);
  tbb::parallel_for(all, [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      const std::uint32_t first = key(s)[0];
      if (first != kNone) std::atomic_ref(begin[first + 1]).fetch_add(1, std::memory_order_relaxed);
    }
  });
  for (std::size_t p = 0; p < points; ++p) begin[p + 1] += begin[p];
  std::vector<Entry> entries(begin[points]);
  {
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    tbb::parallel_for(all, [&](const auto& range) {
      for (std::size_t s = range.begin(); s != range.end(); ++s) {
        const std::array<std::uint32_t, 3> k = key(s);
        if (k[0] == kNone) continue;
        const std::uint32_t place =
            std::atomic_ref(next[k[0]]).fetch_add(1, std::memory_order_relaxed);
        entries[place] = {k[1], k[2], static_cast<std::uint32_t>(s)};
      }
    });
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points, 1024), [&](const auto& range) {
    std::vector<std::uint32_t> open, closed;
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      const auto first = entries.begin() + begin[p];
      const auto last = entries.begin() + begin[p + 1];
      std::sort(first, last);
      for (auto group = first; group != last;) {
        auto end = group + 1;
        while (end != last && end->second == group->second && end->third == group->third) ++end;
        // Mostly one or two faces; each looks for the first open one that it is the same as.
        open.clear();
        closed.clear();
        for (; group != end; ++group) {
          const std::uint32_t slot = group->slot;
          const auto partner = std::find_if(open.begin(), open.end(),
                                            [&](std::uint32_t other) { return same(other, slot); });
          if (partner != open.end()) {
            pair(*partner, slot);
            closed.push_back(*partner);
            open.erase(partner);
          } else if (std::any_of(closed.begin(), closed.end(),
                                 [&](std::uint32_t other) { return same(other, slot); })) {
            extra(slot);
          } else {
            open.push_back(slot);
          }
        }
      }
    }
  });
}

}  // namespace plume
