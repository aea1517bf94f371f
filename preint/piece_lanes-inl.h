// Where the lanes' segments are in a transfer function cut into pieces. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_PREINT_PIECE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_PREINT_PIECE_LANES_INL_H_
#undef PLUME_PREINT_PIECE_LANES_INL_H_
#else
#define PLUME_PREINT_PIECE_LANES_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <limits>
#include <vector>

#include "hwy/highway.h"
#include "plume/preint/absorption-inl.h"
#include "plume/preint/piece_table.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {
namespace optics {

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
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
  return hn::IfNegativeThenElse(range.d, range.b, range.a);
#else
  const VF sign = hn::BitCast(DF(), hn::BroadcastSignBit(hn::BitCast(DI(), range.d)));
  return hn::IfThenElse(hn::MaskFromVec(sign), range.b, range.a);
#endif
}

// What is left of the lanes' segments, along which scalars run linearly. Where they fall, they are
// negated: here all rise.
struct Course {
  MF active;      // lanes of which anything is left
  VF flip;        // the sign where scalars were negated, else 0
  VF in, out;     // scalars at both ends
  VF length;      // of the segment, in world units
  VF per_scalar;  // length

  // `length` >= 0 in world units. Where it is not above 0, or a scalar is no finite number, nothing
  // is left: a length of 0.
  HWY_INLINE Course(VF s_in, VF s_out, VF segment) {
    const DF d;
    const VF zero = hn::Zero(d);
    // Zero times what is not finite is no number, above which nothing is.
    active = hn::Gt(segment, hn::MulAdd(s_out, zero, hn::Mul(s_in, zero)));
    length = hn::IfThenElseZero(active, segment);
    const VF way = hn::Sub(s_out, s_in);
    flip = hn::And(way, hn::SignBit(d));
    in = hn::Xor(s_in, flip);
    out = hn::Xor(s_out, flip);
    per_scalar =
        hn::Min(hn::Div(length, hn::Abs(way)), hn::Set(d, std::numeric_limits<float>::max()));
  }

  // A scalar as it was before it was negated, or the reverse.
  HWY_INLINE VF turned(VF scalar) const { return hn::Xor(scalar, flip); }
  // Where it leaves a piece, and where it comes in.
  HWY_INLINE VF ahead(const Record& range) const {
    return hn::Max(turned(range.a), turned(range.b));
  }
  HWY_INLINE VF behind(const Record& range) const {
    return hn::Min(turned(range.a), turned(range.b));
  }
  // Of the length, what lies before `end`, which is ahead of `in`. From the scalars themselves:
  // those that lie closer together than their distances from an anchor can tell are apart all the
  // same.
  HWY_INLINE VF length_to(VF end) const {
    return hn::IfThenElse(hn::Ge(end, out), length,
                          hn::Min(length, hn::Mul(hn::Sub(end, in), per_scalar)));
  }
  // To the next piece, what lies before `ahead` done, in lanes that reach it.
  HWY_INLINE void Advance(VF ahead, VU& piece) {
    const DU du;
    active = hn::And(active, hn::Gt(out, ahead));
    length = hn::IfThenElseZero(active, hn::Min(length, hn::Mul(hn::Sub(out, ahead), per_scalar)));
    in = ahead;
    piece = hn::Add(piece, hn::IfThenElseZero(hn::RebindMask(du, active), stride()));
  }
  // The piece that it begins in: mostly where the last segment ended, which `piece` says.
  template <class Table>
  HWY_INLINE Record find_piece(const Table& pieces, VU& piece) const {
    const DF d;
    const DU du;
    for (;;) {
      const Record range = pieces.template four<0>(piece);
      const MF beyond = hn::And(active, hn::Ge(in, ahead(range)));
      const MF before = hn::And(active, hn::Lt(in, behind(range)));
      if (HWY_LIKELY(hn::AllFalse(d, hn::Or(beyond, before)))) return range;
      piece = hn::Add(piece, hn::IfThenElseZero(hn::RebindMask(du, beyond), stride()));
      piece = hn::Sub(piece, hn::IfThenElseZero(hn::RebindMask(du, before), stride()));
    }
  }

 private:
  // 1 or -1, from piece to piece.
  HWY_INLINE VU stride() const {
    const DU du;
    return hn::Or(hn::BitCast(du, hn::BroadcastSignBit(hn::BitCast(DI(), flip))), hn::Set(du, 1));
  }
};

}  // namespace optics
}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
