// The closed form of segments, a segment a lane. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone.
//
// The same integral as ClosedForm (closed_form.h), in single precision. A segment is walked from
// knot to knot; a part of an optical depth above 2 is cut further, so that polynomials serve. With
// m the part's optical depth and d half of the difference between the depths that its back and its
// front optics would give alone, for m <= 2 and |d| <= m:
//     alpha = 1 - exp(-m) = m A(m)
//     chi = psi - exp(-m) = m X0(m) + d X1(m) + d^2 X2(m) + ... + d^7 X7(m)
// as the transparency so far is exp(-m u) exp(d u (1 - u)), of which the second factor is expanded.
// Fitted at Chebyshev nodes: A to 1e-9 relative, chi to 9e-8 absolute. Lanes whose m is
// at most 1, in most meshes all, are given shorter ones of the same errors: A to 2e-9, chi (up to
// d^5) to 8e-8.
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

#include <cstddef>
#include <limits>
#include <vector>

#include "hwy/highway.h"
#include "plume/preint/piece_table.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {
namespace optics {

namespace hn = hwy::HWY_NAMESPACE;

using DF = HWY_CAPPED(float, 16);
using DU = hn::RebindToUnsigned<DF>;
using DI = hn::RebindToSigned<DF>;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using MF = hn::Mask<DF>;

// What lies behind a transparency of half of the last place of floats below 1 is not worth a look.
constexpr float kInvisible = 0x1p-25f;

// Front-to-back sums of the lanes' rays.
struct Sums {
  VF r, g, b, transmittance;
};

HWY_INLINE VF Horner(VF x, float c0) {
  (void)x;
  return hn::Set(DF(), c0);
}
// c0 + c1 x + c2 x^2 + ...
template <class... C>
HWY_INLINE VF Horner(VF x, float c0, C... more) {
  return hn::MulAdd(Horner(x, more...), x, hn::Set(DF(), c0));
}

// 1 - exp(-m) for m in [0, 1].
HWY_INLINE VF Absorbed(VF m) {
  return hn::Mul(m,
                 Horner(m, 9.999999979e-01f, -4.999997973e-01f, 1.666634031e-01f, -4.164684931e-02f,
                        8.275504845e-03f, -1.300774959e-03f, 1.290763106e-04f));
}

// psi - exp(-m) for m in [0, 1], |d| <= m.
HWY_INLINE VF Chi(VF m, VF d) {
  const VF x0 = Horner(m, 4.999999982e-01f, -3.333331540e-01f, 1.249971129e-01f, -3.331579905e-02f,
                       6.893263273e-03f, -1.112450202e-03f, 1.121481829e-04f);
  const VF x1 = Horner(m, 1.666666599e-01f, -8.333284789e-02f, 2.499428835e-02f, -5.530755573e-03f,
                       9.426105211e-04f, -1.016378370e-04f);
  const VF x2 = Horner(m, 1.666664986e-02f, -8.332490790e-03f, 2.374123241e-03f, -4.763509607e-04f,
                       5.870130521e-05f);
  const VF x3 = Horner(m, 1.190444501e-03f, -5.942196611e-04f, 1.601330927e-04f, -2.423962708e-05f);
  const VF x4 = Horner(m, 6.609377066e-05f, -3.227347494e-05f, 6.789842466e-06f);
  const VF x5 = Horner(m, 2.964161757e-06f, -1.158061818e-06f);
  VF sum = hn::MulAdd(x5, d, x4);
  sum = hn::MulAdd(sum, d, x3);
  sum = hn::MulAdd(sum, d, x2);
  sum = hn::MulAdd(sum, d, x1);
  return hn::MulAdd(sum, d, hn::Mul(x0, m));
}

// 1 - exp(-m) for m in [0, 2].
HWY_INLINE VF AbsorbedFarther(VF m) {
  return hn::Mul(m, Horner(m, 9.999999995e-01f, -4.999999606e-01f, 1.666661380e-01f,
                           -4.166392097e-02f, 8.326138674e-03f, -1.378184669e-03f, 1.888878189e-04f,
                           -1.968693803e-05f, 1.148025996e-06f));
}

// psi - exp(-m) for m in [0, 2], |d| <= m.
HWY_INLINE VF ChiFarther(VF m, VF d) {
  const VF x0 = Horner(m, 4.999999996e-01f, -3.333332977e-01f, 1.249995226e-01f, -3.333085395e-02f,
                       6.937946388e-03f, -1.180805539e-03f, 1.650018808e-04f, -1.741917869e-05f,
                       1.023611181e-06f);
  const VF x1 = Horner(m, 1.666666658e-01f, -8.333327825e-02f, 2.499941713e-02f, -5.553188422e-03f,
                       9.872938196e-04f, -1.435024139e-04f, 1.591221117e-05f, -9.971479238e-07f);
  const VF x2 = Horner(m, 1.666666544e-02f, -8.333273154e-03f, 2.380465807e-03f, -4.945408448e-04f,
                       8.046129416e-05f, -9.840097438e-06f, 6.792967449e-07f);
  const VF x3 = Horner(m, 1.190474788e-03f, -5.951874622e-04f, 1.650439589e-04f, -3.240814560e-05f,
                       4.584000514e-06f, -3.597877008e-07f);
  const VF x4 = Horner(m, 6.613629427e-05f, -3.303683614e-05f, 8.887799123e-06f, -1.560166198e-06f,
                       1.454143869e-07f);
  const VF x5 = Horner(m, 3.005356531e-06f, -1.488663272e-06f, 3.669013556e-07f, -4.339337153e-08f);
  const VF x6 = Horner(m, 1.151494714e-07f, -5.345672262e-08f, 9.024000355e-09f);
  const VF x7 = Horner(m, 3.673825703e-09f, -1.169713532e-09f);
  VF sum = hn::MulAdd(x7, d, x6);
  sum = hn::MulAdd(sum, d, x5);
  sum = hn::MulAdd(sum, d, x4);
  sum = hn::MulAdd(sum, d, x3);
  sum = hn::MulAdd(sum, d, x2);
  sum = hn::MulAdd(sum, d, x1);
  return hn::MulAdd(sum, d, hn::Mul(x0, m));
}

// Four floats a lane: of a piece's range low, high, extinction and its slope; of a colour, or its
// slope, r, g, b.
struct Record {
  VF a, b, c, d;
};

#if HWY_TARGET != HWY_SCALAR
// A table of no more than kMost pieces: entries are permuted, not fetched. As many pieces as there
// are lanes need one permutation an entry, twice as many two.
template <class Piece, std::size_t kParts>
class PermutedTable {
 public:
  static constexpr std::size_t kFloats = sizeof(Piece) / sizeof(float);
  static constexpr std::size_t kMost = kParts * hn::MaxLanes(DF());
  static_assert(sizeof(Piece) == kFloats * sizeof(float) && kFloats % 4 == 0);
  static_assert(kParts == 1 || kParts == 2);

