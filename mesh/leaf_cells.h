/// The cells of a leaf of a CellHierarchy, read out of a mesh that stores links alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "plume/mesh/cell_hierarchy.h"

namespace plume {

/// The corners of the cells side by side, laid out for vectors: corner i is the cell's point of
/// rank i. A leaf that is not full has its last cell several times.
struct LeafCells {
  alignas(64) float position[3][4][kLeafCells];
  alignas(64) float scalar[4][kLeafCells];
  /// One bit a cell: see WalkableTets::odd_bits.
  unsigned odd = 0;

  /// The least and greatest of each cell's four values; infinity and -infinity where all are NaN.
  static void bound(const float (&values)[4][kLeafCells], float* least, float* greatest) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::fill_n(least, kLeafCells, kInfinity);
    std::fill_n(greatest, kLeafCells, -kInfinity);
    // A comparison with NaN is false.
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t i = 0; i < kLeafCells; ++i) {
        least[i] = values[c][i] < least[i] ? values[c][i] : least[i];
        greatest[i] = values[c][i] > greatest[i] ? values[c][i] : greatest[i];
      }
  }

  /// Reads the cells whose bit is set in `wanted`; the others keep what was there.
  void read(const WalkableTets& mesh, std::uint32_t leaf, unsigned wanted = 0xFFFF) {
    odd &= ~wanted;
    const auto last = static_cast<std::uint32_t>(mesh.cell_count() - 1);
    for (std::uint32_t place = 0; place < kLeafCells; ++place) {
      if ((wanted >> place & 1) == 0) continue;
      const std::uint32_t cell =
          std::min(last, leaf * static_cast<std::uint32_t>(kLeafCells) + place);
      odd |= (mesh.is_odd(cell) ? 1u : 0u) << place;
      const auto points = mesh.points_of(cell);
      for (std::size_t i = 0; i < 4; ++i) {
        const WalkablePoint& p = mesh.points[points[i]];
        for (std::size_t a = 0; a < 3; ++a) position[a][i][place] = p.position[a];
        scalar[i][place] = p.scalar;
      }
    }
  }
};

}  // namespace plume
