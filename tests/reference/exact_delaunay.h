/// A Delaunay tetrahedralization and what a segment meets in it, decided exactly: an oracle for
/// walkers, with nothing shared but the coordinates.
///
/// Cells are found by CGAL's segment traverser with exact predicates: C. Jamin, S. Pion,
/// M. Teillaud, "3D Triangulations", CGAL User and Reference Manual 5.5,
/// Triangulation_3::segment_traverser_cells_begin(). Lengths need no traversal: the convex hull is
/// an intersection of half-spaces, and the segment is clipped by them in rational numbers.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace plume::reference {

/// Immutable. Not for several threads at once.
class ExactDelaunay {
 public:
  using Point = std::array<double, 3>;
  /// From one point to another; the two must differ. All coordinates are taken as they are.
  struct Segment {
    Point from, to;
  };

  /// Triangulates points that are finite, distinct, and not all in one plane; throws
  /// std::invalid_argument otherwise. Where five and more points lie on a sphere, CGAL's symbolic
  /// perturbation picks one of the triangulations, without flat cells and always the same.
  explicit ExactDelaunay(const std::vector<Point>& points);
  ~ExactDelaunay();
  ExactDelaunay(ExactDelaunay&&) noexcept;
  ExactDelaunay& operator=(ExactDelaunay&&) noexcept;

  const std::vector<Point>& points() const { return points_; }
  /// Four points each, by number; positively oriented: det(b - a, c - a, d - a) > 0, exactly.
  const std::vector<std::array<std::uint32_t, 4>>& tetrahedra() const { return tetrahedra_; }

  /// The tetrahedra that the segment passes through, in order along it.
  ///
  /// Without error where the segment meets the interior of cells and faces only. A cell that is
  /// touched in a face, an edge or a vertex only may or may not be listed. Throws
  /// std::runtime_error where the traverser does not end.
  std::vector<std::uint32_t> cells_along(const Segment& segment) const;

  /// Length of the segment's part in the convex hull, sides included; 0 where it misses. Computed
  /// in rational numbers, the root to 256 bits, and rounded once.
  double length_in_hull(const Segment& segment) const;

  /// The same after all the hull's planes have been moved outwards by a distance (inwards where it
  /// is negative). Whatever moves the hull's points by no more than that leaves a length between
  /// the two. Computed in double: the planes are off by some 1e-15 of the coordinates' size.
  double length_in_moved_hull(const Segment& segment, double outwards) const;

  /// How far the segment is from any doubt about which cells it passes through: moving all points
  /// by less than this, in any directions, leaves cells_along() what it is.
  ///
  /// That is the least distance between the segment's line and the edges of `cells` (those that
  /// the segment passes through) and of the hull, and between the segment's ends and the planes of
  /// the first and the last of the cells' faces: as the points move, the list cannot change before
  /// the line meets an edge of a cell on it or of the hull, or an end a face. Computed in double,
  /// within some 1e-15 of the coordinates' size.
  double clearance(const Segment& segment, const std::vector<std::uint32_t>& cells) const;

  /// Whether a point of the segment is inside the tetrahedron and further than `depth` from its
  /// faces' planes; with a negative depth, whether one is less than -depth outside of each of them.
  /// Computed in double, as above.
  bool passes(const Segment& segment, std::uint32_t cell, double depth) const;

 private:
  struct Implementation;

  std::vector<Point> points_;
  std::vector<std::array<std::uint32_t, 4>> tetrahedra_;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace plume::reference
