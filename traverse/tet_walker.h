/// Walking tetrahedra: the plain scalar form.
///
/// On a vertex, an edge or in the plane of a face the ray is taken as moved a little (see
/// sheared_frame.h): it passes through exactly one chain of cells, those it touches only may be
/// left out, and their segments would have had no length.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/measure.h"

namespace plume {

class TetWalker {
 public:
  using Mesh = WalkableTets;
  using Boundary = WalkableTets::Boundary;

  TetWalker(const WalkableTets& mesh, const ShearedFrame& frame)
      : mesh_(mesh), frame_(frame), is_compact_(mesh.is_compact()) {}

  /// The winding of a boundary face about the ray, seen from outside.
  int boundary_winding(const Boundary& face) const {
    const auto t = triangle(face);
    return crossing(t[0].at, t[1].at) + crossing(t[1].at, t[2].at) + crossing(t[2].at, t[0].at);
  }

  /// Where the ray crosses a boundary face of that winding.
  Crossing measure_boundary(const Boundary& face, int /*winding*/) const {
    const auto t = triangle(face);
    return measure_triangle(t[0].at, t[1].at, t[2].at);
  }

  /// Starts at a boundary face that winds about the ray.
  void enter(const Boundary& face, std::uint32_t /*rank*/) {
    corners_ = triangle(face);
    for (std::size_t i = 0; i < 3; ++i)
      right_[i] = crosses_right(corners_[(i + 1) % 3], corners_[(i + 2) % 3]);
    next_ = {face.cell, face.apex};
    cell_ = next_.cell;
    previous_ = kNone;
  }

  std::uint32_t cell() const { return cell_; }

  /// Finds the face by which the ray leaves the current cell.
  ///
  /// A triangle has two edges that cross y = 0, one up and one down, or none; so it winds about the
  /// ray if and only if an odd number of its edges crosses on the ray's right. The triangle by
  /// which the ray came in winds; the bits of the three edges from its corners to the apex tell
  /// which of the three faces around the apex does: one of them, as windings sum to zero. That is
  /// the way out, and the triangle by which the next cell is entered.
  void decide() {
    const Corner apex{next_.apex, frame_(mesh_.points[next_.apex])};
    const bool to_apex[3] = {crosses_right(corners_[0], apex), crosses_right(corners_[1], apex),
                             crosses_right(corners_[2], apex)};
    // The face that leaves out corner i.
    auto winds = [&](std::size_t i) {
      return (right_[i] != to_apex[(i + 1) % 3]) != to_apex[(i + 2) % 3];
    };
    std::size_t out;
    if (winds(0))
      out = winds(1) ? way_out_of_two(apex) : 0;
    else
      out = winds(1) ? 1 : 2;

    const std::uint32_t behind = corners_[out].id;
    corners_[out] = apex;
    right_[(out + 1) % 3] = to_apex[(out + 2) % 3];
    right_[(out + 2) % 3] = to_apex[(out + 1) % 3];
    const std::size_t way_out = rank(behind);
    if (is_compact_)
      decide_compact(way_out, rank(apex.id) + (behind < apex.id ? 1 : 0));
    else
      next_ = mesh_.cells[cell_][way_out];
  }

  /// The same, and where the ray crosses that face.
  std::optional<Crossing> leave() {
    decide();
    return measure_triangle(corners_[0].at, corners_[1].at, corners_[2].at);
  }

  /// Into the cell behind the face left through; false at the boundary.
  bool advance() {
    previous_ = cell_;
    cell_ = next_.cell;
    return cell_ != kNone;
  }

 private:
  struct Corner {
    std::uint32_t id;
    ShearedPoint at;
  };

  /// How many of the corners' numbers are below this one.
  std::size_t rank(std::uint32_t id) const {
    std::size_t below = 0;
    for (const Corner& corner : corners_) below += corner.id < id ? 1 : 0;
    return below;
  }

  void decide_compact(std::size_t out, std::size_t in) {
    next_ = {mesh_.compact_cells[cell_].neighbor(out, in, previous_), 0};
    if (next_.cell == kNone) return;
    next_.apex =
        mesh_.compact_cells[next_.cell].apex(corners_[0].id ^ corners_[1].id ^ corners_[2].id);
  }

  static bool crosses_right(const Corner& a, const Corner& b) { return crossing(a.at, b.at) != 0; }

  /// Rounding may let all four faces wind about the ray: two ways in and two out, and two points on
  /// each side of y = 0. Faces are known by the point that they leave out; the other way in is that
  /// of the corner on the apex' side. The way in with the smaller point goes with the way out with
  /// the smaller one, which is one-to-one and the same whichever way in we came by.
  std::size_t way_out_of_two(const Corner& apex) const {
    std::size_t in = 0;
    while (corners_[in].at.up() != apex.at.up()) ++in;
    const std::size_t p = (in + 1) % 3, q = (in + 2) % 3;
    return (apex.id < corners_[in].id) == (corners_[p].id < corners_[q].id) ? p : q;
  }

  std::array<Corner, 3> triangle(const Boundary& face) const {
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = {face.loop[i], frame_(mesh_.points[face.loop[i]])};
    return corners;
  }

  const WalkableTets& mesh_;
  const ShearedFrame& frame_;
  const bool is_compact_;
  std::uint32_t cell_ = kNone, previous_ = kNone;
  WalkableTets::Link next_{kNone, 0};
  // The triangle by which the ray came into the cell, and whether the edges across from its corners
  // cross y = 0 on the ray's right.
  std::array<Corner, 3> corners_{};
  std::array<bool, 3> right_{};
};

}  // namespace plume
