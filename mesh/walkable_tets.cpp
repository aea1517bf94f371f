#include "plume/mesh/walkable_tets.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "plume/mesh/cell_faces.h"
#include "plume/mesh/tet_adjacency.h"

namespace plume {
namespace {

// The faces without a neighbour, in the order of the cells.
std::vector<WalkableTets::Boundary> boundary_of(const TetAdjacency& adjacency) {
  constexpr std::size_t kStretch = 4096;
  const std::size_t cells = adjacency.cells.size();
  std::vector<std::vector<WalkableTets::Boundary>> parts((cells + kStretch - 1) / kStretch);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    const std::size_t end = std::min(cells, (part + 1) * kStretch);
    for (std::size_t c = part * kStretch; c < end; ++c) {
      const WalkableTets::Cell& cell = adjacency.cells[c];
      for (std::size_t r = 0; r < 4; ++r) {
        if (cell[r].cell != kNone) continue;
        WalkableTets::Boundary face{static_cast<std::uint32_t>(c), cell[r].apex, {}};
        for (std::size_t p = 0; p < 3; ++p)
          face.loop[p] = cell[static_cast<std::size_t>(kTetrahedronFaces[r][p])].apex;
        if (adjacency.odd[c]) std::swap(face.loop[1], face.loop[2]);
        parts[part].push_back(face);
      }
    }
  });
  std::vector<WalkableTets::Boundary> boundary;
  std::size_t count = 0;
  for (const auto& part : parts) count += part.size();
  boundary.reserve(count);
  for (const auto& part : parts) boundary.insert(boundary.end(), part.begin(), part.end());
  return boundary;
}

// Turns "own point, same face of the neighbour" into "neighbour, its point", in place. Across a
// face each of the two cells needs the other's point, so these two are swapped, when the face with
// the smaller number is met; nobody else reads or writes them.
void link(std::vector<WalkableTets::Cell>& cells) {
  // The neighbours of a cell so far ahead are fetched while others are linked.
  constexpr std::size_t kAhead = 16;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 4096), [&](const auto& range) {
    for (std::size_t c = range.begin(); c != range.end(); ++c) {
      if (c + kAhead < range.end())
        for (const WalkableTets::Link& later : cells[c + kAhead])
          if (later.cell != kNone) __builtin_prefetch(&cells[later.cell / 4], 1);
      for (std::size_t r = 0; r < 4; ++r) {
        WalkableTets::Link& own = cells[c][r];
        if (own.cell == kNone) {
          own.apex = 0;
          continue;
        }
        if (4 * c + r < own.cell) std::swap(own.apex, cells[own.cell / 4][own.cell % 4].apex);
        own.cell /= 4;
      }
    }
  });
}

}  // namespace

std::size_t WalkableTets::bytes() const {
  return points.size() * sizeof(WalkablePoint) + cells.size() * sizeof(Cell) +
         cell_values.size() * sizeof(float) + original_cells.size() * sizeof(std::uint32_t) +
         point_numbers.size() * sizeof(std::uint32_t) + boundary.size() * sizeof(Boundary);
}

WalkableTets make_walkable_tets(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds,
                                bool keep_original_cells, bool keep_point_numbers) {
  TetAdjacency adjacency = find_tet_adjacency(mesh, scalar, bounds);
  WalkableTets tets;
  tets.frame = adjacency.frame;
  tets.points = std::move(adjacency.points);
  tets.findings = std::move(adjacency.findings);
  tets.boundary = boundary_of(adjacency);
  tets.cells = std::move(adjacency.cells);
  link(tets.cells);
  if (scalar.association == Association::cell) {
    tets.cell_values.reserve(adjacency.original.size());
    for (const std::uint32_t cell : adjacency.original)
      tets.cell_values.push_back(scalar.values[cell]);
  }
  if (keep_original_cells) tets.original_cells = std::move(adjacency.original);
  if (keep_point_numbers) tets.point_numbers = std::move(adjacency.numbers);
  return tets;
}

}  // namespace plume
