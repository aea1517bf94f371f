// The closed form of segments, a segment a lane. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone.
//
// The same integral as ClosedForm (closed_form.h), in single precision. A segment is walked from
// knot to knot; a part of an optical depth above 2 is cut further, so that polynomials serve
// (absorption-inl.h).
//
// Max error of a segment: 1e-6 times the largest colour, and 1e-6 for alpha, for any transfer
// function whose extinction is at most 1e18 and any length; 6e-7 is the largest that
// tests/bench/segment_lanes_test.cpp has met, in 160,000 segments of each of seven transfer
// functions.

// clang-format off
#if defined(PLUME_PREINT_CLOSED_FORM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_PREINT_CLOSED_FORM_INL_H_
#undef PLUME_PREINT_CLOSED_FORM_INL_H_
#else
#define PLUME_PREINT_CLOSED_FORM_INL_H_
#endif
// clang-format on

#include "hwy/highway.h"
#include "plume/preint/absorption-inl.h"
#include "plume/preint/piece_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {
namespace optics {

// What lies behind a transparency of half of the last place of floats below 1 is not worth a look.
constexpr float kInvisible = 0x1p-25f;

// Front-to-back sums of the lanes' rays.
struct Sums {
  VF r, g, b, transmittance;
};

// Composites what of the lanes' segments lies in the piece that they are in, whose range that is,
// and leaves `course` and `piece` at the next. Lanes that have seen enough are left with nothing.
// `pieces` is the table: PermutedTable, or one that fetches from memory (how that is done best is
// known to who walks).
template <class Table>
HWY_INLINE void CompositePart(const Table& pieces, const Record& range, Course& course, VU& piece,
                              Sums& sums) {
  const DF d;
  const VF zero = hn::Zero(d);
  const VF half = hn::Set(d, 0.5f);
  const VF two = hn::Set(d, 2.0f);
  const VF extinction = range.c, slope = range.d;
  const VF ahead = course.ahead(range);
  const VF end = hn::Min(course.out, ahead);
  // Scalars are taken from the piece's anchor on: rounding then is a share of the piece, however
  // narrow it is, and no place in it is lost where the ray's part in it is cut.
  const VF anchor = AnchorOf(range);
  VF offset = hn::Sub(course.turned(course.in), anchor);
  const VF target = hn::Sub(course.turned(end), anchor);
  VF left = course.length_to(end);
  for (;;) {
    const VF front = hn::Max(zero, hn::MulAdd(offset, slope, extinction));
    const VF back = hn::Max(zero, hn::MulAdd(target, slope, extinction));
    const VF half_left = hn::Mul(half, left);
    VF mean = hn::Mul(hn::Add(front, back), half_left);
    VF difference = hn::Mul(hn::Sub(back, front), half_left);
    VF next = target;
    const bool any_farther = !hn::AllFalse(d, hn::Gt(mean, hn::Set(d, kNear)));
    const MF deep = hn::Gt(mean, two);
    const bool any_deep = any_farther && !hn::AllFalse(d, deep);
    if (HWY_UNLIKELY(any_deep)) {
      // As far as an optical depth of 2: front h + growth h^2 / 2 = 2.
      const VF rate = hn::Div(hn::Sub(target, offset), left);  // of the scalar
      const VF growth = hn::Mul(slope, rate);
      const VF four = hn::Set(d, 4.0f);
      const VF root = hn::Sqrt(hn::Max(zero, hn::MulAdd(front, front, hn::Mul(four, growth))));
      const VF h = hn::Min(left, hn::Div(four, hn::Add(front, root)));
      const VF bent = hn::Mul(hn::Mul(half, growth), hn::Mul(h, h));
      next = hn::IfThenElse(deep, hn::MulAdd(rate, h, offset), next);
      mean = hn::IfThenElse(deep, two, mean);
      difference = hn::IfThenElse(deep, hn::Max(hn::Neg(two), hn::Min(two, bent)), difference);
      left = hn::Sub(left, h);
    }
    // Where no lane meets any extinction, as in the clear ranges of most transfer functions, no
    // colour is fetched.
    const MF seen = hn::Gt(mean, zero);
    if (!hn::AllFalse(d, seen)) {
      const Record color = pieces.template four<1>(piece);
      const Record color_slope = pieces.template four<2>(piece);
      const auto [taken, chi] = Absorb(mean, difference, any_farther);
      const VF weight = hn::Mul(sums.transmittance, taken);
      const VF turn = hn::Mul(hn::Mul(sums.transmittance, chi), hn::Sub(next, offset));
      // Lanes that are done may hold anything: their polynomials overflow.
      auto add = [&](VF& sum, VF value, VF value_slope) {
        const VF with_front = hn::MulAdd(weight, hn::MulAdd(offset, value_slope, value), sum);
        sum = hn::IfThenElse(seen, hn::MulAdd(turn, value_slope, with_front), sum);
      };
      add(sums.r, color.a, color_slope.a);
      add(sums.g, color.b, color_slope.b);
      add(sums.b, color.c, color_slope.c);
      sums.transmittance =
          hn::IfThenElse(seen, hn::Sub(sums.transmittance, weight), sums.transmittance);
    }
    if (HWY_LIKELY(!any_deep)) break;
    const MF more = hn::And(deep, hn::Gt(sums.transmittance, hn::Set(d, kInvisible)));
    left = hn::IfThenElseZero(more, left);
    offset = next;
  }
  course.active = hn::And(course.active, hn::Gt(sums.transmittance, hn::Set(d, kInvisible)));
  course.Advance(ahead, piece);
}

// Composites one segment a lane: the scalar runs linearly from s_in to s_out, `length` >= 0 in
// world units. `piece` is that of the last segment's end, or any; it is left at this one's. Lanes
// whose length is 0, or with a scalar that is no finite number, keep their sums.
template <class Table>
HWY_INLINE void Composite(const Table& pieces, VF s_in, VF s_out, VF length, VU& piece,
                          Sums& sums) {
  Course course(s_in, s_out, length);
  Record range = course.find_piece(pieces, piece);
  for (;;) {
    CompositePart(pieces, range, course, piece, sums);
    if (HWY_LIKELY(hn::AllFalse(DF(), course.active))) return;
    range = pieces.template four<0>(piece);
  }
}

}  // namespace optics
}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
