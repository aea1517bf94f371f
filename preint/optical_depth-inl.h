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

#include <limits>

#include "hwy/highway.h"
#include "plume/preint/closed_form-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {
namespace optics {

// Calls add(depth) with the lanes' optical depths, in parts that belong to one piece of the
// transfer function each: what Composite() does, without colours, and no part need be cut because
// it is deep. Lanes that are not active, or have a NaN, add 0. `pieces` need only the first four
// floats of PieceTable's.
template <class Table, class Add>
HWY_INLINE void AddDepths(const Table& pieces, MF active, VF s_in, VF s_out, VF length, VU& piece,
                          const Add& add) {
  const DF d;
  const DU du;
  const VF zero = hn::Zero(d);
  const VF half = hn::Set(d, 0.5f);
  const VF most = hn::Set(d, std::numeric_limits<float>::max());
  active = hn::And(active, hn::And(hn::Le(hn::Abs(s_in), most), hn::Le(hn::Abs(s_out), most)));
  active = hn::And(active, hn::Gt(length, zero));
  s_in = hn::IfThenElseZero(active, s_in);
  s_out = hn::IfThenElseZero(active, s_out);
  length = hn::IfThenElseZero(active, length);
  const MF rising = hn::Ge(s_out, s_in);
  const VU one_piece = hn::Set(du, 1);

  // The piece that the segment begins in: mostly where the last one ended.
  Record range;
  for (;;) {
    range = pieces.template four<0>(piece);
    const MF above =
        hn::And(active, hn::Or(hn::Gt(s_in, range.b), hn::And(rising, hn::Eq(s_in, range.b))));
    const MF below =
        hn::And(active, hn::Or(hn::Lt(s_in, range.a), hn::AndNot(rising, hn::Eq(s_in, range.a))));
    if (HWY_LIKELY(hn::AllFalse(d, hn::Or(above, below)))) break;
    piece = hn::Sub(piece, hn::VecFromMask(du, hn::RebindMask(du, above)));
    piece = hn::Add(piece, hn::VecFromMask(du, hn::RebindMask(du, below)));
  }

  const VF per_scalar = hn::Min(most, hn::Div(length, hn::Abs(hn::Sub(s_out, s_in))));
  VF bound = hn::IfThenElse(rising, range.b, range.a);
  MF last = hn::Or(hn::And(rising, hn::Le(s_out, bound)), hn::AndNot(rising, hn::Ge(s_out, bound)));
  VF begin = s_in, end = hn::IfThenElse(last, s_out, bound);
  // Of the length, what is in this piece.
  auto share = [&] { return hn::Min(length, hn::Mul(hn::Abs(hn::Sub(end, begin)), per_scalar)); };
  VF part = hn::IfThenElse(last, length, share());
  for (;;) {
    const VF anchor = AnchorOf(range);
    const VF front = hn::Max(zero, hn::MulAdd(hn::Sub(begin, anchor), range.d, range.c));
    const VF back = hn::Max(zero, hn::MulAdd(hn::Sub(end, anchor), range.d, range.c));
    add(hn::IfThenElseZero(active, hn::Mul(hn::Mul(hn::Add(front, back), half), part)));
    active = hn::AndNot(last, active);
    if (HWY_LIKELY(hn::AllFalse(d, active))) return;
    const VU stride = hn::IfThenElse(hn::RebindMask(du, rising), one_piece, hn::Set(du, ~0u));
    piece = hn::Add(piece, hn::IfThenElseZero(hn::RebindMask(du, active), stride));
    range = pieces.template four<0>(piece);
    begin = bound;
    bound = hn::IfThenElse(rising, range.b, range.a);
    last = hn::Or(hn::And(rising, hn::Le(s_out, bound)), hn::AndNot(rising, hn::Ge(s_out, bound)));
    end = hn::IfThenElse(last, s_out, bound);
    part = share();
  }
}

}  // namespace optics
}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
