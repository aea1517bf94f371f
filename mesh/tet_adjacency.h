/// Tetrahedra in order, with their neighbours and one orientation: on the way to the walkable form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/mesh/findings.h"
#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"
#include "plume/mesh/scalar_field.h"
#include "plume/mesh/walkable_tets.h"

namespace plume {

/// Tetrahedra that know their points and neighbours.
///
/// A cell's points are in ascending order. Its face r is the one that leaves out point r, so that
/// the ascending points of all its faces are known without sorting. Face r of cell c has the number
/// 4 * c + r.
struct TetAdjacency {
  LocalFrame frame;
  std::vector<WalkablePoint> points;
  /// In memory that becomes WalkableTets::cells: cells[c][r].apex is point r of cell c itself, and
  /// cells[c][r].cell the number of the same face of its neighbour, kNone at the boundary.
  std::vector<WalkableTets::Cell> cells;
  /// Whether a cell's ascending points have the opposite of VTK's positive orientation, after the
  /// cells that hang together were given one.
  std::vector<std::uint8_t> odd;
  /// The user's number of each cell.
  std::vector<std::uint32_t> original;
  /// The number here of each of the user's points; kNone where no cell uses it.
  std::vector<std::uint32_t> numbers;
  std::vector<Finding> findings;

  std::uint32_t& point(std::size_t face) { return cells[face / 4][face % 4].apex; }
  std::uint32_t point(std::size_t face) const { return cells[face / 4][face % 4].apex; }
  std::uint32_t& partner(std::size_t face) { return cells[face / 4][face % 4].cell; }
  std::uint32_t partner(std::size_t face) const { return cells[face / 4][face % 4].cell; }

  /// Whether a face's two cells see it from opposite sides. The boundary of an oriented simplex is
  /// the alternating sum of its faces: these are opposite where the signs differ.
  bool agree(std::size_t face, std::size_t other) const {
    return ((face + other + odd[face / 4] + odd[other / 4]) & 1) != 0;
  }
};

/// Orders cells along a Hilbert curve and points as the cells use them, finds neighbours, gives all
/// cells that hang together one orientation. Requires a mesh of tetrahedra that passed
/// check_structure(). Takes 37 bytes a cell and 24 a point, the result included; more where
/// orient_tets() has to look at all cells. The result does not depend on the number of threads.
TetAdjacency find_tet_adjacency(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds);

}  // namespace plume
