/// What each engine does, without its types; for tetrahedralize.cpp alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plume/mesh/array.h"
#include "plume/mesh/tetrahedralize.h"

namespace plume {

bool has_tetgen();
bool has_cgal();

/// Four points a tetrahedron (int32); empty where all points are in a plane. Points are distinct
/// and finite, at least four.
Array cgal_delaunay(std::span<const double> points);

/// The same. Throws Error where TetGen fails.
Array tetgen_delaunay(std::span<const double> points);

/// What TetGen makes of a piecewise linear complex: all that its facets separate from infinity.
struct TetgenMesh {
  Array points;      ///< double, 3 a point; those given come first
  Array tetrahedra;  ///< int32, 4 a tetrahedron
  Array neighbors;   ///< int32, 4 a tetrahedron: beyond the face opposite to each corner, or -1
  Array facets;      ///< int32, 3 a triangle: faces of tetrahedra that lie in the surface
};

/// Throws Error where TetGen fails, naming triangles that intersect where that is why, by their
/// `numbers`.
TetgenMesh tetgen_fill(std::span<const double> points,
                       const std::vector<std::array<std::uint32_t, 3>>& triangles,
                       const std::vector<std::uint32_t>& numbers, const SurfaceMeshing& meshing);

}  // namespace plume
