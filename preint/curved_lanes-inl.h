// Polynomials along segments cut into parts that are as good as linear, a segment a lane. Compiled
// once for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_PREINT_CURVED_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_PREINT_CURVED_LANES_INL_H_
#undef PLUME_PREINT_CURVED_LANES_INL_H_
#else
#define PLUME_PREINT_CURVED_LANES_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <limits>

#include "hwy/highway.h"
#include "plume/preint/closed_form-inl.h"
#include "plume/preint/scalar_polynomial.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {
namespace optics {

// ScalarPolynomial in single precision: through the scalars at the ends and, of a quadratic, the
// one in the middle, of a cubic, those at a third and two thirds, for the lanes that are `curved`;
// linear for the others. A lane with any value that is not finite is transparent.
template <std::size_t kInner>
class CurvedLanes {
 public:
  static constexpr std::size_t kCount = kInner;

  // Refers to the inner scalars.
  HWY_INLINE CurvedLanes(MF curved, VF s_in, VF s_out, const VF (&inner)[kInner])
      : curved_(curved), inner_(inner), s_in_(s_in), s_out_(s_out) {
    const DF d;
    auto times = [&](float factor, VF value) { return hn::Mul(hn::Set(d, factor), value); };
    const VF all = hn::Sub(s_out, s_in);
    // From the first value on, so that rounding is a share of what the scalar changes by.
    const VF first = hn::Sub(inner[0], s_in);
    if constexpr (kInner == 1) {
      square_ = times(2, hn::Sub(all, hn::Add(first, first)));
      cube_ = hn::Zero(d);
    } else {
      const VF second = hn::Sub(inner[1], s_in);
      // Divided differences: 4.5 d012 and d0123 of equidistant values.
      cube_ = times(4.5f, hn::Add(times(3, hn::Sub(first, second)), all));
      square_ = hn::Sub(times(4.5f, hn::Sub(second, hn::Add(first, first))), cube_);
    }
    const VF largest = Largest(s_in, s_out, inner);
    const MF finite = hn::Le(largest, hn::Set(d, std::numeric_limits<float>::max()));
    const VF not_known = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
    const MF lost = hn::AndNot(finite, curved);
    s_in_ = hn::IfThenElse(lost, not_known, s_in_);
    s_out_ = hn::IfThenElse(lost, not_known, s_out_);
    // How far from its chord: see ScalarPolynomial::bend(). The second derivative of a cubic is
    // greatest at an end.
    const VF six = times(6, cube_), two = hn::Add(square_, square_);
    bend_ = times(0.125f, hn::Max(hn::Abs(two), hn::Abs(hn::Add(two, six))));
    // Where no more than rounding of the values bends it, it is linear.
    const MF bends =
        hn::And(hn::And(curved, finite), hn::Gt(bend_, times(13.5f * 0x1p-24f, largest)));
    square_ = hn::IfThenElseZero(bends, square_);
    cube_ = hn::IfThenElseZero(bends, cube_);
    bend_ = hn::IfThenElseZero(bends, bend_);
    slope_ = hn::Sub(hn::Sub(all, square_), cube_);
  }

  // At a share of the way, 0 to 1.
  HWY_INLINE VF At(VF u) const {
    return hn::MulAdd(u, hn::MulAdd(u, hn::MulAdd(u, cube_, square_), slope_), s_in_);
  }

  // What it was made of.
  HWY_INLINE MF Curves() const { return curved_; }
  HWY_INLINE const VF* Inner() const { return inner_; }

  // The integral over [0, 1]; not a number where any value is not finite.
  HWY_INLINE VF Mean() const {
    const DF d;
    const VF cubes = hn::MulAdd(cube_, hn::Set(d, 0.25f), hn::Mul(square_, hn::Set(d, 1.0f / 3)));
    return hn::MulAdd(hn::Set(d, 0.5f), slope_, hn::Add(cubes, s_in_));
  }

  // How far it is from its chord at the most.
  HWY_INLINE VF Bend() const { return bend_; }

