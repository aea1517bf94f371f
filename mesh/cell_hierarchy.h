/// Boxes and ranges of the scalar over clusters of cells: what need not be looked at.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/mesh/cluster_tree.h"
#include "plume/mesh/walkable_tets.h"

namespace plume {

/// Cells of a leaf.
inline constexpr std::size_t kLeafCells = 16;

/// A tree over cells in their order, which is that of a Hilbert curve: a leaf is the box and the
/// range of kLeafCells consecutive cells. Boxes hold all points of their cells. Ranges hold all
/// scalars that are measured on their cells' faces: those of their points that are not NaN, and
/// what rounding may add (widen_range()). And a tree over the faces at the boundary. About 3.4
/// bytes a cell.
///
/// It is made of the mesh alone. An isovalue or a transfer function asks it which ranges of the
/// scalar matter, and changes nothing in it.
struct CellHierarchy {
  /// Thin cells are special.
  ClusterTree cells;
  ClusterTree boundary;
  /// What there is to know of a leaf's cells.
  struct Leaf {
    /// One bit a cell. A cell is thin where it has no positive volume, in the orientation that its
    /// part of the mesh has, or is narrower than kLeastWidth (between two planes, through a face
    /// and a point or through two edges). Along a ray through cells that are not thin, each is left
    /// behind where it was entered.
    std::uint16_t thin = 0;
    /// One byte a cell: where its range begins, in the lower four bits, and ends, in sixteenths of
    /// the leaf's; 15 and 0 where it has no value.
    std::array<std::uint8_t, kLeafCells> ranges{};
  };
  std::vector<Leaf> leaves;
  std::uint32_t cell_count = 0;

  std::size_t bytes() const {
    return cells.bytes() + boundary.bytes() + leaves.size() * sizeof(Leaf);
  }
  /// Sixteenths of a range.
  class Sixteenths {
   public:
    Sixteenths(float least, float greatest) : least_(least), per_(16 / (greatest - least)) {}
    /// Where a scalar is, or what it is nearest to, from 0 to 15: monotone whatever the rounding.
    int of(float scalar) const {
      // No number becomes 0.
      const float share = (scalar - least_) * per_;
      return static_cast<int>(std::min(15.0f, std::max(0.0f, share)));
    }

   private:
    float least_, per_;
  };
  /// Whether the leaf of a cell has a thin one in it.
  bool near_thin(std::uint32_t cell) const { return leaves[cell / kLeafCells].thin != 0; }
};

/// Widens the range of the values at a cell's points to that of the scalars measured on its faces.
/// Such a one is a sum of at most four values whose weights are not negative and sum to 1 within a
/// few units in the last place of a double, rounded to a float: rounding is monotone.
inline void widen_range(float& least, float& greatest) {
  const double margin = 0x1p-45 * std::max(std::abs(double{least}), std::abs(double{greatest}));
  least = static_cast<float>(least - margin);
  greatest = static_cast<float>(greatest + margin);
}

/// Least width of a cell that is not thin, in the mesh's local frame, which is 2 wide. Shearing
/// space for a ray (traverse/sheared_frame.h) moves points by less than 2^-20 from where they are,
/// so that a wider cell cannot be turned inside out by it.
inline constexpr float kLeastWidth = 0x1p-18f;

/// In parallel. Takes nothing that it does not keep.
CellHierarchy make_cell_hierarchy(const WalkableTets& mesh);

}  // namespace plume
