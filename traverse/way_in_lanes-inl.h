// Where rays come in through a triangle or a quadrilateral, a ray a lane: measure_triangle(),
// measure_planar() and measure_patch(), operation by operation. Compiled once for each instruction
// set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_WAY_IN_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_WAY_IN_LANES_INL_H_
#undef PLUME_TRAVERSE_WAY_IN_LANES_INL_H_
#else
#define PLUME_TRAVERSE_WAY_IN_LANES_INL_H_
#endif
// clang-format on

#include <cstddef>

#include "hwy/highway.h"
#include "plume/traverse/double_lanes-inl.h"
#include "plume/traverse/ways_in.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// A face's corners: in the frames of the rays, and what is the same in all of them.
struct WayInCorners {
  static constexpr std::size_t kMost = 4;

  HWY_ALIGN float x[kMost][RayLanes::kRays];
  HWY_ALIGN float y[kMost][RayLanes::kRays];
  HWY_ALIGN float winding[RayLanes::kRays];
  double z[kMost], scalar[kMost];
};

// Some of the rays.
class WayInLanes {
 public:
  WayInLanes(const WayInCorners& corners, std::size_t first, std::size_t count)
      : corners_(corners), winding_(Wide(corners.winding + first)) {
    for (std::size_t c = 0; c < count; ++c) {
      x_[c] = Wide(corners.x[c] + first);
      y_[c] = Wide(corners.y[c] + first);
    }
  }

  struct Place {
    VD z, scalar;
    MD is_known;
  };

  // measure_triangle().
  HWY_INLINE Place Triangle() const {
    const DD d;
    const VD zero = hn::Zero(d);
    const MD a_up = hn::Ge(y_[0], zero);
    const MD ab = hn::Xor(a_up, hn::Ge(y_[1], zero)), ac = hn::Xor(a_up, hn::Ge(y_[2], zero));
    const MD lone_a = hn::And(ab, ac), p_a = hn::AndNot(ac, ab), q_a = hn::AndNot(ab, ac);
    auto lone = [&](VD a, VD b, VD c)
                    HWY_ATTR { return hn::IfThenElse(lone_a, a, hn::IfThenElse(ab, b, c)); };
    auto p = [&](VD a, VD b) HWY_ATTR { return hn::IfThenElse(p_a, a, b); };
    auto q = [&](VD a, VD c) HWY_ATTR { return hn::IfThenElse(q_a, a, c); };
    const VD lone_x = lone(x_[0], x_[1], x_[2]), lone_y = lone(y_[0], y_[1], y_[2]);
    const VD p_x = p(x_[0], x_[1]), p_y = p(y_[0], y_[1]);
    const VD q_x = q(x_[0], x_[2]), q_y = q(y_[0], y_[2]);
    const VD p_height = hn::Sub(p_y, lone_y), q_height = hn::Sub(q_y, lone_y);
    const VD nothing = hn::Set(d, 1e-200);
    auto distance = [&](VD x, VD y) HWY_ATTR {
      return hn::Max(hn::Abs(hn::Sub(hn::Mul(lone_x, y), hn::Mul(x, lone_y))), nothing);
    };
    const VD p_distance = distance(p_x, p_y), q_distance = distance(q_x, q_y);
    const VD sum = hn::Add(hn::Mul(p_distance, q_height), hn::Mul(q_distance, p_height));
    const VD share = hn::Div(hn::Neg(lone_y), sum);
    const VD of_p = hn::Mul(q_distance, share), of_q = hn::Mul(p_distance, share);
    auto blend = [&](const double(&value)[WayInCorners::kMost]) HWY_ATTR {
      const VD a = hn::Set(d, value[0]), b = hn::Set(d, value[1]), c = hn::Set(d, value[2]);
      const VD at = lone(a, b, c);
      return hn::Add(
          at, hn::Add(hn::Mul(of_p, hn::Sub(p(a, b), at)), hn::Mul(of_q, hn::Sub(q(a, c), at))));
    };
    return {blend(corners_.z), blend(corners_.scalar), hn::Eq(zero, zero)};
  }

