// Which triangle of a polygon's fan a ray crosses, the fan's triangles side by side in vectors.
// Compiled once for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_FAN_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_FAN_LANES_INL_H_
#undef PLUME_TRAVERSE_FAN_LANES_INL_H_
#else
#define PLUME_TRAVERSE_FAN_LANES_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hwy/highway.h"
#include "plume/traverse/edge_primitives-inl.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/sheared_frame.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// fan_center()
HWY_INLINE void CenterOf(const float (*fan)[4], std::size_t size, float* center) {
  const float count = static_cast<float>(size);
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t a = 0; a < 4; ++a) {
    center[a] = 0;
    for (std::size_t i = 0; i < size; ++i) center[a] += fan[i][a];
    center[a] /= count;
  }
#else
  const hn::FixedTag<float, 4> d4;
  auto sum = hn::Zero(d4);
  for (std::size_t i = 0; i < size; ++i) sum = hn::Add(sum, hn::Load(d4, fan[i]));
  hn::Store(hn::Div(sum, hn::Set(d4, count)), d4, center);
#endif
}

// The triangles of a fan that wind about the ray: three edges of which one or three cross on its
// right.
HWY_INLINE std::uint32_t CrossedTogether(const float (*fan)[4], std::size_t size,
                                         const float* center) {
  const DF d;
  const DU du;
  HWY_ALIGN std::uint32_t pairs[kMaxLanes];
  const auto used = hn::FirstN(du, size);
  const VU number = hn::IfThenElseZero(used, hn::Iota(du, 0));
  hn::Store(hn::ShiftLeft<1>(number), du, pairs);
  const FourFloats to = LoadFour(fan[0], pairs);
  const VU before = hn::IfThenElse(hn::Eq(number, hn::Zero(du)),
                                   hn::Set(du, static_cast<std::uint32_t>(size - 1)),
                                   hn::Sub(number, hn::Set(du, 1)));
  const auto indices = hn::IndicesFromVec(d, before);
  const VF from_x = hn::TableLookupLanes(to.a, indices);
  const VF from_y = hn::TableLookupLanes(to.b, indices);
  const std::uint32_t rim = BitsFrom(CrossesRight(from_x, from_y, to.a, to.b), 0);
  const std::uint32_t spokes =
      BitsFrom(CrossesRight(hn::Set(d, center[0]), hn::Set(d, center[1]), to.a, to.b), 0);
  const std::uint32_t spokes_before = spokes << 1 | (spokes >> (size - 1) & 1);
  return (rim ^ spokes ^ spokes_before) & ((1u << size) - 1);
}

inline HWY_NOINLINE std::uint32_t CrossedInTurn(const float (*fan)[4], std::size_t size,
                                                const float* center) {
  auto point = [](const float* p) { return ShearedPoint{p[0], p[1], p[2], p[3]}; };
  const ShearedPoint middle = point(center);
  ShearedPoint from = point(fan[size - 1]);
  int from_spoke = crossing(middle, from);
  std::uint32_t crossed = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const ShearedPoint to = point(fan[i]);
    const int to_spoke = crossing(middle, to);
    if (from_spoke + crossing(from, to) - to_spoke != 0) crossed |= 1u << i;
    from = to;
    from_spoke = to_spoke;
  }
  return crossed;
}

// Of a polygon's fan, whose corners those are (x, y, z and the scalar of each), the triangle that
// the ray crosses: its rank, and its corners as a quadrilateral's. False where there are several.
template <bool kMeasure>
HWY_INLINE bool CrossFan(const float (*fan)[4], std::size_t size, std::uint32_t& rank,
                         float* corners) {
  HWY_ALIGN float center[4];
  CenterOf(fan, size, center);
  const std::uint32_t crossed = size <= hn::MaxLanes(DF()) ? CrossedTogether(fan, size, center)
                                                           : CrossedInTurn(fan, size, center);
  if (HWY_UNLIKELY((crossed & (crossed - 1)) != 0)) return false;
  rank = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(crossed));
  if constexpr (kMeasure) {
    auto copy = [](const float* from, float* to) { std::memcpy(to, from, 16); };
    copy(center, corners);
    copy(fan[rank == 0 ? size - 1 : rank - 1], corners + 4);
    copy(fan[rank], corners + 8);
    copy(fan[rank], corners + 12);
  }
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
