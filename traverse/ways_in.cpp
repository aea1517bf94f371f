#include "plume/traverse/ways_in.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/ways_in.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/way_in_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// What a loop's corners and edges, one after the other, say of it.
class LoopLanes {
 public:
  LoopLanes(const FrameLanes::Arrays& frames, std::size_t first, std::size_t axis)
      : slope_x_(hn::Load(DF(), frames.slope_x + first)),
        slope_y_(hn::Load(DF(), frames.slope_y + first)),
        offset_x_(hn::Load(DF(), frames.offset_x + first)),
        offset_y_(hn::Load(DF(), frames.offset_y + first)),
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

  HWY_INLINE VF Winding() const { return winding_; }
  // Lanes whose rays pass beside the corners.
  HWY_INLINE MF Beside() const {
    return hn::Or(hn::Not(hn::And(above_, below_)),
                  hn::AndNot(tiny_, hn::Not(hn::And(not_right_, not_left_))));
  }

 private:
  const VF slope_x_, slope_y_, offset_x_, offset_y_;
  const std::size_t axis_;
  MF above_ = hn::MaskFromVec(hn::Zero(DF())), below_ = above_, not_right_ = above_;
  MF not_left_ = above_, tiny_ = above_;
  VF winding_ = hn::Zero(DF());
};

void FindWaysIn(const FrameLanes::Arrays& frames, int axis, const BoundaryLoop& face,
                WaysIn& found) {
  const DF d;
  const std::size_t n = face.corners.size();
  // What is planar is not crossed without a winding.
  const bool planar = face.surface == FaceSurface::triangle || face.surface == FaceSurface::planar;
  WayInCorners corners;
  found.maybe = found.once = 0;
  for (std::size_t i = 0; i < RayLanes::kRays; i += hn::Lanes(d)) {
    LoopLanes loop(frames, i, static_cast<std::size_t>(axis));
    auto shear = [&](std::size_t c) HWY_ATTR {
      const LoopLanes::Corner at = loop.Shear(*face.corners[c]);
      if (!planar) loop.AddCorner(at);
      if (c < WayInCorners::kMost) {
        hn::Store(at.x, d, corners.x[c] + i);
        hn::Store(at.y, d, corners.y[c] + i);
      }
      return at;
    };
    const LoopLanes::Corner first = shear(0);
    LoopLanes::Corner last = first;
    for (std::size_t c = 1; c < n; ++c) {
      const LoopLanes::Corner next = shear(c);
      loop.AddEdge(last, next);
      last = next;
    }
    loop.AddEdge(last, first);
    // Below zero at a way in.
    const VF sign = hn::Load(d, frames.sign + i);
    const VF outwards = hn::Mul(loop.Winding(), face.is_from_outside ? sign : hn::Neg(sign));
    const MF enters = hn::Lt(outwards, hn::Zero(d));
    MF maybe = enters;
    if (!planar) {
      const MF wound = n == 4 ? hn::Eq(outwards, hn::Zero(d)) : hn::Not(enters);
      maybe = hn::Or(maybe, hn::AndNot(loop.Beside(), wound));
    }
    found.maybe |= BitsOf(d, maybe) << i;
    if (face.surface != FaceSurface::other)
      found.once |= BitsOf(d, hn::Eq(outwards, hn::Set(d, -1))) << i;
    hn::Store(loop.Winding(), d, corners.winding + i);
  }
  if (found.once == 0) return;
  for (std::size_t c = 0; c < n; ++c) {
    corners.z[c] = static_cast<double>(face.corners[c]->position[static_cast<std::size_t>(axis)]);
    corners.scalar[c] = static_cast<double>(face.corners[c]->scalar);
  }
  found.once &= MeasureWaysIn(corners, face.surface, found);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(FindWaysIn);

void find_ways_in(const FrameLanes& frames, const BoundaryLoop& face, WaysIn& found) {
  if (frames.has_one_axis()) {
    HWY_DYNAMIC_DISPATCH(FindWaysIn)(frames.arrays(), frames.axis(0), face, found);
    return;
  }
  found.maybe = 0xFFFFu;
  found.once = 0;
}

}  // namespace plume
#endif  // HWY_ONCE
