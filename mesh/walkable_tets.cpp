#include "plume/mesh/walkable_tets.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "plume/mesh/cell_faces.h"
#include "plume/mesh/tet_adjacency.h"

namespace plume {
namespace {

std::uint32_t all_points(const TetAdjacency::Cell& cell) {
  return cell.points[0] ^ cell.points[1] ^ cell.points[2] ^ cell.points[3];
}

// How many of the cell's points have smaller numbers.
std::size_t rank_of(const TetAdjacency::Cell& cell, std::uint32_t point) {
  return static_cast<std::size_t>(std::count_if(cell.points.begin(), cell.points.end(),
                                                [point](std::uint32_t p) { return p < point; }));
}

WalkableTets::Cell linked(const TetAdjacency& adjacency, const TetAdjacency::Cell& cell) {
  WalkableTets::Cell links;
  for (std::size_t f = 0; f < 4; ++f) {
    const std::uint32_t neighbor = cell.neighbors[f];
    // What the face's three points leave of the neighbour's four.
    const std::uint32_t apex = neighbor == kNone ? 0
                                                 : all_points(adjacency.cells[neighbor]) ^
                                                       all_points(cell) ^ cell.points[f];
    links[rank_of(cell, cell.points[f])] = {neighbor, apex};
  }
  return links;
}

}  // namespace

std::size_t WalkableTets::bytes() const {
  return points.size() * sizeof(WalkablePoint) + cells.size() * sizeof(Cell) +
         cell_values.size() * sizeof(float) + original_cells.size() * sizeof(std::uint32_t) +
         boundary.size() * sizeof(Boundary);
}

WalkableTets make_walkable_tets(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds,
                                bool keep_original_cells) {
  TetAdjacency adjacency = find_tet_adjacency(mesh, scalar, bounds);
  WalkableTets tets;
  tets.frame = adjacency.frame;
  tets.points = std::move(adjacency.points);
  tets.findings = std::move(adjacency.findings);
  tets.cells.resize(adjacency.cells.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tets.cells.size(), 4096),
                    [&](const auto& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i)
                        tets.cells[i] = linked(adjacency, adjacency.cells[i]);
                    });
  for (std::uint32_t i = 0; i < adjacency.cells.size(); ++i) {
    const TetAdjacency::Cell& cell = adjacency.cells[i];
    for (std::size_t f = 0; f < 4; ++f) {
      if (cell.neighbors[f] != kNone) continue;
      WalkableTets::Boundary face{i, cell.points[f], {}};
      for (std::size_t p = 0; p < 3; ++p)
        face.loop[p] = cell.points[static_cast<std::size_t>(kTetrahedronFaces[f][p])];
      tets.boundary.push_back(face);
    }
  }
  if (scalar.association == Association::cell) {
    tets.cell_values.reserve(adjacency.original.size());
    for (const std::uint32_t cell : adjacency.original)
      tets.cell_values.push_back(scalar.values[cell]);
  }
  if (keep_original_cells) tets.original_cells = std::move(adjacency.original);
  return tets;
}

}  // namespace plume
