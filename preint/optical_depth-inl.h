// The optical depth of segments, a segment a lane. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_PREINT_OPTICAL_DEPTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_PREINT_OPTICAL_DEPTH_INL_H_
#undef PLUME_PREINT_OPTICAL_DEPTH_INL_H_
#else
#define PLUME_PREINT_OPTICAL_DEPTH_INL_H_
#endif
// clang-format on

#include "hwy/highway.h"
#include "plume/preint/piece_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {
namespace optics {

// Calls add(depth) with the lanes' optical depths, in parts that belong to one piece of the
// transfer function each: what Composite() does, without colours, and no part need be cut because
// it is deep. Lanes whose length is 0, or with a scalar that is no finite number, add 0. `pieces`
// need only the first four floats of PieceTable's.
template <class Table, class Add>
HWY_INLINE void AddDepths(const Table& pieces, VF s_in, VF s_out, VF length, VU& piece,
                          const Add& add) {
  const DF d;
  const VF zero = hn::Zero(d);
  Course course(s_in, s_out, length);
  Record range = course.find_piece(pieces, piece);
  for (;;) {
    const VF anchor = AnchorOf(range), ahead = course.ahead(range);
    const VF end = hn::Min(course.out, ahead);
    auto extinction = [&](VF scalar) {
      return hn::Max(zero, hn::MulAdd(hn::Sub(course.turned(scalar), anchor), range.d, range.c));
    };
    const VF mean = hn::Mul(hn::Add(extinction(course.in), extinction(end)), hn::Set(d, 0.5f));
    add(hn::IfThenElseZero(course.active, hn::Mul(mean, course.length_to(end))));
    course.Advance(ahead, piece);
    if (HWY_LIKELY(hn::AllFalse(d, course.active))) return;
    range = pieces.template four<0>(piece);
  }
}

}  // namespace optics
}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
