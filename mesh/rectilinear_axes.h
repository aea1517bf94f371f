/// The coordinates of a rectilinear grid: whether they are any, and the grid with its points
/// written out.
#pragma once

#include <cstddef>
#include <optional>

#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"

namespace plume {

/// Checks a rectilinear grid: as many coordinates along each axis as `dimensions` says, at least
/// two, finite, strictly ascending or strictly descending; fewer than 2^32 - 1 points; no array of
/// points besides; hidden_cells of the cells' number. Returns the bounds. Throws Error naming the
/// axis, the index, the value and the remedy.
Bounds check_axes(const Mesh& mesh);

/// The first place where an axis is not equidistant: further from where its ends would have it than
/// 4 units in the last place (of its own type) of the larger of them. Nothing for a regular grid's.
/// Requires check_axes().
std::optional<std::size_t> uneven_place(const Array& axis);

/// The same grid as a curvilinear one: 3 coordinates a point, float where all axes are, else
/// double; fields and hidden cells are shared. For whatever has no form for rectilinear grids.
/// Requires as many coordinates along each axis as `dimensions` says.
Mesh with_points(const Mesh& rectilinear);

}  // namespace plume
