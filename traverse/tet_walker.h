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

#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/measure.h"
#include "plume/traverse/packet_start.h"

namespace plume {

class TetWalker {
 public:
  using Mesh = WalkableTets;
  using Boundary = WalkableTets::Boundary;

  TetWalker(const WalkableTets& mesh, const ShearedFrame& frame) : mesh_(mesh), frame_(frame) {}

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
    next_ = {face.cell, face.apex};
    auto t = triangle(face);
    if (boundary_winding(face) < 0) std::swap(t[1], t[2]);
    // Of a triangle that winds once, one edge counts, and that one once.
    std::size_t first = 0;
    while (crossing(t[first].at, t[(first + 1) % 3].at) == 0) ++first;
    low_ = t[first];
    high_ = t[(first + 1) % 3];
    third_ = t[(first + 2) % 3];
    cell_ = next_.cell;
  }

  /// The same for a lane of a packet; enter() must have been called.
  PacketStart packet_start(const Crossing& place, std::uint32_t ray) const {
    return {{low_.at, high_.at, third_.at},
            {low_.id, high_.id, third_.id},
            next_.cell,
            next_.apex,
            frame_.line(),
            static_cast<float>(place.z),
            place.scalar,
            static_cast<float>(frame_.t_per_z()),
            ray};
  }

  std::uint32_t cell() const { return cell_; }

  /// Where the ray leaves the current cell.
  ///
  /// The triangle by which it came in winds once about the ray: the edge from low to high crosses
  /// on the right, and the edge that comes down again, past the third corner, on the left. The
  /// apex is joined to the end of the first edge that lies across from it, and if that edge crosses
  /// on the right as well, it is the new first edge, unless the one to the third corner is. So two
  /// tests tell which of the three faces around the apex winds once: the way out, and the triangle
  /// by which the next cell is entered.
  std::optional<Crossing> leave() {
    const Corner apex{next_.apex, frame_(mesh_.points[next_.apex])};
    const bool up = apex.at.up();
    Corner& across = up ? low_ : high_;  // its edge to the apex may cross
    Corner& beside = up ? high_ : low_;  // its edge to the apex does not
    bool first = crossing(across.at, apex.at) != 0;
    const bool second = crossing(third_.at, apex.at) != 0;
    // Rounding may let all four faces wind about the ray: two ways in and two out. Faces are known
    // by the point that they leave out; the way in with the smaller point goes with the way out
    // with the smaller one, which is one-to-one and the same whichever way in we came by.
    if (!first && second) first = (apex.id < beside.id) == (across.id < third_.id);

    Corner behind;  // the corner that the face left through leaves out
    if (!first) {
      behind = std::exchange(third_, apex);
    } else if (second) {
      behind = std::exchange(across, third_);
      third_ = std::exchange(beside, apex);
    } else {
      behind = std::exchange(beside, apex);
    }
    const std::size_t rank = static_cast<std::size_t>(low_.id < behind.id) +
                             static_cast<std::size_t>(high_.id < behind.id) +
                             static_cast<std::size_t>(third_.id < behind.id);
    next_ = mesh_.cells[cell_][rank];
    return measure_triangle(low_.at, high_.at, third_.at);
  }

  /// Into the cell behind the face left through; false at the boundary.
  bool advance() {
    cell_ = next_.cell;
    return cell_ != kNone;
  }

 private:
  struct Corner {
    std::uint32_t id;
    ShearedPoint at;
  };

  std::array<Corner, 3> triangle(const Boundary& face) const {
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = {face.loop[i], frame_(mesh_.points[face.loop[i]])};
    return corners;
  }

  const WalkableTets& mesh_;
  const ShearedFrame& frame_;
  std::uint32_t cell_ = kNone;
  WalkableTets::Link next_{kNone, 0};
  // The triangle by which the ray came into the cell: low is down, high is up, and the edge between
  // them crosses on the ray's right.
  Corner low_{}, high_{}, third_{};
};

}  // namespace plume
