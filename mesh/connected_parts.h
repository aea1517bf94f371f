/// How many pieces a mesh consists of.
#pragma once

#include <cstddef>

#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/mesh/walkable_rectilinear.h"
#include "plume/mesh/walkable_tets.h"

namespace plume {

/// Number of sets of cells that hang together by faces; hidden cells belong to none.
std::size_t connected_parts(const WalkableTets& mesh);
std::size_t connected_parts(const WalkableGrid& mesh);
std::size_t connected_parts(const WalkableRectilinear& mesh);
std::size_t connected_parts(const WalkableCells& mesh);

}  // namespace plume
