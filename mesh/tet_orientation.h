/// One sense of inside and outside for tetrahedra that hang together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/mesh/tet_adjacency.h"

namespace plume {

/// Six times the volume of a cell, positive for one of VTK's positive orientation.
inline double signed_volume(const TetAdjacency& tets, std::size_t cell) {
  const WalkableTets::Cell& own = tets.cells[cell];
  const float* const origin = tets.points[own[0].apex].position;
  double edge[3][3];
  for (std::size_t e = 0; e < 3; ++e)
    for (std::size_t a = 0; a < 3; ++a)
      edge[e][a] = static_cast<double>(tets.points[own[e + 1].apex].position[a]) -
                   static_cast<double>(origin[a]);
  const double volume = edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) +
                        edge[0][1] * (edge[1][2] * edge[2][0] - edge[1][0] * edge[2][2]) +
                        edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
  return tets.odd[cell] ? -volume : volume;
}

/// Turns cells around as cells_to_turn() says, takes apart those that cannot agree, and adds both
/// to the findings. `agreed`: whether all neighbours agree as it is; `not_positive`: the cells, in
/// ascending order, whose signed_volume() is not above 0.
///
/// Where neighbours agree and few cells, or all, are inside out, which is what meshes are like, it
/// looks at few cells, or at each once; else at all, one after the other.
void orient_tets(TetAdjacency& tets, bool agreed, const std::vector<std::uint32_t>& not_positive);

}  // namespace plume
