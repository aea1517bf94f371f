#include "plume/traverse/frame_lanes.h"

#include <cmath>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/frame_lanes.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DD = HWY_CAPPED(double, 8);
using VD = hn::Vec<DD>;
using MD = hn::Mask<DD>;
using DF = HWY_CAPPED(float, 16);
using VF = hn::Vec<DF>;
using MF = hn::Mask<DF>;

template <class D>
HWY_INLINE unsigned BitsOf(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
}

// ShearedFrame::set(), operation by operation.
FrameLanes::Bits SetFrames(const RayLanes& rays, const LocalFrame& local,
                           FrameLanes::Arrays& frames) {
  const DD d;
  const hn::Rebind<float, DD> narrow;
  const VD zero = hn::Zero(d), one = hn::Set(d, 1);
  const VD scale = hn::Set(d, local.scale);
  FrameLanes::Bits bits;
  for (std::size_t i = 0; i < RayLanes::kRays; i += hn::Lanes(d)) {
    const VD d0 = hn::Load(d, rays.direction[0] + i), o0 = hn::Load(d, rays.origin[0] + i);
    const VD d1 = hn::Load(d, rays.direction[1] + i), o1 = hn::Load(d, rays.origin[1] + i);
    const VD d2 = hn::Load(d, rays.direction[2] + i), o2 = hn::Load(d, rays.origin[2] + i);
    // The longest axis, the first of several.
    const MD over_0 = hn::Gt(hn::Abs(d1), hn::Abs(d0));
    const MD is_2 = hn::Gt(hn::Abs(d2), hn::Abs(hn::IfThenElse(over_0, d1, d0)));
    const MD is_1 = hn::AndNot(is_2, over_0);
    auto pick = [&](VD of_0, VD of_1, VD of_2) HWY_ATTR {
      return hn::IfThenElse(is_2, of_2, hn::IfThenElse(is_1, of_1, of_0));
    };
    const VD dx = pick(d1, d2, d0), dy = pick(d2, d0, d1), dz = pick(d0, d1, d2);
    const VD per_z = hn::Div(one, dz);

    auto times_zero = [&](VD v) HWY_ATTR { return hn::Mul(zero, v); };
    const VD nothing = hn::Add(
        hn::Add(hn::Add(times_zero(d0), times_zero(d1)), hn::Add(times_zero(d2), times_zero(o0))),
        hn::Add(times_zero(o1), times_zero(o2)));
    const VD infinity = hn::Set(d, std::numeric_limits<double>::infinity());
    const MD valid = hn::And(hn::And(hn::Gt(hn::Abs(dz), zero), hn::Eq(nothing, zero)),
                             hn::Lt(hn::Abs(per_z), infinity));

    const VD c0 = hn::Set(d, local.center[0]), c1 = hn::Set(d, local.center[1]);
    const VD c2 = hn::Set(d, local.center[2]);
    const VD length2 = hn::Add(hn::Add(hn::Mul(d0, d0), hn::Mul(d1, d1)), hn::Mul(d2, d2));
    VD along = hn::Add(zero, hn::Mul(hn::Sub(c0, o0), d0));
    along = hn::Add(along, hn::Mul(hn::Sub(c1, o1), d1));
    along = hn::Add(along, hn::Mul(hn::Sub(c2, o2), d2));
    along = hn::Div(along, length2);
    auto anchor = [&](VD o, VD c, VD direction) HWY_ATTR {
      return hn::Mul(hn::Add(hn::Sub(o, c), hn::Mul(along, direction)), scale);
    };
    const VD a0 = anchor(o0, c0, d0), a1 = anchor(o1, c1, d1), a2 = anchor(o2, c2, d2);
    const VD ax = pick(a1, a2, a0), ay = pick(a2, a0, a1), az = pick(a0, a1, a2);

    auto put_line = [&](VD direction, VD place, float* slopes, float* offsets) HWY_ATTR {
      const auto slope = hn::DemoteTo(narrow, hn::Mul(direction, per_z));
      hn::Store(slope, narrow, slopes + i);
      const VD offset = hn::Sub(place, hn::Mul(hn::PromoteTo(d, slope), az));
      hn::Store(hn::DemoteTo(narrow, offset), narrow, offsets + i);
    };
    put_line(dx, ax, frames.slope_x, frames.offset_x);
    put_line(dy, ay, frames.slope_y, frames.offset_y);
    const VD t_per_z = hn::Div(per_z, scale);
    hn::Store(t_per_z, d, frames.t_per_z + i);
    hn::Store(hn::Sub(along, hn::Mul(az, t_per_z)), d, frames.t_offset + i);
    const VD sign = hn::IfThenElse(hn::Gt(dz, zero), one, hn::Set(d, -1));
    hn::Store(hn::DemoteTo(narrow, sign), narrow, frames.sign + i);
    bits.valid |= BitsOf(d, valid) << i;
    bits.axis_is_1 |= BitsOf(d, is_1) << i;
    bits.axis_is_2 |= BitsOf(d, is_2) << i;
  }
  return bits;
}

