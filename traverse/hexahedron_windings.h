/// The windings of a hexahedron's faces about the ray, each of its twelve edges decided once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "plume/mesh/corner_cells.h"
#include "plume/traverse/sheared_frame.h"

namespace plume {

class HexahedronWindings {
 public:
  explicit HexahedronWindings(const std::array<ShearedPoint, 8>& corner) {
    for (std::size_t c = 0; c < 8; ++c) up_ |= static_cast<unsigned>(corner[c].up()) << c;
    auto edge = [&](std::size_t a, std::size_t b) {
      return crossing_unbranched(corner[a], corner[b]);
    };
    const int i00 = edge(0, 1), i10 = edge(2, 3), i01 = edge(4, 5), i11 = edge(6, 7);
    const int j00 = edge(0, 2), j10 = edge(1, 3), j01 = edge(4, 6), j11 = edge(5, 7);
    const int k00 = edge(0, 4), k10 = edge(1, 5), k01 = edge(2, 6), k11 = edge(3, 7);
    winding_ = {j00 + k01 - j01 - k00, j10 + k11 - j11 - k10, k00 + i01 - k10 - i00,
                k01 + i11 - k11 - i10, i00 + j10 - i10 - j00, i01 + j11 - i11 - j01};
  }

  /// Of the face's loop.
  int of(std::size_t face) const { return winding_[face]; }

  /// False where all corners of a face are on one side of y = 0, as of most faces: then the ray
  /// passes outside of their convex hull.
  bool may_be_crossed(std::size_t face) const {
    const unsigned own = up_ & kCorners[face];
    return own != 0 && own != kCorners[face];
  }

 private:
  // The corners of each face as bits.
  static constexpr unsigned kCorners[6] = {0x55, 0xAA, 0x33, 0xCC, 0x0F, 0xF0};

  unsigned up_ = 0;
  std::array<int, 6> winding_;
};

}  // namespace plume
