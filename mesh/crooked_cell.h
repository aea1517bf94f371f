/// Cells that a ray might not leave behind where it came in.
#pragma once

#include <cstdint>

#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"

namespace plume {

/// False where the cell's faces, as the surfaces that walkers take them for, are all seen from the
/// mean of its corners from inside, and none of their tangent planes comes nearer to it than
/// kLeastWidth (cell_hierarchy.h). Such a surface is crossed by a line in and out in turns, and the
/// i-th way in along a ray is before the i-th way out. Degenerate cells are crooked.
///
/// Of a bilinear patch its corners' tangent planes say it (crooked_cell.cpp).
bool is_crooked(const WalkableGrid& mesh, std::uint32_t cell);
bool is_crooked(const WalkableCells& mesh, std::uint32_t cell);

}  // namespace plume
