/// A mesh as the old methods see it: cells of triangles, and the neighbour behind each.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume::atlas {

using Place = std::array<double, 3>;

struct CellSoup {
  static constexpr std::uint32_t kNobody = 0xFFFFFFFFu;
  struct Triangle {
    std::array<std::uint32_t, 3> points;
    std::uint32_t neighbor;  ///< kNobody at the boundary
  };
  struct Cell {
    std::vector<Triangle> triangles;
    bool tetrahedron = false;
    std::array<std::uint32_t, 4> corners{};  ///< of a tetrahedron
    Place center{0, 0, 0};                   ///< mean of its points
  };
  struct BoundaryTriangle {
    std::uint32_t cell, triangle;
  };
  std::vector<Place> points;
  std::vector<double> scalars;
  std::vector<Cell> cells;  ///< hidden ones have no triangles
  std::vector<BoundaryTriangle> boundary;
  double size = 0;  ///< the longest side of the bounds
  bool only_tetrahedra = true;

  /// Faces of more than three points are cut from the smallest point id, alike on both sides.
  explicit CellSoup(const Mesh& mesh);
};

}  // namespace plume::atlas
