/// Boxes and ranges of the scalar over clusters of cells: what need not be looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "plume/mesh/walkable_tets.h"

namespace plume {

/// A tree over cells in their order, which is that of a Hilbert curve: a leaf is the box and the
/// range of kLeafCells consecutive cells, a node those of kWidth children. Nothing points anywhere:
/// child c of node n is node (or leaf) kWidth * n + c of the level below. About 2.3 bytes a cell.
///
/// It is made of the mesh alone. An isovalue or a transfer function asks it which ranges of the
/// scalar matter, and changes nothing in it.
struct CellHierarchy {
  static constexpr std::size_t kLeafCells = 16;
  static constexpr std::size_t kWidth = 8;

  /// The children, side by side, in the mesh's local frame. Boxes hold all points of their cells.
  /// Ranges hold all scalars that are measured on their cells' faces: those of their points that
  /// are not NaN, and what rounding may add (see kRounding). A child that is missing, or has no
  /// value, has the range [infinity, -infinity].
  struct alignas(64) Node {
    float low[3][kWidth], high[3][kWidth];
    float least[kWidth], greatest[kWidth];
  };
  /// Level by level, the parents of leaves first, the root last.
  std::vector<Node> nodes;
  /// One byte a node, one bit a child: whether there is a special cell in it, which whoever skips
  /// cells must not skip (see is_special()).
  std::vector<std::uint8_t> special;
  /// Where each level begins in `nodes`, and after the last one their number.
  std::vector<std::uint32_t> levels;
  std::uint32_t cell_count = 0;

  std::size_t bytes() const {
    return nodes.size() * sizeof(Node) + special.size() + levels.size() * sizeof(std::uint32_t);
  }
  /// Whether the leaf of a cell has a special one in it.
  bool near_special(std::uint32_t cell) const {
    const std::size_t leaf = cell / kLeafCells;
    return (special[leaf / kWidth] >> leaf % kWidth & 1) != 0;
  }

  /// A scalar on a face is a sum of at most three values whose weights are not negative and sum to
  /// 1 within a few units in the last place of a double: it leaves their range by less than this
  /// share of the largest of them.
  static constexpr double kRounding = 0x1p-45;
};

/// Least width of a cell that is not special, in the mesh's local frame, which is 2 wide. Shearing
/// space for a ray (traverse/sheared_frame.h) moves points by less than 2^-20 from where they are,
/// so that a wider cell cannot be turned inside out by it.
inline constexpr float kLeastWidth = 0x1p-18f;

/// Whether a cell is special: it has a face at the boundary; or no positive volume, in the
/// orientation that its part of the mesh has; or it is thinner than kLeastWidth (between two planes
/// through a face and a point, or through two edges). Along a ray through cells that are not
/// special, each is left behind where it was entered.
bool is_special(const WalkableTets& mesh, std::uint32_t cell);

/// In parallel. Takes nothing that it does not keep.
CellHierarchy make_cell_hierarchy(const WalkableTets& mesh);

}  // namespace plume
