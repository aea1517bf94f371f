#include "plume/traverse/frame_lanes.h"

#include <cmath>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/frame_lanes.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/double_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

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

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(SetFrames);

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

}  // namespace plume
#endif  // HWY_ONCE
