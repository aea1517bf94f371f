/// Tetrahedra in order, with their neighbours and one orientation: on the way to the walkable form.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plume/mesh/findings.h"
#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"
#include "plume/mesh/scalar_field.h"

namespace plume {

struct TetAdjacency {
  struct Cell {
    /// In VTK's order of positive orientation, as far as its neighbours allow (orientation.h).
    std::array<std::uint32_t, 4> points;
    /// neighbors[i] shares the face opposite to points[i]; kNone at the boundary.
    std::array<std::uint32_t, 4> neighbors;
  };
  LocalFrame frame;
  std::vector<WalkablePoint> points;
  std::vector<Cell> cells;
  /// The user's number of each cell.
  std::vector<std::uint32_t> original;
  std::vector<Finding> findings;
};

/// Orders cells along a Hilbert curve and points as the cells use them, finds neighbours, gives all
/// cells that hang together one orientation. Requires a mesh of tetrahedra that passed
/// check_structure().
TetAdjacency find_tet_adjacency(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds);

}  // namespace plume
