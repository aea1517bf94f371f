// A cell's corners and edges side by side in vectors: what their decisions are made of. Compiled
// once for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_EDGE_PRIMITIVES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_EDGE_PRIMITIVES_INL_H_
#undef PLUME_TRAVERSE_EDGE_PRIMITIVES_INL_H_
#else
#define PLUME_TRAVERSE_EDGE_PRIMITIVES_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
template <class D>
HWY_INLINE std::uint32_t XorOfLanes(D /*d*/, hn::Vec<D> v) {
  return hn::GetLane(v);
}
#else
template <class D>
HWY_INLINE std::uint32_t XorOfLanes(D /*d*/, hn::Vec<D> v) {
  if constexpr (hn::MaxLanes(D()) > 4) {
    const hn::Half<D> half;
    return XorOfLanes(half, hn::Xor(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
  } else {
    v = hn::Xor(v, hn::Shuffle1032(v));
    return hn::GetLane(hn::Xor(v, hn::Shuffle2301(v)));
  }
}
#endif

// A bit for each lane, moved up to where the lanes are.
HWY_INLINE std::uint32_t BitsFrom(MF mask, std::size_t at) {
#if HWY_TARGET <= HWY_AVX3
  return static_cast<std::uint32_t>(mask.raw) << at;
#else
  return static_cast<std::uint32_t>(BitsOf(mask)) << at;
#endif
}

// A ray in a cell.
struct EdgeRay {
  // x, y, 0, 0 of what ShearedFrame subtracts, so that a point's z and scalar stay as they are.
  HWY_ALIGN float offset[4];
  HWY_ALIGN float slope[4];
  const ShearedFrame* frame;

  void put(const ShearedFrame& of) {
    const ShearedFrame::Line line = of.line();
    offset[0] = line.offset_x;
    offset[1] = line.offset_y;
    slope[0] = line.slope_x;
    slope[1] = line.slope_y;
    offset[2] = offset[3] = slope[2] = slope[3] = 0;
    frame = &of;
  }
};

// The sheared corners of a cell, to be looked up by their numbers.
struct CornerTable {
  HWY_ALIGN float x[kMostEdgeCellCorners];
  HWY_ALIGN float y[kMostEdgeCellCorners];

  // Those of several numbers, of which no more than the lowest five bits count.
  HWY_INLINE void Get(VU numbers, VF& at_x, VF& at_y) const {
    const DF d;
#if HWY_TARGET <= HWY_AVX3
    at_x = VF{_mm512_permutex2var_ps(hn::Load(d, x).raw, numbers.raw, hn::Load(d, x + 16).raw)};
    at_y = VF{_mm512_permutex2var_ps(hn::Load(d, y).raw, numbers.raw, hn::Load(d, y + 16).raw)};
#else
    const auto at = hn::BitCast(hn::RebindToSigned<DF>(), hn::And(numbers, hn::Set(DU(), 31)));
    at_x = hn::GatherIndex(d, x, at);
    at_y = hn::GatherIndex(d, y, at);
#endif
  }
};

// The floats at base + 2 * pairs[i], i below `count`, a multiple of four; something in the lanes
// beyond. The fourth ones are left out.
HWY_INLINE FourFloats LoadCorners(const float* HWY_RESTRICT base, const std::uint32_t* pairs,
                                  std::size_t count) {
#if HWY_TARGET <= HWY_AVX3
  const std::uint32_t* const second = count > 4 ? pairs + 4 : pairs;
  const std::uint32_t* const third = count > 8 ? pairs + 8 : pairs;
  const std::uint32_t* const fourth = count > 12 ? pairs + 12 : pairs;
  auto row = [&](std::size_t i) {
    auto load = [&](const std::uint32_t* from) {
      return _mm_loadu_ps(base + 2 * static_cast<std::size_t>(from[i]));
    };
    __m512 lanes = _mm512_castps128_ps512(load(pairs));
    lanes = _mm512_mask_broadcast_f32x4(lanes, 0x00F0, load(second));
    lanes = _mm512_mask_broadcast_f32x4(lanes, 0x0F00, load(third));
    return VF{_mm512_mask_broadcast_f32x4(lanes, 0xF000, load(fourth))};
  };
  FourFloats corners = Transpose(row(0), row(1), row(2), row(3));
  corners.d = hn::Zero(DF());
  return corners;
#else
  const DU du;
  HWY_ALIGN std::uint32_t used[kMaxLanes];
  hn::Store(hn::IfThenElseZero(hn::FirstN(du, count), hn::LoadU(du, pairs)), du, used);
  return LoadFour(base, used);
#endif
}

// Where edges cross y = 0 on the ray's right, whichever way they go: crossing() is not 0.
HWY_INLINE MF CrossesRight(VF ax, VF ay, VF bx, VF by) {
  const VF zero = hn::Zero(DF());
  const VF forth = hn::Mul(ax, by), back = hn::Mul(bx, ay);
#if HWY_TARGET <= HWY_AVX3
  // Each comparison takes the one before as its mask.
  __mmask16 rises = _mm512_cmp_ps_mask(ay.raw, zero.raw, _CMP_LT_OQ);
  __mmask16 falls = _mm512_cmp_ps_mask(by.raw, zero.raw, _CMP_LT_OQ);
  rises = _mm512_mask_cmp_ps_mask(rises, by.raw, zero.raw, _CMP_GE_OQ);
  falls = _mm512_mask_cmp_ps_mask(falls, ay.raw, zero.raw, _CMP_GE_OQ);
  rises = _mm512_mask_cmp_ps_mask(rises, forth.raw, back.raw, _CMP_GT_OQ);
  falls = _mm512_mask_cmp_ps_mask(falls, back.raw, forth.raw, _CMP_GT_OQ);
  return MF{static_cast<__mmask16>(rises | falls)};
#else
  const MF a_up = hn::Ge(ay, zero), b_up = hn::Ge(by, zero);
  return hn::Or(hn::And(hn::AndNot(a_up, b_up), hn::Gt(forth, back)),
                hn::And(hn::AndNot(b_up, a_up), hn::Gt(back, forth)));
#endif
}

// The two faces at an edge, a bit each.
HWY_INLINE VU FacesOf(VU edge) {
#if HWY_TARGET <= HWY_AVX3
  // A rotation takes no more than the lowest five bits of a number.
  // (With an all-true mask, as in lane_loads-inl.h.)
  const __m512i one = _mm512_set1_epi32(1);
  const __m512i face = hn::ShiftRight<16>(edge).raw, other = hn::ShiftRight<24>(edge).raw;
  return hn::Xor(VU{_mm512_maskz_rolv_epi32(0xFFFF, one, face)},
                 VU{_mm512_maskz_rolv_epi32(0xFFFF, one, other)});
#else
  const VU one = hn::Set(DU(), 1);
  const VU face = hn::And(hn::ShiftRight<16>(edge), hn::Set(DU(), 31));
  return hn::Xor(hn::Shl(one, face), hn::Shl(one, hn::ShiftRight<24>(edge)));
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
