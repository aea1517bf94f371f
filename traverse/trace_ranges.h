/// A ray through a rectilinear grid that passes by what does not matter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "plume/mesh/range_tree.h"
#include "plume/traverse/trace_rectilinear.h"

namespace plume {

/// As trace(), but of the cells in blocks of the tree whose range of the scalar does not matter at
/// that moment: `matters(least, greatest)`, which must be true for whatever holds a range that
/// matters. Those are passed over; `pass_over()` is called before the first cell behind them. What
/// is visited is what trace() visits there, bit for bit; `cells` counts that alone.
///
/// Linear and cubic scalars only (a parabola may leave the range of its cell), and grids none of
/// whose cells is hidden. Marmitt 2008, section 4.3.1.2, goes down from the root by intervals of
/// the ray; this walks from block to block, with the walker's decisions, so that cells that the ray
/// no more than touches come as in a walk.
template <class Matters, class Visit, class PassOver>
TraceResult trace_ranges(const WalkableRectilinear& mesh, const RangeTree& tree, const Ray& ray,
                         const Matters& matters, Visit&& visit, PassOver&& pass_over,
                         ScalarOrder order) {
  TraceResult result;
  RectilinearWalker walker(mesh);
  if (!walker.start(ray)) return result;
  result.entries = 1;
  const bool on_points = mesh.cell_values.empty();
  order = order_in(mesh, order);
  for (bool passed_over = false;;) {
    const std::array<std::uint32_t, 3> at = walker.indices();
    auto is_empty = [&](std::size_t level) {
      const RangeTree::Range& range = tree.around(at, level);
      return !matters(range.least, range.greatest);
    };
    std::size_t level = 0;
    const bool empty = is_empty(0);
    while (empty && level + 1 < tree.level_count() && is_empty(level + 1)) ++level;
    std::array<std::uint32_t, 3> begin, end;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::uint32_t edge = RangeTree::kEdge << level;
      begin[a] = at[a] / edge * edge;
      end[a] = std::min(begin[a] + edge, mesh.points(a) - 1);
    }
    if (empty) {
      if (!walker.skip(begin, end)) return result;
      passed_over = true;
      continue;
    }
    if (passed_over) pass_over();
    passed_over = false;
    // The cells of one block.
    float s_in = on_points ? walker.entry_scalar() : 0;
    for (bool inside = true; inside;) {
      const float s_out = on_points ? walker.exit_scalar() : 0;
      ++result.cells;
      const Segment segment = segment_in(mesh, walker, ray, order, s_in, s_out);
      if (!visit(segment)) {
        result.end = WalkEnd::stopped;
        return result;
      }
      if (walker.t_out() >= walker.end()) return result;
      walker.advance();
      s_in = s_out;
      // Only along the axis that was crossed has the index changed.
      const std::size_t a = walker.entry_axis();
      inside = begin[a] <= walker.entry_index() && walker.entry_index() < end[a];
    }
  }
}

}  // namespace plume
