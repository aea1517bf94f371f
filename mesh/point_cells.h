/// Which cells are around each point of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume {

/// 8 bytes a point, and 4 for each point of each cell: for a pass over the points, not to be kept.
struct PointCells {
  std::vector<std::size_t> begin;    ///< points + 1 offsets into cells
  std::vector<std::uint32_t> cells;  ///< ascending for each point, each once

  std::span<const std::uint32_t> around(std::size_t point) const {
    return {cells.data() + begin[point], cells.data() + begin[point + 1]};
  }
};

/// Gathers them, in parallel; hidden cells are left out. The result does not depend on the number
/// of threads. Requires check_structure().
PointCells cells_around_points(const Mesh& mesh);

}  // namespace plume
