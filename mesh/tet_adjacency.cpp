#include "plume/mesh/tet_adjacency.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>

#include "plume/mesh/cell_faces.h"
#include "plume/mesh/orientation.h"
#include "plume/mesh/space_curve.h"

namespace plume {
namespace {

template <class Body>
void for_each_parallel(std::size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 2048), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

std::array<std::uint32_t, 3> face_points(const TetAdjacency::Cell& cell, std::size_t face) {
  const auto& loop = kTetrahedronFaces[face];
  return {cell.points[static_cast<std::size_t>(loop[0])],
          cell.points[static_cast<std::size_t>(loop[1])],
          cell.points[static_cast<std::size_t>(loop[2])]};
}

// Sorts three ids; true where that took an odd number of swaps.
bool sort_odd(std::array<std::uint32_t, 3>& ids) {
  bool odd = false;
  auto order = [&](std::size_t a, std::size_t b) {
    if (ids[b] < ids[a]) {
      std::swap(ids[a], ids[b]);
      odd = !odd;
    }
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return odd;
}

bool odd_face(const TetAdjacency::Cell& cell, std::size_t face) {
  auto ids = face_points(cell, face);
  return sort_odd(ids);
}

double signed_volume(const TetAdjacency& tets, std::size_t index) {
  const auto& cell = tets.cells[index];
  double edge[3][3];
  for (std::size_t e = 0; e < 3; ++e)
    for (std::size_t a = 0; a < 3; ++a)
      edge[e][a] = static_cast<double>(tets.points[cell.points[e + 1]].position[a]) -
                   static_cast<double>(tets.points[cell.points[0]].position[a]);
  return edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) +
         edge[0][1] * (edge[1][2] * edge[2][0] - edge[1][0] * edge[2][2]) +
         edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
}

bool has_repeated_point(const std::array<std::uint32_t, 4>& p) {
  return p[0] == p[1] || p[0] == p[2] || p[0] == p[3] || p[1] == p[2] || p[1] == p[3] ||
         p[2] == p[3];
}

// Cells with the user's point ids, ordered along the curve; cells with repeated points left out.
// Returns the user's number of each cell.
std::vector<std::uint32_t> order_cells(const Mesh& mesh, TetAdjacency& tets) {
  const std::size_t count = mesh.cell_count();
  std::vector<std::uint32_t> order;
  mesh.cells.connectivity.visit([&](auto ids) {
    mesh.points.visit([&](auto xyz) {
      order = hilbert_order(count, [&](std::size_t cell) {
        double center[3] = {0, 0, 0};
        for (std::size_t v = 0; v < 4; ++v)
          for (std::size_t a = 0; a < 3; ++a)
            center[a] += 0.25 * static_cast<double>(
                                    xyz[3 * static_cast<std::size_t>(ids[4 * cell + v]) + a]);
        const WalkablePoint p = tets.frame.local(center[0], center[1], center[2], 0);
        return std::array<float, 3>{p.position[0], p.position[1], p.position[2]};
      });
    });
    Finding repeated{"tetrahedra with repeated points left out", 0, {}};
    std::erase_if(order, [&](std::uint32_t cell) {
      std::array<std::uint32_t, 4> p;
      for (std::size_t v = 0; v < 4; ++v) p[v] = static_cast<std::uint32_t>(ids[4 * cell + v]);
      if (!has_repeated_point(p)) return false;
      add_example(repeated, cell);
      return true;
    });
    if (repeated.count > 0) tets.findings.push_back(std::move(repeated));
    tets.cells.resize(order.size());
    for_each_parallel(order.size(), [&](std::size_t i) {
      for (std::size_t v = 0; v < 4; ++v)
        tets.cells[i].points[v] =
            static_cast<std::uint32_t>(ids[4 * static_cast<std::size_t>(order[i]) + v]);
      tets.cells[i].neighbors.fill(kNone);
    });
  });
  return order;
}

// Points in the order in which the cells first use them; unused points are left out.
void order_points(const Mesh& mesh, const ScalarField& scalar, TetAdjacency& tets) {
  std::vector<std::uint32_t> renumbered(mesh.point_count(), kNone);
  std::vector<std::uint32_t> original;
  original.reserve(mesh.point_count());
  for (auto& cell : tets.cells) {
    for (auto& point : cell.points) {
      if (renumbered[point] == kNone) {
        renumbered[point] = static_cast<std::uint32_t>(original.size());
        original.push_back(point);
      }
      point = renumbered[point];
    }
  }
  const bool on_points = scalar.association == Association::point;
  tets.points.resize(original.size());
  mesh.points.visit([&](auto xyz) {
    for_each_parallel(original.size(), [&](std::size_t i) {
      const std::size_t p = original[i];
      tets.points[i] = tets.frame.local(
          static_cast<double>(xyz[3 * p]), static_cast<double>(xyz[3 * p + 1]),
          static_cast<double>(xyz[3 * p + 2]), on_points ? scalar.values[p] : 0.0f);
    });
  });
}

void find_neighbors(TetAdjacency& tets, const std::vector<std::uint32_t>& original) {
  Finding crowded{"faces shared by more than two cells", 0, {}};
  std::mutex guard;
  auto key = [&](std::size_t slot) {
    auto ids = face_points(tets.cells[slot / 4], slot % 4);
    sort_odd(ids);
    return ids;
  };
  match_faces(
      tets.points.size(), 4 * tets.cells.size(), key,
      [](std::uint32_t, std::uint32_t) { return true; },
      [&](std::uint32_t a, std::uint32_t b) {
        tets.cells[a / 4].neighbors[a % 4] = b / 4;
        tets.cells[b / 4].neighbors[b % 4] = a / 4;
      },
      [&](std::uint32_t slot) {
        const std::lock_guard lock(guard);
        add_example(crowded, original[slot / 4]);
      });
  if (crowded.count > 0) tets.findings.push_back(std::move(crowded));
}

// The face of `neighbor` that it shares with `cell` through the cell's face.
std::size_t face_back(const TetAdjacency& tets, std::size_t cell, std::size_t face) {
  auto wanted = face_points(tets.cells[cell], face);
  sort_odd(wanted);
  const auto& other = tets.cells[tets.cells[cell].neighbors[face]];
  std::size_t back = 0;
  for (; back < 3; ++back) {
    auto ids = face_points(other, back);
    sort_odd(ids);
    if (ids == wanted) break;
  }
  return back;
}

bool agree(const TetAdjacency& tets, std::size_t cell, std::size_t face) {
  const auto& neighbor = tets.cells[tets.cells[cell].neighbors[face]];
  return odd_face(tets.cells[cell], face) != odd_face(neighbor, face_back(tets, cell, face));
}

void turn(TetAdjacency::Cell& cell) {
  std::swap(cell.points[0], cell.points[1]);
  std::swap(cell.neighbors[0], cell.neighbors[1]);
}

void orient(TetAdjacency& tets, const std::vector<std::uint32_t>& original) {
  // Mostly all cells are right already, and a look at each of them tells.
  std::atomic<bool> right = true;
  for_each_parallel(tets.cells.size(), [&](std::size_t i) {
    if (!right.load(std::memory_order_relaxed)) return;
    bool fine = signed_volume(tets, i) > 0;
    for (std::size_t f = 0; f < 4 && fine; ++f)
      fine = tets.cells[i].neighbors[f] == kNone || agree(tets, i, f);
    if (!fine) right.store(false, std::memory_order_relaxed);
  });
  if (right) return;

  Finding one_sided{"faces where neighbours cannot agree on a side, taken as boundary", 0, {}};
  std::vector<std::array<std::uint32_t, 2>> cuts;
  const auto turned = cells_to_turn(
      tets.cells.size(),
      [&](std::uint32_t cell, const auto& visit) {
        for (std::size_t f = 0; f < 4; ++f)
          if (tets.cells[cell].neighbors[f] != kNone)
            visit(tets.cells[cell].neighbors[f], agree(tets, cell, f), static_cast<int>(f));
      },
      [&](std::uint32_t cell) { return signed_volume(tets, cell); },
      [&](std::uint32_t cell, int face) {
        cuts.push_back({cell, static_cast<std::uint32_t>(face)});
      });
  for (const auto& [cell, face] : cuts) {
    tets.cells[cell].neighbors[face] = kNone;
    add_example(one_sided, original[cell]);
  }
  if (one_sided.count > 0) tets.findings.push_back(std::move(one_sided));
  Finding reversed{"tetrahedra listed with the opposite orientation, turned around", 0, {}};
  for (std::size_t i = 0; i < tets.cells.size(); ++i) {
    if (!turned[i]) continue;
    turn(tets.cells[i]);
    add_example(reversed, original[i]);
  }
  if (reversed.count > 0) tets.findings.push_back(std::move(reversed));
}

}  // namespace

TetAdjacency find_tet_adjacency(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds) {
  TetAdjacency tets;
  tets.frame = LocalFrame::of(bounds);
  tets.original = order_cells(mesh, tets);
  order_points(mesh, scalar, tets);
  find_neighbors(tets, tets.original);
  orient(tets, tets.original);
  return tets;
}

}  // namespace plume
