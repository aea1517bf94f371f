/// Ranges of the scalar over blocks of a rectilinear grid's cells: what need not be walked through.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/mesh/walkable_rectilinear.h"

namespace plume {

/// The implicit kd-tree of Marmitt 2008, section 4.3, in its small form: nodes are a range and
/// nothing else, as planes and children follow from where a node is, and virtual nodes outside of
/// the grid are not stored (section 4.3.2). Split in the middle of the longest side, the boxes are
/// cubes again after every third split: those levels are kept, and of them the ones from kEdge
/// cells along an edge, so that it takes 0.14 bytes a cell rather than twice the scalars.
///
/// It is made of the scalars alone. An isovalue or a transfer function asks it which ranges matter,
/// and changes nothing in it.
class RangeTree {
 public:
  /// Of the values at a block's points, or in its cells, that are not NaN, widened by what rounding
  /// may add to values between them (see widened()); [infinity, -infinity] where there is none.
  struct Range {
    float least, greatest;
  };
  /// Cells along an edge of the blocks of level 0; of those of level l, kEdge << l.
  static constexpr std::uint32_t kEdge = 4;

  RangeTree() = default;
  /// In parallel; reads each value about twice.
  explicit RangeTree(const WalkableRectilinear& mesh);

  /// Level 0 first; the last one is a single block.
  std::size_t level_count() const { return levels_.size(); }
  /// The range of the block of a level in which a cell is, by the cell's indices.
  const Range& around(const std::array<std::uint32_t, 3>& cell, std::size_t level) const {
    const Level& of = levels_[level];
    const std::size_t shift = kShift + level;
    return of.ranges[(cell[0] >> shift) +
                     of.blocks[0] * ((cell[1] >> shift) + of.blocks[1] * (cell[2] >> shift))];
  }
  /// The share of the grid's cells that are in blocks of level 0 whose range `matters`
  /// (matters(least, greatest), true for whatever holds a range that matters).
  template <class Matters>
  double share_of(const Matters& matters) const {
    if (levels_.empty()) return 0;
    return static_cast<double>(cells_that(matters, levels_.size() - 1, {0, 0, 0})) /
           static_cast<double>(cell_count_);
  }
  std::size_t bytes() const;

  /// Along a cell's faces, and in it, values are sums of those at its points whose weights are not
  /// negative and add up to 1. The cubic along a ray is that through four such values, each rounded
  /// to single precision, which it makes at most 1.64 times as wrong (their Lebesgue constant).
  static Range widened(Range range);

 private:
  static constexpr std::size_t kShift = 2;
  static_assert(kEdge == 1u << kShift);

  struct Level {
    std::array<std::size_t, 3> blocks;
    std::vector<Range> ranges;
  };

  template <class Matters>
  std::size_t cells_that(const Matters& matters, std::size_t level,
                         const std::array<std::uint32_t, 3>& block) const {
    const Level& of = levels_[level];
    const Range& range = of.ranges[block[0] + of.blocks[0] * (block[1] + of.blocks[1] * block[2])];
    if (!matters(range.least, range.greatest)) return 0;
    if (level == 0) {
      std::size_t cells = 1;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t first = block[a] * kEdge;
        cells *= cells_[a] - first < kEdge ? cells_[a] - first : kEdge;
      }
      return cells;
    }
    const Level& below = levels_[level - 1];
    std::size_t cells = 0;
    for (std::uint32_t child = 0; child < 8; ++child) {
      const std::array<std::uint32_t, 3> at{
          2 * block[0] + (child & 1), 2 * block[1] + (child >> 1 & 1), 2 * block[2] + (child >> 2)};
      if (at[0] < below.blocks[0] && at[1] < below.blocks[1] && at[2] < below.blocks[2])
        cells += cells_that(matters, level - 1, at);
    }
    return cells;
  }

  std::vector<Level> levels_;
  std::array<std::uint32_t, 3> cells_{};
  std::size_t cell_count_ = 0;
};

}  // namespace plume