  // Calls visit(lanes, value) for the values where the derivative is 0 between 0 and 1.
  template <class Visit>
  HWY_INLINE void ForEachExtremum(const Visit& visit) const {
    const DF d;
    const VF zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    // a u^2 + 2 b u + c, by the formula that does not cancel; what is divided by 0 is not between.
    const VF a = hn::Mul(hn::Set(d, 3.0f), cube_);
    const VF discriminant = hn::MulSub(square_, square_, hn::Mul(a, slope_));
    const MF turns = hn::Gt(discriminant, zero);
    if (HWY_LIKELY(hn::AllFalse(d, turns))) return;
    const VF root = hn::Sqrt(hn::Max(discriminant, zero));
    const VF q = hn::Neg(hn::Add(square_, hn::CopySign(root, square_)));
    for (const VF u : {hn::Div(slope_, q), hn::Div(q, a)}) {
      const MF inside = hn::And(turns, hn::And(hn::Gt(u, zero), hn::Lt(u, one)));
      if (!hn::AllFalse(d, inside)) visit(inside, At(u));
    }
  }

  // Calls visit(active, s_in, s_out, length) for parts of equal length, in turn in all lanes, that
  // differ from the polynomial by at most `tolerance` but for rounding. Unlike ScalarPolynomial's
  // they may hold an extremum; so there may be as many as those of its three monotone parts
  // together.
  //
  // Each is the chord, moved until its mean is the polynomial's: optics that are linear over the
  // scalar then see what they would see of the polynomial, but for the order of it, and chords, all
  // of which lie on one side of a bend, would be off all the way by the same sign. Parts of a
  // segment that bends therefore do not join, but within the tolerance. The mean of a cubic is off
  // that of its chord by w^2 / 12 times its second derivative half way, w being the part's width.
  template <class Visit>
  HWY_INLINE void ForEachLinearPart(MF active, VF length, float tolerance,
                                    const Visit& visit) const {
    const DF d;
    const VF most = hn::Set(d, 3.0f * ScalarPolynomial::kMostPieces);
    const VF one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    const VF needed = hn::Sqrt(hn::Mul(bend_, hn::Set(d, 1 / tolerance)));
    // One also where that is no number.
    const VF parts = hn::IfThenElse(hn::Gt(needed, one), hn::Min(most, hn::Ceil(needed)), one);
    const VF share = hn::Div(one, parts), part = hn::Mul(length, share);
    const VF by = hn::Mul(hn::Mul(share, share), hn::Set(d, -1.0f / 6));
    const VF slope = hn::Mul(hn::Set(d, 3.0f), cube_);
    auto visit_part = [&](MF on, VF number, VF from, VF to) {
      const VF middle = hn::Mul(hn::Sub(number, half), share);
      const VF moved = hn::Mul(by, hn::MulAdd(slope, middle, square_));
      visit(on, hn::Add(from, moved), hn::Add(to, moved), part);
    };
    VF from = s_in_, number = one;
    for (;;) {
      const MF last = hn::Ge(number, parts);
      const VF to = hn::IfThenElse(last, s_out_, At(hn::Mul(number, share)));
      visit_part(active, number, from, to);
      active = hn::AndNot(last, active);
      if (HWY_LIKELY(hn::AllFalse(d, active))) return;
      from = to;
      number = hn::Add(number, one);
    }
  }

 private:
  // Not a number where any value is none.
  static HWY_INLINE VF Largest(VF s_in, VF s_out, const VF (&inner)[kInner]) {
    const DF d;
    VF largest = hn::Max(hn::Abs(s_in), hn::Abs(s_out)), zeros = hn::Mul(s_in, hn::Zero(d));
    zeros = hn::MulAdd(s_out, hn::Zero(d), zeros);
    for (std::size_t i = 0; i < kInner; ++i) {
      largest = hn::Max(largest, hn::Abs(inner[i]));
      zeros = hn::MulAdd(inner[i], hn::Zero(d), zeros);
    }
    return hn::Add(largest, zeros);
  }

  MF curved_;
  const VF* inner_;
  VF s_in_, s_out_, slope_, square_, cube_, bend_;
};

}  // namespace optics
}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
