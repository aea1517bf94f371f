/// How a ray passes through one tetrahedron, by who has not walked to it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/measure.h"
#include "plume/traverse/tet_walker.h"

namespace plume {

/// A cell with all that a ray needs to know of it: its points in ascending order.
struct TetCell {
  std::uint32_t cell = kNone;
  std::array<WalkablePoint, 4> points{};
  bool odd = false;  ///< see WalkableTets::odd_bits
};

/// The way in and the way out, decided by the edges and measured on the faces as by TetWalker: the
/// same bits.
class TetPassage {
 public:
  enum class Ways : std::uint8_t { none, one, two };

  TetPassage(const TetCell& cell, const ShearedFrame& frame) : cell_(cell), frame_(frame) {
    for (std::size_t i = 0; i < 4; ++i) at_[i] = frame(cell.points[i]);
    const int c01 = crossing(at_[0], at_[1]), c02 = crossing(at_[0], at_[2]);
    const int c03 = crossing(at_[0], at_[3]), c12 = crossing(at_[1], at_[2]);
    const int c13 = crossing(at_[1], at_[3]), c23 = crossing(at_[2], at_[3]);
    // Seen from outside where the cell is not odd: kTetrahedronFaces.
    const std::array<int, 4> windings{c12 + c23 - c13, c03 - c23 - c02, c01 + c13 - c03,
                                      c02 - c12 - c01};
    const int outwards = cell.odd ? -frame.sign() : frame.sign();
    int found = 0;
    for (std::size_t face = 0; face < 4; ++face) {
      if (windings[face] == 0) continue;
      ++found;
      (windings[face] * outwards > 0 ? out_ : in_) = face;
    }
    ways_ = found == 0 ? Ways::none : found == 2 ? Ways::one : Ways::two;
  }

  /// `two` where rounding lets all four faces wind about the ray: then nothing else holds.
  Ways ways() const { return ways_; }
  /// Of the two faces, by the rank of the point that each leaves out.
  std::size_t in_face() const { return in_; }
  std::size_t out_face() const { return out_; }
  Crossing in() const { return measure(in_); }
  Crossing out() const { return measure(out_); }

  /// Whether the ray passes all edges of the face by which it comes in at a distance, times their
  /// length (in the sum of x and y), of more than that, in the sheared frame.
  bool enters_clear_of_edges(float distance) const {
    for (std::size_t i = 1; i < 4; ++i) {
      const ShearedPoint& a = at_[(in_ + i) % 4];
      const ShearedPoint& b = at_[(in_ + i % 3 + 1) % 4];
      const float product = std::abs(a.x * b.y - b.x * a.y);
      if (!(product > distance * (std::abs(a.x - b.x) + std::abs(a.y - b.y)))) return false;
    }
    return true;
  }

 private:
  Crossing measure(std::size_t face) const {
    return measure_triangle(at_[(face + 1) % 4], at_[(face + 2) % 4], at_[(face + 3) % 4]);
  }

  const TetCell& cell_;
  const ShearedFrame& frame_;
  std::array<ShearedPoint, 4> at_;
  std::size_t in_ = 0, out_ = 0;
  Ways ways_ = Ways::none;
};

/// Whether the ray, walked back from the face of that rank by which it comes into a cell, has
/// nowhere a place that is not before `z_in`, the place there, until it has gone back by more than
/// `distance` in z or has reached the boundary.
inline bool comes_from_before(const WalkableTets& mesh, const ShearedFrame& frame,
                              std::uint32_t cell, std::size_t in, double z_in, double distance) {
  constexpr int kMost = 256;
  const WalkableTets::Link& behind = mesh.cells[cell][in];
  if (behind.cell == kNone) return true;
  WalkableTets::Boundary face{behind.cell, behind.apex, {}};
  const auto ids = mesh.points_of(cell);
  for (std::size_t i = 0; i < 3; ++i) face.loop[i] = ids[(in + 1 + i) % 4];
  TetWalker back(mesh, frame);
  back.enter(face, 0);
  for (int step = 0; step < kMost; ++step) {
    const auto place = back.leave();
    const double forward = (place->z - z_in) * frame.sign();
    if (forward > 0) return false;
    if (forward < -distance || !back.advance()) return true;
  }
  return false;
}

}  // namespace plume