  static bool fits(const std::vector<Piece>& pieces) {
    return hn::Lanes(DF()) == hn::MaxLanes(DF()) && pieces.size() <= kMost;
  }

  explicit PermutedTable(const std::vector<Piece>& pieces) {
    for (std::size_t i = 0; i < kMost; ++i) {
      const float* const from = &pieces[i < pieces.size() ? i : 0].low;
      for (std::size_t f = 0; f < kFloats; ++f) values_[f][i] = from[f];
    }
  }
  template <std::size_t kGroup>
  HWY_INLINE Record four(VU piece) const {
    constexpr std::size_t kFirst = 4 * kGroup;
    return {entry(kFirst, piece), entry(kFirst + 1, piece), entry(kFirst + 2, piece),
            entry(kFirst + 3, piece)};
  }

 private:
  HWY_INLINE VF entry(std::size_t f, VU piece) const {
    const DF d;
    const DU du;
    constexpr std::size_t kLanes = hn::MaxLanes(DF());
    if constexpr (kParts == 1)
      return hn::TableLookupLanes(hn::Load(d, values_[f]), hn::IndicesFromVec(d, piece));
    const auto lane = hn::IndicesFromVec(d, hn::And(piece, hn::Set(du, kLanes - 1)));
    const MF upper = hn::RebindMask(d, hn::Gt(piece, hn::Set(du, kLanes - 1)));
    return hn::IfThenElse(upper, hn::TableLookupLanes(hn::Load(d, values_[f] + kLanes), lane),
                          hn::TableLookupLanes(hn::Load(d, values_[f]), lane));
  }

