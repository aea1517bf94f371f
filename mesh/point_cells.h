/// Which cells are around each point of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume {

/// For passes over the points of a mesh, not to be kept: 8 bytes a point and 4 for each point of
/// each cell, but nothing for a grid, where cells follow from the indices. Gathered in parallel;
/// the result does not depend on the number of threads. Refers to the mesh. Requires
/// check_structure().
class PointCells {
 public:
  explicit PointCells(const Mesh& mesh);

  /// The visible cells that have the point, in ascending order, each once.
  void around(std::size_t point, std::vector<std::uint32_t>& cells) const;

 private:
  void gather();

  const Mesh& mesh_;
  std::vector<std::size_t> begin_;    // points + 1 offsets into cells_
  std::vector<std::uint32_t> cells_;  // ascending for each point
};

}  // namespace plume