// What a loop's corners and edges, one after the other, say of it.
class LoopLanes {
 public:
  LoopLanes(const FrameLanes::Arrays& frames, std::size_t first, std::size_t axis)
      : slope_x_(hn::Load(DF(), frames.slope_x + first)),
        slope_y_(hn::Load(DF(), frames.slope_y + first)),
        offset_x_(hn::Load(DF(), frames.offset_x + first)),
        offset_y_(hn::Load(DF(), frames.offset_y + first)),
        sign_(hn::Load(DF(), frames.sign + first)),
        axis_(axis) {}

  struct Corner {
    VF x, y;
  };
  HWY_INLINE Corner Shear(const WalkablePoint& p) const {
    const DF d;
    const VF px = hn::Set(d, p.position[(axis_ + 1) % 3]);
    const VF py = hn::Set(d, p.position[(axis_ + 2) % 3]);
    const VF pz = hn::Set(d, p.position[axis_]);
    return {hn::Sub(hn::Sub(px, offset_x_), hn::Mul(slope_x_, pz)),
            hn::Sub(hn::Sub(py, offset_y_), hn::Mul(slope_y_, pz))};
  }

  // Corners all to the right or all to the left are passed by, unless products of what is so small
  // that it underflows say otherwise.
  HWY_INLINE void AddCorner(const Corner& c) {
    const DF d;
    const VF beside = hn::Set(d, 1e-12f), tiny = hn::Set(d, 1e-25f);
    const MF up = hn::Ge(c.y, hn::Zero(d));
    above_ = hn::Or(above_, up);
    below_ = hn::Or(below_, hn::Not(up));
    not_right_ = hn::Or(not_right_, hn::Not(hn::Gt(c.x, beside)));
    not_left_ = hn::Or(not_left_, hn::Not(hn::Lt(c.x, hn::Neg(beside))));
    tiny_ = hn::Or(tiny_, hn::Not(hn::Gt(hn::Abs(c.y), tiny)));
  }

  // crossing() of sheared_frame.h.
  HWY_INLINE void AddEdge(const Corner& a, const Corner& b) {
    const DF d;
    const VF zero = hn::Zero(d), one = hn::Set(d, 1);
    const MF a_up = hn::Ge(a.y, zero), b_up = hn::Ge(b.y, zero);
    const VF forth = hn::Mul(a.x, b.y), back = hn::Mul(b.x, a.y);
    const MF rises = hn::And(hn::AndNot(a_up, b_up), hn::Gt(forth, back));
    const MF falls = hn::And(hn::AndNot(b_up, a_up), hn::Gt(back, forth));
    winding_ = hn::Add(winding_, hn::IfThenElseZero(rises, one));
    winding_ = hn::Sub(winding_, hn::IfThenElseZero(falls, one));
  }

  HWY_INLINE unsigned MayEnter(std::size_t corners, bool planar) const {
    const DF d;
    const MF enters = hn::Lt(hn::Mul(winding_, sign_), hn::Zero(d));
    // What is planar is not crossed without a winding.
    if (planar) return BitsOf(d, enters);
    const MF beside = hn::Or(hn::Not(hn::And(above_, below_)),
                             hn::AndNot(tiny_, hn::Not(hn::And(not_right_, not_left_))));
    const MF none = hn::Eq(winding_, hn::Zero(d));
    if (corners == 4) return BitsOf(d, hn::Or(enters, hn::AndNot(beside, none)));
    return BitsOf(d, hn::Or(enters, hn::Not(beside)));
  }