  // measure_planar() or measure_patch(). Not known where those would measure between edges.
  HWY_INLINE Place Quadrilateral(bool planar) const {
    const DD d;
    const VD zero = hn::Zero(d), two = hn::Set(d, 2);
    const VD v0 = Product(0, 1), v2 = Product(3, 2);
    const VD v1 = hn::Sub(Product(0, 2), Product(1, 3));
    const VD slope = hn::Sub(hn::Mul(two, v0), v1), bend = hn::Sub(hn::Sub(v1, v0), v2);
    Place place{zero, zero, hn::Not(hn::Eq(zero, zero))};
    if (planar) {
      const MD linear =
          hn::Le(hn::Abs(hn::Mul(v0, bend)), hn::Mul(hn::Set(d, 0x1p-24), hn::Mul(slope, slope)));
      place = At(hn::Div(v0, slope));
      place.is_known = hn::And(place.is_known, linear);
      if (hn::AllTrue(d, place.is_known)) return place;
    }
    const VD square = hn::Sub(hn::Mul(v1, v1), hn::Mul(hn::Set(d, 4), hn::Mul(v0, v2)));
    const VD root = hn::Sqrt(hn::IfThenElseZero(hn::Gt(square, zero), square));
    const VD jacobian = hn::IfThenElse(hn::Gt(winding_, zero), root, hn::Neg(root));
    const MD one_way = hn::Or(hn::Gt(hn::Mul(slope, jacobian), zero), hn::Eq(bend, zero));
    const VD above = hn::IfThenElse(one_way, hn::Mul(two, v0), hn::Sub(jacobian, slope));
    const VD below = hn::IfThenElse(one_way, hn::Add(slope, jacobian), hn::Mul(two, bend));
    const Place other = At(hn::Div(above, below));
    return {hn::IfThenElse(place.is_known, place.z, other.z),
            hn::IfThenElse(place.is_known, place.scalar, other.scalar),
            hn::Or(place.is_known, other.is_known)};
  }

 private:
  static HWY_INLINE VD Wide(const float* from) {
    const hn::Rebind<float, DD> narrow;
    return hn::PromoteTo(DD(), hn::Load(narrow, from));
  }

  // edge_product().
  HWY_INLINE VD Product(std::size_t p, std::size_t q) const {
    return hn::Sub(hn::Mul(x_[p], y_[q]), hn::Mul(x_[q], y_[p]));
  }

  // across_patch() and blend_corners().
  HWY_INLINE Place At(VD v) const {
    const DD d;
    const VD zero = hn::Zero(d), one = hn::Set(d, 1);
    auto between = [&](VD from, VD to)
                       HWY_ATTR { return hn::Add(from, hn::Mul(v, hn::Sub(to, from))); };
    const VD left_x = between(x_[0], x_[3]), left_y = between(y_[0], y_[3]);
    const VD x = hn::Sub(between(x_[1], x_[2]), left_x);
    const VD y = hn::Sub(between(y_[1], y_[2]), left_y);
    const MD by_x = hn::Gt(hn::Abs(x), hn::Abs(y));
    const VD u = hn::Div(hn::Neg(hn::IfThenElse(by_x, left_x, left_y)), hn::IfThenElse(by_x, x, y));
    auto inside = [&](VD at) HWY_ATTR { return hn::And(hn::Ge(at, zero), hn::Le(at, one)); };
    const VD before_u = hn::Sub(one, u), before_v = hn::Sub(one, v);
    auto blend = [&](const double(&value)[WayInCorners::kMost]) HWY_ATTR {
      const VD a = hn::Set(d, value[0]), b = hn::Set(d, value[1]);
      const VD c = hn::Set(d, value[2]), e = hn::Set(d, value[3]);
      return hn::Add(hn::Mul(before_v, hn::Add(hn::Mul(before_u, a), hn::Mul(u, b))),
                     hn::Mul(v, hn::Add(hn::Mul(before_u, e), hn::Mul(u, c))));
    };
    return {blend(corners_.z), blend(corners_.scalar), hn::And(inside(u), inside(v))};
  }

  const WayInCorners& corners_;
  VD x_[WayInCorners::kMost], y_[WayInCorners::kMost];
  const VD winding_;
};

// Puts places into `found`; returned are the lanes of which they are known. Lanes that do not come
// in once get any.
HWY_INLINE unsigned MeasureWaysIn(const WayInCorners& corners, FaceSurface surface, WaysIn& found) {
  const DD d;
  const hn::Rebind<float, DD> narrow;
  unsigned known = 0;
  const bool triangle = surface == FaceSurface::triangle;
  for (std::size_t i = 0; i < RayLanes::kRays; i += hn::Lanes(d)) {
    const unsigned here = found.once >> i & ((1u << hn::Lanes(d)) - 1);
    if (here == 0) continue;
    const WayInLanes lanes(corners, i, triangle ? 3 : 4);
    const WayInLanes::Place place =
        triangle ? lanes.Triangle() : lanes.Quadrilateral(surface == FaceSurface::planar);
    hn::Store(place.z, d, found.z + i);
    hn::Store(hn::DemoteTo(narrow, place.scalar), narrow, found.scalar + i);
    known |= BitsOf(d, place.is_known) << i;
  }
  return known;
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
