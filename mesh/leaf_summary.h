/// What a CellHierarchy keeps of the cells of a leaf.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "plume/mesh/cell_hierarchy.h"
#include "plume/mesh/leaf_cells.h"

namespace plume {

struct LeafSummary {
  /// The box of all corners.
  std::array<float, 3> low, high;
  /// The range of the scalars, widened; [infinity, -infinity] where there is none.
  float least, greatest;
  /// See CellHierarchy::Leaf.
  unsigned thin;
  std::array<std::uint8_t, kLeafCells> ranges;
};

/// On the best instruction set that the machine has: the same bits on each.
LeafSummary summarize(const LeafCells& cells);

}  // namespace plume
