/// What mesh generators bound.
#pragma once

#include <array>

namespace plume {

struct TetrahedronQuality {
  /// Negative where the points are not in VTK's order.
  double volume;
  /// Radius of the circumscribed sphere by the shortest edge, at least sqrt(6) / 4; infinite or not
  /// a number where the volume is 0.
  double radius_edge_ratio;
  /// The smallest, in degrees, at most 70.53.
  double dihedral_angle;
};

/// In double: relative to the tetrahedron's size, volume and sphere are as precise as rounding of
/// differences of its points leaves them.
TetrahedronQuality quality_of(const std::array<std::array<double, 3>, 4>& points);

}  // namespace plume
