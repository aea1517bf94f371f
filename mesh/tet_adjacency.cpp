#include "plume/mesh/tet_adjacency.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <span>
#include <utility>

#include "plume/mesh/face_bucket.h"
#include "plume/mesh/huge_pages.h"
#include "plume/mesh/space_curve.h"
#include "plume/mesh/tet_orientation.h"

namespace plume {
namespace {

template <class Body>
void for_each_range(std::size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 2048), body);
}

bool has_repeated_point(const std::array<std::uint32_t, 4>& p) {
  return p[0] == p[1] || p[0] == p[2] || p[0] == p[3] || p[1] == p[2] || p[1] == p[3] ||
         p[2] == p[3];
}

// The user's number of each cell along the curve; cells with repeated points left out.
std::vector<std::uint32_t> order_cells(const Mesh& mesh, TetAdjacency& tets) {
  std::atomic<bool> any_repeated = false;
  std::vector<std::uint32_t> order;
  mesh.cells.connectivity.visit([&](auto ids) {
    const auto points_of = [&](std::size_t cell) {
      std::array<std::uint32_t, 4> p;
      for (std::size_t v = 0; v < 4; ++v) p[v] = static_cast<std::uint32_t>(ids[4 * cell + v]);
      return p;
    };
    mesh.points.visit([&](auto xyz) {
      order = hilbert_order(mesh.cell_count(), [&](std::size_t cell) {
        const auto p = points_of(cell);
        if (has_repeated_point(p)) any_repeated.store(true, std::memory_order_relaxed);
        double center[3];
        for (std::size_t a = 0; a < 3; ++a)
          center[a] = 0.25 * ((static_cast<double>(xyz[3 * std::size_t{p[0]} + a]) +
                               static_cast<double>(xyz[3 * std::size_t{p[1]} + a])) +
                              (static_cast<double>(xyz[3 * std::size_t{p[2]} + a]) +
                               static_cast<double>(xyz[3 * std::size_t{p[3]} + a])));
        const WalkablePoint local = tets.frame.local(center[0], center[1], center[2], 0);
        return std::array<float, 3>{local.position[0], local.position[1], local.position[2]};
      });
    });
    if (!any_repeated) return;
    Finding repeated{"tetrahedra with repeated points left out", 0, {}};
    std::erase_if(order, [&](std::uint32_t cell) {
      if (!has_repeated_point(points_of(cell))) return false;
      add_example(repeated, cell);
      return true;
    });
    tets.findings.push_back(std::move(repeated));
  });
  return order;
}

// The cells in order, with the user's points in the user's order. Returns the first cell, in order,
// that uses each of the user's points; kNone where none does.
std::vector<std::uint32_t> read_cells(const Mesh& mesh, TetAdjacency& tets) {
  std::vector<std::uint32_t> first(mesh.point_count(), kNone);
  resize_in_huge_pages(tets.cells, tets.original.size());
  mesh.cells.connectivity.visit([&](auto ids) {
    for_each_range(tets.cells.size(), [&](const auto& range) {
      for (std::size_t c = range.begin(); c != range.end(); ++c) {
        const std::size_t begin = 4 * std::size_t{tets.original[c]};
        for (std::size_t v = 0; v < 4; ++v) {
          const auto point = static_cast<std::uint32_t>(ids[begin + v]);
          tets.cells[c][v] = {kNone, point};
          std::atomic_ref user(first[point]);
          std::uint32_t seen = user.load(std::memory_order_relaxed);
          while (c < seen && !user.compare_exchange_weak(seen, static_cast<std::uint32_t>(c),
                                                         std::memory_order_relaxed)) {
          }
        }
      }
    });
  });
  return first;
}

// Points in the order in which the cells first use them; unused points are left out. Turns the
// first user of each of the user's points into its number.
void number_points(const Mesh& mesh, const ScalarField& scalar, TetAdjacency& tets) {
  std::vector<std::uint32_t>& first = tets.numbers;
  const auto used = static_cast<std::size_t>(
      std::count_if(first.begin(), first.end(), [](std::uint32_t user) { return user != kNone; }));
  SortItems order(used);
  std::size_t next = 0;
  for (std::size_t p = 0; p < first.size(); ++p)
    if (first[p] != kNone) order[next++] = std::uint64_t{first[p]} << 32 | p;
  int bits = 1;
  while (bits < 32 && tets.cells.size() >> bits > 0) ++bits;
  radix_sort(order, 32, 32 + bits);
  const bool on_points = scalar.association == Association::point;
  resize_in_huge_pages(tets.points, used);
  mesh.points.visit([&](auto xyz) {
    for_each_range(used, [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const std::size_t p = order[i] & 0xFFFFFFFFu;
        first[p] = static_cast<std::uint32_t>(i);
        tets.points[i] = tets.frame.local(
            static_cast<double>(xyz[3 * p]), static_cast<double>(xyz[3 * p + 1]),
            static_cast<double>(xyz[3 * p + 2]), on_points ? scalar.values[p] : 0.0f);
      }
    });
  });
}

