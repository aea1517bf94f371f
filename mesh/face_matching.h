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

#include "plume/mesh/face_bucket.h"

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
/// face, both possibly from several threads at once and for each slot at most once. A face's
/// partner is the first that is the same and has none yet, in the order of the slots. The result
/// does not depend on the number of threads. Linear in time; 4 bytes a face and 4 a point while it
/// runs.
template <class Key, class Same, class Pair, class Extra>
void match_faces(std::size_t points, std::size_t slots, const Key& key, const Same& same,
                 const Pair& pair, const Extra& extra) {
  // The faces with the same smallest point are linked to a list.
  std::vector<std::uint32_t> first(points, kNone);
  std::vector<std::uint32_t> next(slots, kNone);
  const tbb::blocked_range<std::size_t> all(0, slots, 4096);
  tbb::parallel_for(all, [&](const auto& range) {
    for (std::size_t s = range.begin(); s != range.end(); ++s)
      if (const std::uint32_t point = key(s)[0]; point != kNone)
        next[s] = std::atomic_ref(first[point])
                      .exchange(static_cast<std::uint32_t>(s), std::memory_order_relaxed);
  });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points, 1024), [&](const auto& range) {
    FaceBucket bucket;
    std::vector<std::uint32_t> faces;
    for (std::size_t p = range.begin(); p != range.end(); ++p) {
      faces.clear();
      for (std::uint32_t s = first[p]; s != kNone; s = next[s]) faces.push_back(s);
      // One thread has put the last first, several nearly so.
      std::reverse(faces.begin(), faces.end());
      if (!std::is_sorted(faces.begin(), faces.end())) std::sort(faces.begin(), faces.end());
      bucket.start(faces.size());
      for (const std::uint32_t s : faces) {
        const std::array<std::uint32_t, 3> k = key(s);
        bucket.add(k[1], k[2], s, same, pair, extra);
      }
    }
  });
}

}  // namespace plume
