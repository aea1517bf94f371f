/// The faces of one cell, made into a closed, oriented surface.
#pragma once

#include <cstdint>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume {

/// Loops of point ids, one after the other.
struct CellFaces {
  std::vector<std::uint32_t> sizes;
  std::vector<std::uint32_t> ids;
};

/// Takes repeated points out of each loop and drops loops of fewer than three points.
void drop_repeated_points(CellFaces& faces);

/// Turns the loops so that every edge is walked once in each direction and the enclosed volume is
/// positive. False where that cannot be done: an edge that is not shared by exactly two faces, or a
/// one-sided surface. Such a cell has no inside.
bool close_and_orient(const Mesh& mesh, CellFaces& faces);

/// True where each edge is walked as often in one direction as in the other: then the windings of
/// the loops about any ray sum to zero.
bool is_closed(const CellFaces& faces);

}  // namespace plume
