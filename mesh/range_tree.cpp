#include "plume/mesh/range_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace plume {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// fmin() and fmax() pass over NaN, but are calls where the compiler must keep to that.
void take(RangeTree::Range& range, float value) {
  range.least = value < range.least ? value : range.least;
  range.greatest = value > range.greatest ? value : range.greatest;
}

}  // namespace

RangeTree::Range RangeTree::widened(Range range) {
  const float size = std::max(std::abs(range.least), std::abs(range.greatest));
  // Between zeros all is zero, exactly: where nothing is, nothing must seem to be.
  if (!(range.least <= range.greatest) || size == 0) return range;
  const float margin = std::max(0x1p-19f * size, 2 * std::numeric_limits<float>::denorm_min());
  return {range.least - margin, range.greatest + margin};
}

RangeTree::RangeTree(const WalkableRectilinear& mesh) : cell_count_(mesh.cell_count()) {
  for (std::size_t a = 0; a < 3; ++a) cells_[a] = mesh.points(a) - 1;
  const bool on_points = mesh.cell_values.empty();
  const float* const values = on_points ? mesh.point_values.data() : mesh.cell_values.data();
  const std::size_t more = on_points ? 1 : 0;  // values along an axis than cells
  const std::size_t row = cells_[0] + more, plane = row * (cells_[1] + more);
  auto blocks_along = [](std::size_t cells) { return (cells + kEdge - 1) / kEdge; };
  Level leaves{{blocks_along(cells_[0]), blocks_along(cells_[1]), blocks_along(cells_[2])}, {}};
  leaves.ranges.resize(leaves.blocks[0] * leaves.blocks[1] * leaves.blocks[2]);
  auto last = [&](std::size_t block, std::size_t a) {
    return std::min<std::size_t>(kEdge * (block + 1), cells_[a]) + more;
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves.blocks[1] * leaves.blocks[2]),
                    [&](const auto& rows) {
                      for (std::size_t at = rows.begin(); at != rows.end(); ++at) {
                        const std::size_t bj = at % leaves.blocks[1], bk = at / leaves.blocks[1];
                        for (std::size_t bi = 0; bi < leaves.blocks[0]; ++bi) {
                          Range range{kInfinity, -kInfinity};
                          for (std::size_t k = kEdge * bk; k < last(bk, 2); ++k)
                            for (std::size_t j = kEdge * bj; j < last(bj, 1); ++j)
                              for (std::size_t i = kEdge * bi; i < last(bi, 0); ++i)
                                take(range, values[i + row * j + plane * k]);
                          leaves.ranges[bi + leaves.blocks[0] * at] = widened(range);
                        }
                      }
                    });
  levels_.push_back(std::move(leaves));
  while (levels_.back().ranges.size() > 1) {
    const Level& below = levels_.back();
    Level level;
    for (std::size_t a = 0; a < 3; ++a) level.blocks[a] = (below.blocks[a] + 1) / 2;
    level.ranges.assign(level.blocks[0] * level.blocks[1] * level.blocks[2],
                        {kInfinity, -kInfinity});
    std::size_t child = 0;
    for (std::size_t k = 0; k < below.blocks[2]; ++k)
      for (std::size_t j = 0; j < below.blocks[1]; ++j)
        for (std::size_t i = 0; i < below.blocks[0]; ++i, ++child) {
          Range& range =
              level.ranges[i / 2 + level.blocks[0] * (j / 2 + level.blocks[1] * (k / 2))];
          range.least = std::min(range.least, below.ranges[child].least);
          range.greatest = std::max(range.greatest, below.ranges[child].greatest);
        }
    levels_.push_back(std::move(level));
  }
}

std::size_t RangeTree::bytes() const {
  std::size_t bytes = 0;
  for (const Level& level : levels_) bytes += level.ranges.size() * sizeof(Range);
  return bytes;
}

}  // namespace plume
