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

// A cell as seen from the face by which the ray comes in (see GridSteps): its front and its back.
template <bool kMeasure>
struct FrontAndBack {
  const QuadLanes<kMeasure>& p;
  const QuadLanes<kMeasure>& q;
  // Products of corners m and m + 1 of the back, and of corner m of the front and of the back.
  VF along[4], across[4];
  // Which faces cannot be grazed, as bits: those of odd winding, or whose edges all stay on one
  // side of y = 0.
  VF back_settled, side_settled[4];

  // Lanes in which a face other than the front may be crossed twice although its winding is even:
  // not settled, and not `passed` (GrazeTest).
  template <class Passed>
  HWY_INLINE VF Grazed(const Passed& passed) const {
    const auto product = GrazeTest::Product;
    VF settled = hn::Or(back_settled, passed(along[0], hn::Neg(along[2]), hn::Neg(along[3]),
                                             along[1], product(q.x[0], q.y[0], q.x[2], q.y[2]),
                                             product(q.x[1], q.y[1], q.x[3], q.y[3])));
    HWY_UNROLL(4)
    for (std::size_t m = 0; m < 4; ++m) {
      const std::size_t n = (m + 1) % 4;
      const VF side =
          passed(product(p.x[m], p.y[m], p.x[n], p.y[n]), along[m], across[m], across[n],
                 product(p.x[m], p.y[m], q.x[n], q.y[n]), product(p.x[n], p.y[n], q.x[m], q.y[m]));
      settled = hn::And(settled, hn::Or(side_settled[m], side));
    }
    return hn::Not(settled);
  }

  // Whether any may be, by signs alone; then, more precisely.
  HWY_INLINE VF MayBeGrazed() const { return Grazed(GrazeTest::PassedBySigns); }
  HWY_INLINE VF IsGrazed() const {
    VF x = hn::Zero(DF()), y = hn::Zero(DF());
    for (std::size_t m = 0; m < 4; ++m) {
      x = hn::Max(x, hn::Max(hn::Abs(p.x[m]), hn::Abs(q.x[m])));
      y = hn::Max(y, hn::Max(hn::Abs(p.y[m]), hn::Abs(q.y[m])));
    }
    const GrazeTest test(x, y);
    return Grazed([&](VF v0, VF v2, VF u0, VF u2, VF ac, VF bd)
                      HWY_ATTR { return test.PassedBy(v0, v2, u0, u2, ac, bd); });
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
