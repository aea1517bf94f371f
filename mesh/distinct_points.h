/// Points made ready for a tetrahedralization: checked, in double, no two in one place.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plume/mesh/tetrahedralize.h"

namespace plume {

struct DistinctPoints {
  /// x, y, z of the points that were kept, in their order.
  std::vector<double> coordinates;
  /// Their numbers in the set given; empty where all were kept.
  std::vector<std::uint32_t> kept;
  /// For each point of the set, which of the kept ones is in its place; empty where all were kept.
  std::vector<std::uint32_t> place;

  std::size_t count() const { return coordinates.size() / 3; }
  /// The number in the set of a point that was kept.
  std::uint32_t original(std::size_t point) const;
};

/// Keeps the first of points with equal coordinates; says so in `findings`, and how many of the
/// others have other values than it. Throws Error where a coordinate is not finite, there are no
/// points or too many, or a field has not as many values as it should.
DistinctPoints distinct_points(const PointSet& set, std::vector<Finding>& findings);

/// The kept points and their fields, as a mesh's points and fields.
void take_points(const PointSet& set, const DistinctPoints& distinct, Mesh& mesh);

/// "point 3 (0, 0.5, 1)"
std::string describe_point(const DistinctPoints& points, std::size_t point);

/// How flat the points are, with the points that show it: "all 9 points are in the plane of point 0
/// (...), point 2 (...) and point 7 (...), or within 1e-17 of it". Distances are computed in
/// double. Takes its time; for messages.
std::string describe_spread(const DistinctPoints& points);

}  // namespace plume
