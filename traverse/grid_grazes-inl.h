// Which faces of a hexahedron may be crossed twice, seen from the face by which the ray comes in.
// Compiled once for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_GRID_GRAZES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_GRID_GRAZES_INL_H_
#undef PLUME_TRAVERSE_GRID_GRAZES_INL_H_
#else
#define PLUME_TRAVERSE_GRID_GRAZES_INL_H_
#endif
// clang-format on

#include <cstddef>

#include "hwy/highway.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/patch_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Products of the back's corners m with other points, as far as several faces need them.
struct BackProducts {
  VF with_front[4];  // of corner m and that of the front: q.x * p.y - p.x * q.y
  VF with_next[4];   // of corner m and m + 1
};

// Lanes in which a face other than the front of even winding may be crossed twice all the same.
// `odd_front` and `odd_sides` are of odd winding; `..._crosses` tells where any edge crosses
// y = 0.
template <bool kMeasure>
HWY_INLINE VF GrazedBehind(const QuadLanes<kMeasure>& p, const QuadLanes<kMeasure>& q, VF odd_front,
                           const VF (&odd_sides)[4], const BackProducts& products, VF back_crosses,
                           const VF (&side_crosses)[4]) {
  const DF d;
  VF x = hn::Zero(d), y = hn::Zero(d);
  for (std::size_t m = 0; m < 4; ++m) {
    x = hn::Max(x, hn::Max(hn::Abs(p.x[m]), hn::Abs(q.x[m])));
    y = hn::Max(y, hn::Max(hn::Abs(p.y[m]), hn::Abs(q.y[m])));
  }
  const GrazeTest test(x, y);
  const auto product = GrazeTest::Product;
  const VF* const k = products.with_next;
  const VF back_odd =
      Xor3(odd_front, hn::Xor(odd_sides[0], odd_sides[1]), hn::Xor(odd_sides[2], odd_sides[3]));
  const VF back_passed = test.PassedBy(k[0], hn::Neg(k[2]), hn::Neg(k[3]), k[1],
                                       product(q.x[0], q.y[0], q.x[2], q.y[2]),
                                       product(q.x[1], q.y[1], q.x[3], q.y[3]));
  VF grazed = hn::AndNot(hn::Or(back_odd, back_passed), back_crosses);
  for (std::size_t m = 0; m < 4; ++m) {
    const std::size_t n = (m + 1) % 4;
    const VF passed = test.PassedBy(
        product(p.x[m], p.y[m], p.x[n], p.y[n]), k[m], hn::Neg(products.with_front[m]),
        hn::Neg(products.with_front[n]), product(p.x[m], p.y[m], q.x[n], q.y[n]),
        product(p.x[n], p.y[n], q.x[m], q.y[m]));
    grazed = hn::Or(grazed, hn::AndNot(hn::Or(odd_sides[m], passed), side_crosses[m]));
  }
  return grazed;
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
