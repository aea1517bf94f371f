// What the lanes of a packet have along three axes, of which each lane picks one. Compiled once for
// each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_AXIS_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_AXIS_LANES_INL_H_
#undef PLUME_TRAVERSE_AXIS_LANES_INL_H_
#else
#define PLUME_TRAVERSE_AXIS_LANES_INL_H_
#endif
// clang-format on

#include <cstddef>

#include "hwy/highway.h"
#include "plume/traverse/lane_loads-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Half of a packet's lanes in double; all of them where a vector has one lane.
using DD = HWY_CAPPED(double, kMaxLanes / 2);
using DI = hn::RebindToSigned<DD>;
using DH = hn::Rebind<float, DD>;
using VD = hn::Vec<DD>;
using VI = hn::Vec<DI>;
using VH = hn::Vec<DH>;
using MD = hn::Mask<DD>;
constexpr std::size_t kDoubles = hn::MaxLanes(DD());
constexpr std::size_t kParts = hn::MaxLanes(DF()) / kDoubles;

// What the parts have, for all lanes.
HWY_INLINE VF Join(const VH (&parts)[kParts]) {
#if HWY_TARGET == HWY_SCALAR
  return parts[0];
#else
  return hn::Combine(DF(), parts[1], parts[0]);
#endif
}
HWY_INLINE MF Join(const MD (&parts)[kParts]) {
#if HWY_TARGET == HWY_SCALAR
  return MF::FromBool(parts[0].bits != 0);
#elif HWY_TARGET <= HWY_AVX3
  return MF{static_cast<__mmask16>(parts[1].raw << 8 | parts[0].raw)};
#else
  const DF d;
  return hn::MaskFromVec(hn::ConcatEven(d, hn::BitCast(d, hn::VecFromMask(DD(), parts[1])),
                                        hn::BitCast(d, hn::VecFromMask(DD(), parts[0]))));
#endif
}

// Which axis each lane picks: whether the plane ahead along the second one is crossed before that
// along the first, and that along the third before both.
template <class M>
struct ExitLanes {
  M second_first, third;

  // What the axis of the exit has; what the first of the other two has, and the last of them.
  template <class V>
  HWY_INLINE V Of(const V (&axes)[3]) const {
    return hn::IfThenElse(third, axes[2], hn::IfThenElse(second_first, axes[1], axes[0]));
  }
  template <class V>
  HWY_INLINE V FirstBesides(const V (&axes)[3]) const {
    return hn::IfThenElse(hn::Or(second_first, third), axes[0], axes[1]);
  }
  template <class V>
  HWY_INLINE V LastBesides(const V (&axes)[3]) const {
    return hn::IfThenElse(third, axes[1], axes[2]);
  }
};

template <class D, class T>
HWY_INLINE void LoadAxes(D d, const T (&from)[3][kMaxLanes], std::size_t lane,
                         hn::Vec<D> (&axes)[3]) {
  for (std::size_t a = 0; a < 3; ++a) axes[a] = hn::Load(d, from[a] + lane);
}

// Puts what is new along the axis of the exit in the place of what was there.
template <class D, class M, class T>
HWY_INLINE void StoreExit(D d, const ExitLanes<M>& exit, const hn::Vec<D> (&axes)[3],
                          hn::Vec<D> with, std::size_t lane, T (&to)[3][kMaxLanes]) {
  hn::Store(hn::IfThenElse(hn::Or(exit.second_first, exit.third), axes[0], with), d, to[0] + lane);
  hn::Store(hn::IfThenElse(hn::AndNot(exit.third, exit.second_first), with, axes[1]), d,
            to[1] + lane);
  hn::Store(hn::IfThenElse(exit.third, with, axes[2]), d, to[2] + lane);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
