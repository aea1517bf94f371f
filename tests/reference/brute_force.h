/// Every cell that a line crosses, found by clipping against every cell: no adjacency, no order, no
/// code shared with the walkers.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace plume::reference {

struct CellSpan {
  std::size_t cell;
  double t_in, t_out;
  /// Cosine of the angle between the line and the normal of the plane crossed: moving the line by
  /// one unit moves the crossing by up to 1 / cosine.
  double cosine_in, cosine_out;
};

/// Tetrahedra given by four corners each. Spans longer than `shortest`, ordered by t_in.
std::vector<CellSpan> clip_tetrahedra(
    const std::vector<std::array<std::array<double, 3>, 4>>& tetrahedra,
    const std::array<double, 3>& origin, const std::array<double, 3>& direction, double shortest);

}  // namespace plume::reference
