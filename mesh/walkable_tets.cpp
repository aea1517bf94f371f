#include "plume/mesh/walkable_tets.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "plume/mesh/cell_faces.h"
#include "plume/mesh/huge_pages.h"
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

// From what link() begins with.
std::vector<WalkableTets::CompactCell> compact(const std::vector<WalkableTets::Cell>& cells) {
  std::vector<WalkableTets::CompactCell> compact;
  resize_in_huge_pages(compact, cells.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 4096), [&](const auto& range) {
    for (std::size_t c = range.begin(); c != range.end(); ++c) {
      const WalkableTets::Cell& cell = cells[c];
      auto neighbor = [&](std::size_t face) {
        return cell[face].cell == kNone ? kNone : cell[face].cell / 4;
      };
      compact[c].points = cell[0].apex ^ cell[1].apex ^ cell[2].apex ^ cell[3].apex;
      for (std::size_t r = 1; r < 4; ++r) compact[c].neighbors[r - 1] = neighbor(r) ^ neighbor(0);
    }
  });
  return compact;
}

std::vector<std::uint64_t> bits_of(const std::vector<std::uint8_t>& flags) {
  std::vector<std::uint64_t> bits((flags.size() + 63) / 64, 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bits.size(), 1024), [&](const auto& range) {
    for (std::size_t word = range.begin(); word != range.end(); ++word) {
      const std::size_t end = std::min(flags.size(), 64 * word + 64);
      for (std::size_t c = 64 * word; c < end; ++c) bits[word] |= std::uint64_t{flags[c]} << c % 64;
    }
  });
  return bits;
}

}  // namespace

// Elsewhere than at the boundary, each neighbour's link back names the point that the common face
// leaves out. Which of its links that is cannot be guessed, so that selecting beats branching.
std::array<std::uint32_t, 4> WalkableTets::points_of(std::uint32_t cell) const {
  const Cell& own = cells[cell];
  const std::uint32_t n0 = own[0].cell, n1 = own[1].cell, n2 = own[2].cell, n3 = own[3].cell;
  const bool boundary_or_twice = n0 == kNone || n1 == kNone || n2 == kNone || n3 == kNone ||
                                 n0 == n1 || n0 == n2 || n0 == n3 || n1 == n2 || n1 == n3 ||
                                 n2 == n3;
  if (boundary_or_twice) return points_of_rare(cell);
  auto back = [&](std::uint32_t neighbor) {
    const Cell& links = cells[neighbor];
    // One link alone leads back. Compilers make branches of what is written as a choice.
    std::uint32_t apex = 0;
    for (const Link& link : links)
      apex |= link.apex & (0u - static_cast<unsigned>(link.cell == cell));
    return apex;
  };
  return {back(n0), back(n1), back(n2), back(n3)};
}

// At the boundary a face has all points. Two cells that share several faces share all their points,
// and the ranks of these are the same in both: the links back come in the order of ours.
std::array<std::uint32_t, 4> WalkableTets::points_of_rare(std::uint32_t cell) const {
  const Cell& own = cells[cell];
  std::array<std::uint32_t, 4> ids{};
  for (std::size_t rank = 0; rank < 4; ++rank) {
    const std::uint32_t neighbor = own[rank].cell;
    if (neighbor == kNone) {
      const auto face = std::lower_bound(
          boundary.begin(), boundary.end(), cell,
          [](const Boundary& candidate, std::uint32_t wanted) { return candidate.cell < wanted; });
      ids = {face->loop[0], face->loop[1], face->loop[2], face->apex};
      std::sort(ids.begin(), ids.end());
      return ids;
    }
    const Cell& links = cells[neighbor];
    std::size_t back = 0;
    while (links[back].cell != cell) ++back;
    for (std::size_t earlier = 0; earlier < rank; ++earlier)
      if (own[earlier].cell == neighbor)
        while (links[++back].cell != cell) {
        }
    ids[rank] = links[back].apex;
  }
  return ids;
}

std::size_t WalkableTets::bytes() const {
  return points.size() * sizeof(WalkablePoint) + cells.size() * sizeof(Cell) +
         compact_cells.size() * sizeof(CompactCell) + cell_values.size() * sizeof(float) +
         original_cells.size() * sizeof(std::uint32_t) +
         point_numbers.size() * sizeof(std::uint32_t) + boundary.size() * sizeof(Boundary) +
         odd_bits.size() * sizeof(std::uint64_t);
}

WalkableTets make_walkable_tets(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds,
                                bool keep_original_cells, bool keep_point_numbers, TetLinks links) {
  TetAdjacency adjacency = find_tet_adjacency(mesh, scalar, bounds);
  WalkableTets tets;
  tets.frame = adjacency.frame;
  tets.points = std::move(adjacency.points);
  tets.findings = std::move(adjacency.findings);
  tets.boundary = boundary_of(adjacency);
  if (links == TetLinks::compact) {
    tets.compact_cells = compact(adjacency.cells);
    adjacency.cells = {};
  } else {
    tets.cells = std::move(adjacency.cells);
    tets.odd_bits = bits_of(adjacency.odd);
    link(tets.cells);
  }
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
