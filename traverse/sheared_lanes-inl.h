// Corners and edges in the sheared frames of a vector of rays. Compiled once for each instruction
// set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_SHEARED_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_SHEARED_LANES_INL_H_
#undef PLUME_TRAVERSE_SHEARED_LANES_INL_H_
#else
#define PLUME_TRAVERSE_SHEARED_LANES_INL_H_
#endif
// clang-format on

#include <cstddef>

#include "hwy/highway.h"
#include "plume/traverse/hull_test-inl.h"
#include "plume/traverse/ray_bundle.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Bits are those of crossing(), from the numbers of ShearedFrame.
class ShearedLanes {
 public:
  using D = HWY_CAPPED(float, 16);
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  // Of the rays `from` and following.
  ShearedLanes(const RayBundle& bundle, std::size_t from)
      : x_(static_cast<std::size_t>((bundle.axis() + 1) % 3)),
        y_(static_cast<std::size_t>((bundle.axis() + 2) % 3)),
        z_(static_cast<std::size_t>(bundle.axis())) {
    const D d;
    slope_x_ = hn::Load(d, bundle.slopes_x() + from);
    slope_y_ = hn::Load(d, bundle.slopes_y() + from);
    offset_x_ = hn::Load(d, bundle.offsets_x() + from);
    offset_y_ = hn::Load(d, bundle.offsets_y() + from);
  }

  static std::size_t Lanes() { return hn::Lanes(D()); }

  struct Corner {
    V x, y;
    M up;
  };
  // position[axis][corner][place].
  template <std::size_t kCorners, std::size_t kPlaces>
  HWY_INLINE Corner At(const float (&position)[3][kCorners][kPlaces], std::size_t corner,
                       std::size_t place) const {
    const D d;
    const V z = hn::Set(d, position[z_][corner][place]);
    const V x =
        hn::Sub(hn::Sub(hn::Set(d, position[x_][corner][place]), offset_x_), hn::Mul(slope_x_, z));
    const V y =
        hn::Sub(hn::Sub(hn::Set(d, position[y_][corner][place]), offset_y_), hn::Mul(slope_y_, z));
    return {x, y, hn::Ge(y, hn::Zero(d))};
  }

  struct Edge {
    M right;
    V area;  // of the triangle with the ray, twice
    HWY_INLINE Edge(const Corner& a, const Corner& b) {
      const V forth = hn::Mul(a.x, b.y), back = hn::Mul(b.x, a.y);
      right = hn::Or(hn::And(hn::AndNot(a.up, b.up), hn::Gt(forth, back)),
                     hn::And(hn::AndNot(b.up, a.up), hn::Gt(back, forth)));
      area = hn::Abs(hn::Sub(forth, back));
    }
  };

  // Rays that go through a box that lies beside others, widened by HullTest::kMargin.
  template <std::size_t kBoxes>
  HWY_INLINE M Meets(const float (&lows)[3][kBoxes], const float (&highs)[3][kBoxes],
                     std::size_t box) const {
    const D d;
    const V z_low = hn::Set(d, lows[z_][box]), z_high = hn::Set(d, highs[z_][box]);
    auto along = [&](std::size_t axis, V offset, V slope) HWY_ATTR {
      const V a = hn::MulAdd(slope, z_low, offset), b = hn::MulAdd(slope, z_high, offset);
      return hn::And(hn::Le(hn::Min(a, b), hn::Set(d, highs[axis][box] + HullTest::kMargin)),
                     hn::Ge(hn::Max(a, b), hn::Set(d, lows[axis][box] - HullTest::kMargin)));
    };
    return hn::And(along(x_, offset_x_, slope_x_), along(y_, offset_y_, slope_y_));
  }

 private:
  const std::size_t x_, y_, z_;
  V slope_x_, slope_y_, offset_x_, offset_y_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
