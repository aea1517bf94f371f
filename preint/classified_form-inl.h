// Volume, interval volumes and isosurfaces along segments, a segment a lane. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.
//
// The same parts as IntervalState's (interval_state.h), in single precision, each composited as in
// closed_form-inl.h: a segment is walked from piece to piece of ClassifiedPieces. A piece of an
// interval counts by the part of w that is newly covered in the place of a length; that of an
// isosurface has no length, and an opacity.

// clang-format off
#if defined(PLUME_PREINT_CLASSIFIED_FORM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_PREINT_CLASSIFIED_FORM_INL_H_
#undef PLUME_PREINT_CLASSIFIED_FORM_INL_H_
#else
#define PLUME_PREINT_CLASSIFIED_FORM_INL_H_
#endif
// clang-format on

#include <limits>

#include "hwy/highway.h"
#include "plume/preint/classified_pieces.h"
#include "plume/preint/closed_form-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {
namespace optics {

// What rays carry from segment to segment.
struct Visits {
  // Where the ray is.
  VU piece;
  // Of an interval: the extreme of the scalar since the ray came in, or the interval's upper end
  // where it has seen all of it.
  VF reached;
  // 1 where it came in by the interval's low end, -1 where by the high one; twice that until it has
  // covered something.
  VF side;
  // Isosurfaces crossed, and visits to intervals that covered something.
  VU surfaces, visits;
};

// Where light falls on what is composited: factors on its colour, and highlights.
struct Lit {
  VF factor, highlight;
};

// Composites one segment a lane, as Composite() does. Each lane's ray must be in its piece (see
// ClassifiedPieces::piece_of) at s_in, which is finite in active lanes, as is s_out; it is left in
// that of s_out. A length of 0 stands for a jump.
//
// With kLit, `light(surface, visit, rest)` is asked where lanes cross an isosurface or first cover
// something of an interval, `rest` before the segments' ends, and gives the light on it; `visited`
// is that of the visit the ray is on.
template <bool kLit, class Table, class Light>
HWY_INLINE void CompositeClassified(const Table& pieces, MF active, VF s_in, VF s_out, VF length,
                                    Visits& state, Sums& sums, Lit& visited, const Light& light) {
  const DF d;
  const DU du;
  const VF zero = hn::Zero(d);
  const VF half = hn::Set(d, 0.5f);
  const VF one = hn::Set(d, 1.0f);
  const MF rising = hn::Ge(s_out, s_in);
  const VF direction = hn::IfThenElse(rising, one, hn::Neg(one));
  const VU stride = hn::IfThenElse(hn::RebindMask(du, rising), hn::Set(du, 1), hn::Set(du, ~0u));
  const VF way = hn::Abs(hn::Sub(s_out, s_in));
  const VF per_scalar = hn::IfThenElseZero(
      hn::Gt(way, zero),
      hn::Min(hn::Set(d, std::numeric_limits<float>::max()), hn::Div(length, way)));
  active = hn::And(active, hn::Gt(sums.transmittance, hn::Set(d, kInvisible)));
  VF scalar = s_in;
  VF rest = length;
  Record where = pieces.template four<1>(state.piece);
  VF interval = where.d;  // or the volume; that of the last piece with a width
  for (;;) {
    const Record range = pieces.template four<0>(state.piece);
    const VF low = range.a, high = range.b, extinction = range.c, slope = range.d;
    const VF first = where.a, end = where.b, w_per_scalar = where.c;
    const MF inside = hn::Gt(w_per_scalar, zero);
    const MF surface = hn::And(active, hn::Lt(where.d, zero));
    const MF last =
        hn::Or(hn::And(rising, hn::Lt(s_out, end)), hn::AndNot(rising, hn::Ge(s_out, first)));
    const VF next = hn::IfThenElse(last, s_out, hn::IfThenElse(rising, high, low));
    const VF run = hn::IfThenElse(
        last, rest, hn::Min(rest, hn::Mul(hn::Abs(hn::Sub(next, scalar)), per_scalar)));
    // What is newly covered lies beyond the extreme, on the way on which the visit began.
    const VF beyond =
        hn::IfThenElse(rising, hn::Max(scalar, state.reached), hn::Min(scalar, state.reached));
    const VF ahead = hn::Mul(hn::Sub(next, beyond), direction);
    const MF covers = hn::And(hn::And(hn::And(active, inside), hn::Gt(ahead, zero)),
                              hn::Gt(hn::Mul(state.side, direction), zero));
    const VF from = hn::IfThenElse(inside, hn::IfThenElse(covers, beyond, next), scalar);
    VF part = hn::IfThenElse(inside, hn::IfThenElseZero(covers, hn::Mul(ahead, w_per_scalar)), run);
    state.reached = hn::IfThenElse(covers, next, state.reached);

    const MF begun = hn::And(covers, hn::Gt(hn::Abs(state.side), one));
    state.surfaces = hn::Sub(state.surfaces, hn::VecFromMask(du, hn::RebindMask(du, surface)));
    state.visits = hn::Sub(state.visits, hn::VecFromMask(du, hn::RebindMask(du, begun)));
    state.side = hn::IfThenElse(begun, direction, state.side);
    Lit lit{one, zero};
    if constexpr (kLit) {
      const MF met = hn::Or(surface, begun);
      lit = {hn::IfThenElse(inside, visited.factor, one),
             hn::IfThenElseZero(inside, visited.highlight)};
      if (HWY_UNLIKELY(!hn::AllFalse(d, met))) {
        const Lit now = light(surface, begun, rest);
        lit = {hn::IfThenElse(met, now.factor, lit.factor),
               hn::IfThenElse(met, now.highlight, lit.highlight)};
        visited = {hn::IfThenElse(begun, now.factor, visited.factor),
                   hn::IfThenElse(begun, now.highlight, visited.highlight)};
      }
    }
    auto composite = [&](MF seen, VF weight_of_all, VF chi, VF from_low, VF along) {
      const Record color = pieces.template four<2>(state.piece);
      const Record color_slope = pieces.template four<3>(state.piece);
      // Where nothing is seen, factors may be no numbers.
      const VF weight = hn::IfThenElseZero(seen, hn::Mul(sums.transmittance, weight_of_all));
      const VF turn = hn::IfThenElseZero(seen, hn::Mul(hn::Mul(sums.transmittance, chi), along));
      auto add = [&](VF& sum, VF value, VF value_slope) {
        const VF front = hn::MulAdd(from_low, value_slope, value);
        if constexpr (kLit) {
          const VF radiance = hn::MulAdd(turn, value_slope, hn::Mul(weight, front));
          sum = hn::MulAdd(radiance, lit.factor, hn::MulAdd(weight, lit.highlight, sum));
        } else {
          sum = hn::MulAdd(turn, value_slope, hn::MulAdd(weight, front, sum));
        }
      };
      add(sums.r, color.a, color_slope.a);
      add(sums.g, color.b, color_slope.b);
      add(sums.b, color.c, color_slope.c);
      sums.transmittance = hn::Sub(sums.transmittance, weight);
    };

    VF from_low = hn::Sub(from, low);
    VF along = hn::Sub(next, from);
    VF front = hn::Max(zero, hn::MulAdd(from_low, slope, extinction));
    const VF back = hn::Max(zero, hn::MulAdd(hn::Sub(next, low), slope, extinction));
    VF mean = hn::Mul(hn::Add(front, back), hn::Mul(half, part));
    MF deep = hn::And(active, hn::Gt(mean, one));
    if (HWY_UNLIKELY(!hn::AllFalse(d, deep))) {
      const VF growth = hn::Div(hn::Sub(back, front), part);
      do {
        // As far as an optical depth of 1: front h + growth h^2 / 2 = 1.
        const VF root = hn::Sqrt(hn::Max(zero, hn::MulAdd(front, front, hn::Add(growth, growth))));
        const VF h = hn::Min(part, hn::Div(hn::Set(d, 2.0f), hn::Add(front, root)));
        const VF bent = hn::Mul(hn::Mul(half, growth), hn::Mul(h, h));
        const VF step = hn::Mul(along, hn::Div(h, part));
        composite(deep, Absorbed(one), Chi(one, hn::Max(hn::Neg(one), hn::Min(one, bent))),
                  from_low, step);
        part = hn::IfThenElse(deep, hn::Sub(part, h), part);
        front = hn::IfThenElse(deep, hn::Max(zero, hn::MulAdd(growth, h, front)), front);
        from_low = hn::IfThenElse(deep, hn::Add(from_low, step), from_low);
        along = hn::IfThenElse(deep, hn::Sub(along, step), along);
        mean = hn::Mul(hn::Add(front, back), hn::Mul(half, part));
        active = hn::And(active, hn::Gt(sums.transmittance, hn::Set(d, kInvisible)));
        deep = hn::And(active, hn::Gt(mean, one));
      } while (!hn::AllFalse(d, deep));
    }
    // Where no lane meets any extinction, no colour is fetched.
    const MF seen = hn::Or(surface, hn::And(active, hn::Gt(mean, zero)));
    if (!hn::AllFalse(d, seen)) {
      const VF difference = hn::Mul(hn::Sub(back, front), hn::Mul(half, part));
      const bool any_farther = !hn::AllFalse(d, hn::Gt(mean, hn::Set(d, kNear)));
      const auto [taken, chi] = Absorb(mean, difference, any_farther);
      composite(seen, hn::IfThenElse(surface, extinction, taken), chi, from_low, along);
    }

    active = hn::AndNot(last, active);
    active = hn::And(active, hn::Gt(sums.transmittance, hn::Set(d, kInvisible)));
    if (HWY_LIKELY(hn::AllFalse(d, active))) return;
    rest = hn::Max(zero, hn::Sub(rest, run));
    scalar = next;
    const VU stride_of_active = hn::IfThenElseZero(hn::RebindMask(du, active), stride);
    state.piece = hn::Add(state.piece, stride_of_active);
    where = pieces.template four<1>(state.piece);
    // The isosurfaces in an interval end no visit to it.
    const MF arrives = hn::And(active, hn::Ge(where.d, zero));
    const MF enters = hn::And(hn::And(arrives, hn::Ne(where.d, interval)), hn::Gt(where.d, zero));
    interval = hn::IfThenElse(arrives, where.d, interval);
    state.reached = hn::IfThenElse(enters, scalar, state.reached);
    state.side = hn::IfThenElse(enters, hn::Add(direction, direction), state.side);
  }
}

}  // namespace optics
}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
