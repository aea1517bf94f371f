/// How much of a line lies in each cell, found by intersecting it with every face of every cell: no
/// adjacency, no windings, no order along the line, no code shared with the walkers.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace plume::reference {

using Point3 = std::array<double, 3>;

/// The loops of a cell's faces, all seen from outside or all from inside. Three points are a
/// triangle, four the bilinear patch (1-u)(1-v) a + u(1-v) b + uv c + (1-u)v d, more a fan of
/// triangles around their mean.
using CellLoops = std::vector<std::vector<Point3>>;

struct LineLengths {
  /// Of each cell: the sum over its faces of where the line goes out, less where it comes in.
  std::vector<double> length;
  /// Of each cell: the integral of t over that part of the line.
  std::vector<double> moment;
  /// Patches that are crossed twice, each counted once a cell.
  std::size_t grazes = 0;
};

/// In long double. Roots are found by bisection on either side of the extremum of the quadratic, so
/// that no root of a discriminant is taken. `direction` has length one.
LineLengths line_lengths(const std::vector<CellLoops>& cells, const Point3& origin,
                         const Point3& direction);

/// What lines moved sideways by `distance` (in eight directions) and the line itself see of each
/// cell, at least and at most: where the line only touches a face, a small distance makes a great
/// difference.
struct LengthRange {
  std::vector<double> low, high;
  std::size_t grazes = 0;  ///< of the line itself
};
LengthRange line_length_range(const std::vector<CellLoops>& cells, const Point3& origin,
                              const Point3& direction, double distance);

/// Crossings of one patch: how many in each direction (first along the normal of the loop's sense).
std::array<int, 2> patch_crossings(const std::array<Point3, 4>& loop, const Point3& origin,
                                   const Point3& direction);

}  // namespace plume::reference
