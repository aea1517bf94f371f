/// The faces of each type of cell, as loops of its points seen from outside.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "plume/mesh/mesh.h"

namespace plume {

/// One face of a cell type: `size` local point numbers, counterclockwise from outside of a cell in
/// VTK's positive orientation.
struct FaceLoop {
  int size;
  std::array<std::int8_t, 6> points;
};

/// The faces of a type with a fixed number of points; empty for a polyhedron. A hexagonal prism has
/// faces of six points; those come from VTK's definition, as do all the others.
std::span<const FaceLoop> faces_of(CellType type);

/// A tetrahedron's faces by the point opposite to each: kTetrahedronFaces[i] leaves out point i.
inline constexpr int kTetrahedronFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

}  // namespace plume
