/// Boxes and ranges of the scalar over clusters of cells: what need not be looked at.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "plume/mesh/walkable_tets.h"

namespace plume {

/// Cells of a leaf.
inline constexpr std::size_t kLeafCells = 16;

/// A tree over cells in their order, which is that of a Hilbert curve: a leaf is the box and the
/// range of kLeafCells consecutive cells, a node those of kWidth children. Nothing points anywhere:
/// child c of node n is node (or leaf) kWidth * n + c of the level below. About 3.8 bytes a cell.
///
/// It is made of the mesh alone. An isovalue or a transfer function asks it which ranges of the
/// scalar matter, and changes nothing in it.
struct CellHierarchy {
  static constexpr std::size_t kWidth = 8;

  /// The children, side by side, in the mesh's local frame. Boxes hold all points of their cells.
  /// Ranges hold all scalars that are measured on their cells' faces: those of their points that
  /// are not NaN, and what rounding may add (widen_range()). A child that is missing, or has no
  /// value, has the range [infinity, -infinity].
  struct alignas(64) Node {
    float low[3][kWidth], high[3][kWidth];
    float least[kWidth], greatest[kWidth];
  };
  /// Level by level, the parents of leaves first, the root last.
  std::vector<Node> nodes;
  /// One byte a node, one bit a child: whether there is a special cell in it, which whoever skips
  /// cells must not skip.
  std::vector<std::uint8_t> special;
  /// What there is to know of a leaf's cells.
  struct Leaf {
    /// One bit a cell. A cell is special where it has a face at the boundary, or is thin: has no
    /// positive volume, in the orientation that its part of the mesh has, or is narrower than
    /// kLeastWidth (between two planes, through a face and a point or through two edges). Along a
    /// ray through cells that are not thin, each is left behind where it was entered.
    std::uint16_t special = 0, thin = 0;
    /// The first face of the boundary, in the mesh's list, whose cell is in the leaf or after it.
    std::uint32_t first_boundary = 0;
    /// One byte a cell: where its range begins, in the lower four bits, and ends, in sixteenths of
    /// the leaf's; 15 and 0 where it has no value.
    std::array<std::uint8_t, kLeafCells> ranges{};
  };
  std::vector<Leaf> leaves;
  /// Where each level begins in `nodes`, and after the last one their number.
  std::vector<std::uint32_t> levels;
  std::uint32_t cell_count = 0;

  std::size_t bytes() const {
    return nodes.size() * sizeof(Node) + special.size() + leaves.size() * sizeof(Leaf) +
           levels.size() * sizeof(std::uint32_t);
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
  /// Whether the leaf of a cell has a special one in it.
  bool near_special(std::uint32_t cell) const { return leaves[cell / kLeafCells].special != 0; }
};

/// Widens the range of the values at a cell's points to that of the scalars measured on its faces.
/// Such a one is a sum of at most four values whose weights are not negative and sum to 1 within a
/// few units in the last place of a double, rounded to a float: rounding is monotone.
inline void widen_range(float& least, float& greatest) {
  const double margin = 0x1p-45 * std::max(std::abs(double{least}), std::abs(double{greatest}));
  least = static_cast<float>(least - margin);
  greatest = static_cast<float>(greatest + margin);
}

/// Least width of a cell that is not special, in the mesh's local frame, which is 2 wide. Shearing
/// space for a ray (traverse/sheared_frame.h) moves points by less than 2^-20 from where they are,
/// so that a wider cell cannot be turned inside out by it.
inline constexpr float kLeastWidth = 0x1p-18f;

/// In parallel. Takes nothing that it does not keep.
CellHierarchy make_cell_hierarchy(const WalkableTets& mesh);

}  // namespace plume
