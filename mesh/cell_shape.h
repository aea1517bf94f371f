/// Which type of cell a set of faces is, and in which order its corners come.
#pragma once

#include <array>
#include <cstdint>

#include "plume/mesh/mesh.h"
#include "plume/mesh/walkable_cells.h"

namespace plume {

/// A cell of a type whose points determine its interior.
struct CellShape {
  /// tetrahedron, hexahedron, wedge or pyramid; polyhedron for all else.
  CellType type = CellType::polyhedron;
  /// Points in VTK's order, up to the symmetries of the type, which change nothing in its
  /// interpolation; as many as the type has, none for a polyhedron.
  std::array<std::uint32_t, 8> corners{};
};

/// Tells a walkable cell's shape from its faces. Nothing is stored for it: who wants values inside
/// of cells pays for it, who walks does not. What counts is what is there, not what the file called
/// it: a polyhedron with the faces of a hexahedron is one, and a hexahedron collapsed to a wedge is
/// a wedge; one with a single edge collapsed is a polyhedron.
CellShape shape_of(const WalkableCells& mesh, std::uint32_t cell);

}  // namespace plume