 private:
  const VF slope_x_, slope_y_, offset_x_, offset_y_, sign_;
  const std::size_t axis_;
  MF above_ = hn::MaskFromVec(hn::Zero(DF())), below_ = above_, not_right_ = above_;
  MF not_left_ = above_, tiny_ = above_;
  VF winding_ = hn::Zero(DF());
};

unsigned MayEnter(const FrameLanes::Arrays& frames, int axis,
                  std::span<const WalkablePoint* const> corners, bool planar) {
  const DF d;
  const std::size_t n = corners.size();
  unsigned bits = 0;
  for (std::size_t i = 0; i < RayLanes::kRays; i += hn::Lanes(d)) {
    LoopLanes loop(frames, i, static_cast<std::size_t>(axis));
    const LoopLanes::Corner first = loop.Shear(*corners[0]);
    if (!planar) loop.AddCorner(first);
    LoopLanes::Corner last = first;
    for (std::size_t c = 1; c < n; ++c) {
      const LoopLanes::Corner next = loop.Shear(*corners[c]);
      if (!planar) loop.AddCorner(next);
      loop.AddEdge(last, next);
      last = next;
    }
    loop.AddEdge(last, first);
    bits |= loop.MayEnter(n, planar) << i;
  }
  return bits;
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(SetFrames);
HWY_EXPORT(MayEnter);

void FrameLanes::set(const RayLanes& rays, const LocalFrame& local) {
  const Bits bits = HWY_DYNAMIC_DISPATCH(SetFrames)(rays, local, arrays_);
  size_ = rays.size;
  const unsigned there = (1u << size_) - 1;
  valid_ = bits.valid & there;
  axis_is_1_ = bits.axis_is_1 & there;
  axis_is_2_ = bits.axis_is_2 & there;
  auto all_or_none = [&](unsigned some) { return some == 0 || some == there; };
  one_axis_ = all_or_none(axis_is_1_) && all_or_none(axis_is_2_);
}

void FrameLanes::put(std::size_t i, ShearedFrame& frame) const {
  frame.set_axis(axis(i), arrays_.sign[i] > 0 ? 1 : -1);
  frame.line_ = {arrays_.slope_x[i], arrays_.slope_y[i], arrays_.offset_x[i], arrays_.offset_y[i]};
  frame.t_per_z_ = arrays_.t_per_z[i];
  frame.t_offset_ = arrays_.t_offset[i];
}

void FrameLanes::lines(std::array<float*, 3> start, std::array<float*, 3> step) const {
  if (!one_axis_) {
    for (std::size_t i = 0; i < size_; ++i) {
      ShearedFrame one;
      put(i, one);
      const auto from = one.start(), along = one.step();
      for (std::size_t a = 0; a < 3; ++a) {
        start[a][i] = from[a];
        step[a][i] = along[a];
      }
    }
    return;
  }
  const auto z_axis = static_cast<std::size_t>(axis(0));
  const std::size_t x_axis = (z_axis + 1) % 3, y_axis = (z_axis + 2) % 3;
  for (std::size_t i = 0; i < kRays; ++i) {
    const float sign = arrays_.sign[i], z = -ShearedFrame::kStart * sign;
    start[x_axis][i] = arrays_.offset_x[i] + arrays_.slope_x[i] * z;
    start[y_axis][i] = arrays_.offset_y[i] + arrays_.slope_y[i] * z;
    start[z_axis][i] = z;
    step[x_axis][i] = arrays_.slope_x[i] * sign;
    step[y_axis][i] = arrays_.slope_y[i] * sign;
    step[z_axis][i] = sign;
  }
}

unsigned FrameLanes::may_enter(std::span<const WalkablePoint* const> corners, bool planar) const {
  if (!one_axis_) return 0xFFFFu;
  return HWY_DYNAMIC_DISPATCH(MayEnter)(arrays_, axis(0), corners, planar);
}

}  // namespace plume
#endif  // HWY_ONCE
