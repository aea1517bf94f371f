/// Walking tetrahedra: the plain scalar form.
///
/// On a vertex, an edge or in the plane of a face the ray is taken as moved a little (see
/// sheared_frame.h): it passes through exactly one chain of cells, those it touches only may be
/// left out, and their segments would have had no length.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "plume/mesh/cell_faces.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/measure.h"

namespace plume {

class TetWalker {
 public:
  using Mesh = WalkableTets;

  TetWalker(const WalkableTets& mesh, const ShearedFrame& frame) : mesh_(mesh), frame_(frame) {}

  /// The winding of a boundary face about the ray, seen from outside.
  int boundary_winding(BoundaryFace boundary) const {
    const auto t = triangle(boundary);
    return crossing(t[0].at, t[1].at) + crossing(t[1].at, t[2].at) + crossing(t[2].at, t[0].at);
  }

  /// Where the ray crosses a boundary face of that winding.
  Crossing measure_boundary(BoundaryFace boundary, int winding) const {
    const auto t = triangle(boundary);
    return measure_triangle(t[0].at, t[1].at, t[2].at, winding);
  }

  /// Starts at a boundary face that winds about the ray.
  void enter(BoundaryFace boundary, std::uint32_t /*rank*/) {
    cell_ = boundary.cell;
    corner_ = triangle(boundary);
    if (boundary_winding(boundary) < 0) std::swap(corner_[1], corner_[2]);
    for (std::size_t i = 0; i < 3; ++i)
      edge_[i] = crossing(corner_[(i + 1) % 3].at, corner_[(i + 2) % 3].at);
  }

  std::uint32_t cell() const { return cell_; }

  /// Where the ray leaves the current cell. The triangle through which it came winds once about the
  /// ray; the three faces around the fourth point have the same boundary, so their windings sum to
  /// one: one of them is the way out, and the triangle by which the next cell is entered.
  std::optional<Crossing> leave() {
    const auto& cell = mesh_.cells[cell_];
    const std::uint32_t id = cell.points[0] ^ cell.points[1] ^ cell.points[2] ^ cell.points[3] ^
                             corner_[0].id ^ corner_[1].id ^ corner_[2].id;
    const Corner apex{id, frame_(mesh_.points[id])};
    std::array<int, 3> to_apex, winding;  // winding[i]: of the face that leaves out corner i
    for (std::size_t i = 0; i < 3; ++i) to_apex[i] = crossing(corner_[i].at, apex.at);
    for (std::size_t i = 0; i < 3; ++i)
      winding[i] = edge_[i] + to_apex[(i + 2) % 3] - to_apex[(i + 1) % 3];

    std::size_t behind = winding[0] > 0 ? 0 : winding[1] > 0 ? 1 : 2;
    if (winding[0] < 0 || winding[1] < 0 || winding[2] < 0) behind = paired(winding, id);
    const std::size_t next = (behind + 1) % 3, last = (behind + 2) % 3;
    for (std::size_t i = 0; i < 4; ++i)
      if (cell.points[i] == corner_[behind].id) next_ = cell.neighbors[i];
    corner_[behind] = apex;
    edge_[next] = to_apex[last];
    edge_[last] = -to_apex[next];
    return measure_triangle(corner_[0].at, corner_[1].at, corner_[2].at, 1);
  }

  /// Into the cell behind the face left through; false at the boundary.
  bool advance() {
    cell_ = next_;
    return cell_ != kNone;
  }

 private:
  struct Corner {
    std::uint32_t id;
    ShearedPoint at;
  };

  std::array<Corner, 3> triangle(BoundaryFace boundary) const {
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto local = static_cast<std::size_t>(kTetrahedronFaces[boundary.face][i]);
      const std::uint32_t id = mesh_.cells[boundary.cell].points[local];
      corners[i] = {id, frame_(mesh_.points[id])};
    }
    return corners;
  }

  // Rounding may let all four faces wind about the ray: two ways in and two out. Faces are known by
  // the point that they leave out. The way in with the smaller point goes with the way out with the
  // smaller one: one-to-one, and the same whichever way in we came by.
  std::size_t paired(const std::array<int, 3>& winding, std::uint32_t apex) const {
    const std::size_t in = winding[0] < 0 ? 0 : winding[1] < 0 ? 1 : 2;
    std::size_t smaller = (in + 1) % 3, larger = (in + 2) % 3;
    if (corner_[larger].id < corner_[smaller].id) std::swap(smaller, larger);
    return apex < corner_[in].id ? smaller : larger;
  }

  const WalkableTets& mesh_;
  const ShearedFrame& frame_;
  std::uint32_t cell_ = kNone;
  std::uint32_t next_ = kNone;
  // The triangle by which the ray came into the cell; edge_[i] is what its edge opposite to corner
  // i adds to its winding of one.
  std::array<Corner, 3> corner_{};
  std::array<int, 3> edge_{};
};

}  // namespace plume