// Sorts four ids; true where that took an odd number of swaps.
bool sort_odd(std::array<std::uint32_t, 4>& ids) {
  bool odd = false;
  const auto order = [&](std::size_t a, std::size_t b) {
    const std::uint32_t x = ids[a], y = ids[b];
    ids[a] = std::min(x, y);
    ids[b] = std::max(x, y);
    odd ^= y < x;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return odd;
}

// Faces by their smallest point, which for three faces of a cell is its smallest and for one its
// second point. So each cell is in two lists, one of each of these two points, as entry 2 * cell
// and 2 * cell + 1; what follows in a list is kept in the place of the partner of a face that is
// matched in that list.
class Lists {
 public:
  explicit Lists(TetAdjacency& tets) : tets_(tets), first_(tets.points.size(), kNone) {}

  void add(std::uint32_t cell, const std::array<std::uint32_t, 4>& points) {
    for (std::uint32_t which = 0; which < 2; ++which)
      tets_.cells[cell][1 - which].cell =
          std::atomic_ref(first_[points[which]])
              .exchange(2 * cell + which, std::memory_order_relaxed);
  }
  // The entries of as many points as `lists` has room for, from `point` on, each in ascending
  // order. Going along several lists in turn, one need not wait for memory at each step.
  void read(std::size_t point, std::span<std::vector<std::uint32_t>> lists) const {
    std::array<std::uint32_t, kTogether> next;
    for (std::size_t k = 0; k < lists.size(); ++k) {
      lists[k].clear();
      next[k] = first_[point + k];
    }
    for (bool more = true; more;) {
      more = false;
      for (std::size_t k = 0; k < lists.size(); ++k) {
        const std::uint32_t e = next[k];
        if (e == kNone) continue;
        lists[k].push_back(e);
        next[k] = tets_.cells[e / 2][1 - e % 2].cell;
        more = true;
      }
    }
    for (auto& list : lists) {
      // One thread has put the last first, several nearly so.
      std::reverse(list.begin(), list.end());
      if (!std::is_sorted(list.begin(), list.end())) std::sort(list.begin(), list.end());
    }
  }
  static constexpr std::size_t kTogether = 8;

 private:
  TetAdjacency& tets_;
  std::vector<std::uint32_t> first_;
};

// Numbers and sorts the points of all cells. Returns the cells without a positive volume, in
// ascending order.
std::vector<std::uint32_t> sort_points(TetAdjacency& tets, Lists& lists) {
  std::vector<std::uint32_t> not_positive;
  std::mutex guard;
  tets.odd.resize(tets.cells.size());
  for_each_range(tets.cells.size(), [&](const auto& range) {
    std::vector<std::uint32_t> found;
    for (std::size_t c = range.begin(); c != range.end(); ++c) {
      std::array<std::uint32_t, 4> points;
      for (std::size_t v = 0; v < 4; ++v) points[v] = tets.numbers[tets.cells[c][v].apex];
      tets.odd[c] = sort_odd(points);
      for (std::size_t r = 0; r < 4; ++r) tets.cells[c][r].apex = points[r];
      if (!(signed_volume(tets, c) > 0)) found.push_back(static_cast<std::uint32_t>(c));
      lists.add(static_cast<std::uint32_t>(c), points);
    }
    if (found.empty()) return;
    const std::lock_guard lock(guard);
    not_positive.insert(not_positive.end(), found.begin(), found.end());
  });
  std::sort(not_positive.begin(), not_positive.end());
  return not_positive;
}

// Returns whether all neighbours agree on who is on which side.
bool find_neighbors(TetAdjacency& tets, const Lists& lists) {
  Finding crowded{"faces shared by more than two cells", 0, {}};
  std::mutex guard;
  std::atomic<bool> agreed = true;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, tets.points.size(), 512), [&](const auto& range) {
        FaceBucket bucket;
        std::array<std::vector<std::uint32_t>, Lists::kTogether> read;
        bool all_agree = true;
        for (std::size_t p = range.begin(); p != range.end(); ++p) {
          const std::size_t at = (p - range.begin()) % Lists::kTogether;
          if (at == 0)
            lists.read(p, std::span(read).first(std::min(Lists::kTogether, range.end() - p)));
          const std::vector<std::uint32_t>& entries = read[at];
          bucket.start(3 * entries.size());
          const auto add = [&](std::uint32_t second, std::uint32_t third, std::uint32_t face) {
            tets.partner(face) = kNone;
            bucket.add(
                second, third, face, [](std::uint32_t, std::uint32_t) { return true; },
                [&](std::uint32_t a, std::uint32_t b) {
                  tets.partner(a) = b;
                  tets.partner(b) = a;
                  all_agree = all_agree && tets.agree(a, b);
                },
                [&](std::uint32_t extra) {
                  const std::lock_guard lock(guard);
                  add_example(crowded, tets.original[extra / 4]);
                });
          };
          for (const std::uint32_t e : entries) {
            const WalkableTets::Cell& cell = tets.cells[e / 2];
            const std::uint32_t face = 4 * (e / 2);
            if (e % 2 == 1) {
              add(cell[2].apex, cell[3].apex, face);
            } else {
              add(cell[2].apex, cell[3].apex, face + 1);
              add(cell[1].apex, cell[3].apex, face + 2);
              add(cell[1].apex, cell[2].apex, face + 3);
            }
          }
        }
        if (!all_agree) agreed.store(false, std::memory_order_relaxed);
      });
  if (crowded.count > 0) tets.findings.push_back(std::move(crowded));
  return agreed;
}

}  // namespace

TetAdjacency find_tet_adjacency(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds) {
  TetAdjacency tets;
  tets.frame = LocalFrame::of(bounds);
  tets.original = order_cells(mesh, tets);
  tets.numbers = read_cells(mesh, tets);
  number_points(mesh, scalar, tets);
  Lists lists(tets);
  const std::vector<std::uint32_t> not_positive = sort_points(tets, lists);
  const bool agreed = find_neighbors(tets, lists);
  orient_tets(tets, agreed, not_positive);
  return tets;
}

}  // namespace plume