  HWY_ALIGN float values_[kFloats][kMost];
};
#endif

// The end of a piece that its numbers count from (see PieceTable).
HWY_INLINE VF AnchorOf(const Record& range) {
  const DF d;
  const MF falls = hn::MaskFromVec(
      hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(hn::RebindToSigned<DF>(), range.d))));
  return hn::IfThenElse(falls, range.b, range.a);
}

// Composites one segment a lane: the scalar runs linearly from s_in to s_out, `length` >= 0 in
// world units. `piece` is that of the last segment's end, or any; it is left at this one's. Lanes
// that are not active, or have a NaN, keep their sums. `pieces` is the table: PermutedTable, or
// one that fetches from memory (how that is done best is known to who walks).
template <class Table>
HWY_INLINE void Composite(const Table& pieces, MF active, VF s_in, VF s_out, VF length, VU& piece,
                          Sums& sums) {
  const DF d;
  const DU du;
  const VF zero = hn::Zero(d);
  const VF half = hn::Set(d, 0.5f);
  const VF one = hn::Set(d, 1.0f);
  const VF two = hn::Set(d, 2.0f);
  const VU one_piece = hn::Set(du, 1);
  const VF most = hn::Set(d, std::numeric_limits<float>::max());
  active = hn::And(active, hn::And(hn::Le(hn::Abs(s_in), most), hn::Le(hn::Abs(s_out), most)));
  active = hn::And(active, hn::Gt(length, zero));
  // Zero times what is not a number is none: nothing of such lanes may get into a sum.
  s_in = hn::IfThenElseZero(active, s_in);
  s_out = hn::IfThenElseZero(active, s_out);
  length = hn::IfThenElseZero(active, length);
  const MF rising = hn::Ge(s_out, s_in);

  // The piece that the segment begins in: mostly where the last one ended.
  Record range;
  for (;;) {
    range = pieces.template four<0>(piece);
    const VF lower = range.a, upper = range.b;
    const MF above =
        hn::And(active, hn::Or(hn::Gt(s_in, upper), hn::And(rising, hn::Eq(s_in, upper))));
    const MF below =
        hn::And(active, hn::Or(hn::Lt(s_in, lower), hn::AndNot(rising, hn::Eq(s_in, lower))));
    if (HWY_LIKELY(hn::AllFalse(d, hn::Or(above, below)))) break;
    piece = hn::Sub(piece, hn::VecFromMask(du, hn::RebindMask(du, above)));
    piece = hn::Add(piece, hn::VecFromMask(du, hn::RebindMask(du, below)));
  }

  // Scalars are taken from the piece's anchor on: rounding then is a share of the piece, however
  // narrow it is, and no place in it is lost where the ray's part in it is cut.
  const VF way = hn::Abs(hn::Sub(s_out, s_in));
  const VF per_scalar = hn::Min(most, hn::Div(length, way));
  VF anchor = AnchorOf(range);
  VF offset = hn::Sub(s_in, anchor);
  VF bound = hn::IfThenElse(rising, range.b, range.a);
  MF last = hn::Or(hn::And(rising, hn::Le(s_out, bound)), hn::AndNot(rising, hn::Ge(s_out, bound)));
  VF end = hn::IfThenElse(last, s_out, bound);  // of the way in this piece
  VF target = hn::Sub(end, anchor);
  // Of the length, what is in this piece. From the scalars, not from the offsets: those that lie
  // closer together than offsets can tell are apart all the same.
  VF left = hn::IfThenElse(last, length,
                           hn::Min(length, hn::Mul(hn::Abs(hn::Sub(end, s_in)), per_scalar)));
  for (;;) {
    const VF extinction = range.c, slope = range.d;
    const VF front = hn::Max(zero, hn::MulAdd(offset, slope, extinction));
    const VF back = hn::Max(zero, hn::MulAdd(target, slope, extinction));
    const VF half_left = hn::Mul(half, left);
    VF mean = hn::Mul(hn::Add(front, back), half_left);
    VF difference = hn::Mul(hn::Sub(back, front), half_left);
    VF next = target;
    const MF far = hn::And(active, hn::Gt(mean, one));
    const MF deep = hn::And(active, hn::Gt(mean, two));
    const bool any_far = !hn::AllFalse(d, far);
    if (HWY_UNLIKELY(any_far && !hn::AllFalse(d, deep))) {
      // As far as an optical depth of 2: front h + growth h^2 / 2 = 2.
      const VF rate = hn::Div(hn::Sub(target, offset), left);  // of the scalar
      const VF growth = hn::Mul(slope, rate);
      const VF four = hn::Set(d, 4.0f);
      const VF root = hn::Sqrt(hn::Max(zero, hn::MulAdd(front, front, hn::Mul(four, growth))));
      const VF h = hn::Min(left, hn::Div(four, hn::Add(front, root)));
      const VF cut = hn::MulAdd(rate, h, offset);
      const VF bent = hn::Mul(hn::Mul(half, growth), hn::Mul(h, h));
      next = hn::IfThenElse(deep, cut, next);
      mean = hn::IfThenElse(deep, two, mean);
      difference = hn::IfThenElse(deep, hn::Max(hn::Neg(two), hn::Min(two, bent)), difference);
      left = hn::IfThenElse(deep, hn::Sub(left, h), left);
    }
    // Where no lane meets any extinction, as in the clear ranges of most transfer functions, no
    // colour is fetched.
    const MF seen = hn::And(active, hn::Gt(mean, zero));
    if (!hn::AllFalse(d, seen)) {
      const Record color = pieces.template four<1>(piece);
      const Record color_slope = pieces.template four<2>(piece);
      // Which polynomials a lane is given depends on that lane alone: a ray looks the same whatever
      // rays share its packet.
      VF taken = zero, turned = zero;
      if (HWY_LIKELY(!any_far || !hn::AllFalse(d, hn::AndNot(far, active)))) {
        taken = Absorbed(mean);
        turned = Chi(mean, difference);
      }
      if (HWY_UNLIKELY(any_far)) {
        taken = hn::IfThenElse(far, AbsorbedFarther(mean), taken);
        turned = hn::IfThenElse(far, ChiFarther(mean, difference), turned);
      }
      const VF weight = hn::Mul(sums.transmittance, taken);
      const VF turn = hn::Mul(hn::Mul(sums.transmittance, turned), hn::Sub(next, offset));
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

    active = hn::And(active, hn::Or(deep, hn::Not(last)));
    active = hn::And(active, hn::Gt(sums.transmittance, hn::Set(d, kInvisible)));
    if (HWY_LIKELY(hn::AllFalse(d, active))) return;
    const MF moves = hn::AndNot(deep, active);
    const VU stride = hn::IfThenElse(hn::RebindMask(du, rising), one_piece, hn::Set(du, ~0u));
    piece = hn::Add(piece, hn::IfThenElseZero(hn::RebindMask(du, moves), stride));
    range = pieces.template four<0>(piece);
    anchor = AnchorOf(range);
    offset = hn::IfThenElse(moves, hn::Sub(bound, anchor), next);
    const VF begin = bound;
    bound = hn::IfThenElse(rising, range.b, range.a);
    last = hn::Or(hn::And(rising, hn::Le(s_out, bound)), hn::AndNot(rising, hn::Ge(s_out, bound)));
    end = hn::IfThenElse(last, s_out, bound);
    target = hn::Sub(end, anchor);
    left = hn::IfThenElse(moves, hn::Min(length, hn::Mul(hn::Abs(hn::Sub(end, begin)), per_scalar)),
                          left);
  }
}

}  // namespace optics
}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
