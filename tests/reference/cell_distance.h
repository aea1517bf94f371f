/// How far a place is from a cell, whatever the cell's shape: no winding about a ray, no adjacency,
/// no code shared with the walkers.
#pragma once

#include "line_lengths.h"

namespace plume::reference {

/// 0 inside of the cell, else the distance to the nearest of its faces. Triangles are plane,
/// quadrilaterals bilinear patches, other polygons fans around their mean.
///
/// Inside is told by the solid angle of the faces (Van Oosterom and Strackee, 1983), patches cut
/// into triangles: so many that what they deviate, a place within it may be called outside, is
/// below 2e-5 of how far a patch's diagonals are apart. Distances are to the patches themselves
/// (Gauss' and Newton's method).
double distance_outside(const CellLoops& cell, const Point3& place);

}  // namespace plume::reference
