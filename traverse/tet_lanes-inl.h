// Tetrahedra against a vector of rays. Compiled once for each instruction set: to be included after
// hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_TET_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_TET_LANES_INL_H_
#undef PLUME_TRAVERSE_TET_LANES_INL_H_
#else
#define PLUME_TRAVERSE_TET_LANES_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "hwy/highway.h"
#include "plume/mesh/leaf_cells.h"
#include "plume/traverse/cell_search.h"
#include "plume/traverse/sheared_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The rays that a target has to see of a cell: of `lanes`, those that go through it, and on whose
// way a scalar that matters may be; all that go through where `all`.
HWY_INLINE ShearedLanes::M GoThrough(const ShearedLanes& lanes, const LeafCells& cells,
                                     std::size_t cell, bool all,
                                     std::span<const ScalarWindow> windows) {
  using Corner = ShearedLanes::Corner;
  using Edge = ShearedLanes::Edge;
  using V = ShearedLanes::V;
  using M = ShearedLanes::M;
  const ShearedLanes::D d;
  const Corner p0 = lanes.At(cells.position, 0, cell), p1 = lanes.At(cells.position, 1, cell);
  const Corner p2 = lanes.At(cells.position, 2, cell), p3 = lanes.At(cells.position, 3, cell);
  const Edge e01(p0, p1), e02(p0, p2), e03(p0, p3), e12(p1, p2), e13(p1, p3), e23(p2, p3);
  const M winds[4] = {hn::Xor(hn::Xor(e12.right, e23.right), e13.right),
                      hn::Xor(hn::Xor(e03.right, e23.right), e02.right),
                      hn::Xor(hn::Xor(e01.right, e13.right), e03.right),
                      hn::Xor(hn::Xor(e02.right, e12.right), e01.right)};
  const M none = hn::MaskFromVec(hn::Zero(d));
  M through = none;
  if (all) {
    for (const M& face : winds) through = hn::Or(through, face);
    return through;
  }
  // Products of the sheared numbers, of which areas and so scalars are made, are off by at most
  // 2^-22 of the product of the largest x and y; with three values weighted, 2^-19 is enough.
  auto largest = [&](V Corner::*of) HWY_ATTR {
    return hn::Max(hn::Max(hn::Abs(p0.*of), hn::Abs(p1.*of)),
                   hn::Max(hn::Abs(p2.*of), hn::Abs(p3.*of)));
  };
  const V rounding =
      hn::Mul(hn::Mul(largest(&Corner::x), largest(&Corner::y)), hn::Set(d, 0x1p-19f));
  struct Sides {
    M all_above, all_below;  // scalars on the faces that the ray crosses, for certain
  };
  auto sides_of = [&](float value) HWY_ATTR {
    // A scalar is equal to the value where rounding to single precision makes it so.
    float above[4];
    for (std::size_t i = 0; i < 4; ++i) above[i] = cells.scalar[i][cell] - value;
    const float most = std::max(0.5f * std::abs(value),
                                std::max(std::max(std::abs(above[0]), std::abs(above[1])),
                                         std::max(std::abs(above[2]), std::abs(above[3]))));
    const V margin = hn::Mul(rounding, hn::Set(d, most)), minus = hn::Neg(margin);
    Sides sides{hn::Not(none), hn::Not(none)};
    // Twice a face's area times how far the scalar on it is above the value.
    auto add = [&](std::size_t face, const Edge& ab, std::size_t c, const Edge& bc, std::size_t a,
                   const Edge& ca, std::size_t b) HWY_ATTR {
      const V sum = hn::MulAdd(
          ab.area, hn::Set(d, above[c]),
          hn::MulAdd(bc.area, hn::Set(d, above[a]), hn::Mul(ca.area, hn::Set(d, above[b]))));
      sides.all_above = hn::And(sides.all_above, hn::Or(hn::Not(winds[face]), hn::Gt(sum, margin)));
      sides.all_below = hn::And(sides.all_below, hn::Or(hn::Not(winds[face]), hn::Lt(sum, minus)));
    };
    add(0, e12, 3, e23, 1, e13, 2);
    add(1, e02, 3, e23, 0, e03, 2);
    add(2, e01, 3, e13, 0, e03, 1);
    add(3, e01, 2, e12, 0, e02, 1);
    return sides;
  };
  for (const ScalarWindow& window : windows) {
    const Sides from = sides_of(window.from);
    // Where the value is infinite, nothing is above it for certain, nor below.
    const M above = window.below == window.from ? from.all_above : sides_of(window.below).all_above;
    through = hn::Or(through, hn::Not(hn::Or(above, from.all_below)));
  }
  return through;
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
