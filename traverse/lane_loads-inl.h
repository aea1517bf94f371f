// What the lanes of a packet fetch from memory, each from a place of its own. Compiled once for
// each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_LANE_LOADS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_LANE_LOADS_INL_H_
#undef PLUME_TRAVERSE_LANE_LOADS_INL_H_
#else
#define PLUME_TRAVERSE_LANE_LOADS_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hwy/cache_control.h"
#include "hwy/highway.h"
#include "plume/mesh/walkable_tets.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DF = HWY_CAPPED(float, 16);
using DU = hn::RebindToUnsigned<DF>;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using MF = hn::Mask<DF>;

constexpr std::size_t kMaxLanes = 16;

// A bit of each lane: the sign of a float, whatever number it is.
HWY_INLINE MF MaskOfBits(VF bits) {
#if HWY_TARGET <= HWY_AVX3
  return hn::MaskFromVec(bits);  // an instruction that looks at signs alone
#else
  const DF d;
  return hn::MaskFromVec(
      hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(hn::RebindToSigned<DF>(), bits))));
#endif
}
// bit ? yes : no
HWY_INLINE VF Choose(VF bits, VF yes, VF no) {
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86
  return hn::IfNegativeThenElse(bits, yes, no);  // an instruction of its own, which looks at signs
#else
  return hn::IfThenElse(MaskOfBits(bits), yes, no);
#endif
}
HWY_INLINE VU Choose(VF bits, VU yes, VU no) {
  const DF d;
  return hn::BitCast(DU(), Choose(bits, hn::BitCast(d, yes), hn::BitCast(d, no)));
}

// Four floats that lie together in memory, a lane each.
struct FourFloats {
  VF a, b, c, d;
};

// Neighbour and apex behind a face.
struct Links {
  VU cell, apex;
};

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE FourFloats LoadFour(const float* HWY_RESTRICT base, const std::uint32_t* pairs) {
  const DF d;
  const float* const p = base + 2 * static_cast<std::size_t>(pairs[0]);
  return {hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2]), hn::Set(d, p[3])};
}

#else

// Two numbers that lie together, by one load: loads are what a step has most of.
struct TwoNumbers {
  std::size_t first, second;
};
HWY_INLINE TwoNumbers LoadTwo(const std::uint32_t* numbers) {
  std::uint64_t both;
  std::memcpy(&both, numbers, sizeof(both));
  return {static_cast<std::uint32_t>(both), both >> 32};
}

#if HWY_TARGET <= HWY_AVX3

// Rows 0 and 1 of the transposition, or 2 and 3: what lanes 0, 4, 8 and 12 (counted from `pairs`)
// load, and what those after them do. Each load blends itself in: no instruction of its own.
// (Functions, not lambdas: what GCC does not inline costs more than all else here.)
struct TwoRows {
  VF first, second;
};
HWY_INLINE VF LoadRow(const float* HWY_RESTRICT base, std::size_t p0, std::size_t p1,
                      std::size_t p2, std::size_t p3) {
  __m512 lanes = _mm512_castps128_ps512(_mm_loadu_ps(base + 2 * p0));
  lanes = _mm512_mask_broadcast_f32x4(lanes, 0x00F0, _mm_loadu_ps(base + 2 * p1));
  lanes = _mm512_mask_broadcast_f32x4(lanes, 0x0F00, _mm_loadu_ps(base + 2 * p2));
  return VF{_mm512_mask_broadcast_f32x4(lanes, 0xF000, _mm_loadu_ps(base + 2 * p3))};
}
HWY_INLINE TwoRows LoadTwoRows(const float* HWY_RESTRICT base, const std::uint32_t* pairs) {
  const TwoNumbers n0 = LoadTwo(pairs), n1 = LoadTwo(pairs + 4);
  const TwoNumbers n2 = LoadTwo(pairs + 8), n3 = LoadTwo(pairs + 12);
  return {LoadRow(base, n0.first, n1.first, n2.first, n3.first),
          LoadRow(base, n0.second, n1.second, n2.second, n3.second)};
}

#else

// Blocks of four floats, side by side.
template <class D>
HWY_INLINE hn::Vec<D> LoadBlocks(D d, const float* HWY_RESTRICT base, const std::size_t* pairs) {
  if constexpr (hn::MaxLanes(D()) <= 4) {
    return hn::LoadU(d, base + 2 * pairs[0]);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, LoadBlocks(half, base, pairs + hn::MaxLanes(half) / 4),
                       LoadBlocks(half, base, pairs));
  }
}
struct TwoRows {
  VF first, second;
};
HWY_INLINE TwoRows LoadTwoRows(const float* HWY_RESTRICT base, const std::uint32_t* pairs) {
  constexpr std::size_t kBlocks = hn::MaxLanes(DF()) / 4;
  std::size_t first[kBlocks], second[kBlocks];
  for (std::size_t block = 0; block < kBlocks; ++block) {
    const TwoNumbers two = LoadTwo(pairs + 4 * block);
    first[block] = two.first;
    second[block] = two.second;
  }
  return {LoadBlocks(DF(), base, first), LoadBlocks(DF(), base, second)};
}

#endif

// Rows of blocks of four floats become columns: block b of `p0` to `p3` has what lanes 4 b to
// 4 b + 3 are given.
HWY_INLINE FourFloats Transpose(VF p0, VF p1, VF p2, VF p3) {
  const DF d;
  const hn::Repartition<std::uint64_t, DF> d64;
  const auto ab01 = hn::BitCast(d64, hn::InterleaveLower(d, p0, p1));
  const auto ab23 = hn::BitCast(d64, hn::InterleaveLower(d, p2, p3));
  const auto cd01 = hn::BitCast(d64, hn::InterleaveUpper(d, p0, p1));
  const auto cd23 = hn::BitCast(d64, hn::InterleaveUpper(d, p2, p3));
  return {hn::BitCast(d, hn::InterleaveLower(d64, ab01, ab23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, ab01, ab23)),
          hn::BitCast(d, hn::InterleaveLower(d64, cd01, cd23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, cd01, cd23))};
}

// The four floats at base + 2 * pairs[lane] (x86 scales an index by 8 bytes at the most, so that
// one in steps of 16 would take a shift for each lane): one 16-byte load a lane, then a
// transposition within blocks of four lanes. On x86 that is faster than four gathers.
HWY_INLINE FourFloats LoadFour(const float* HWY_RESTRICT base, const std::uint32_t* pairs) {
  const auto [p0, p1] = LoadTwoRows(base, pairs);
  const auto [p2, p3] = LoadTwoRows(base, pairs + 2);
  return Transpose(p0, p1, p2, p3);
}

#endif  // HWY_TARGET == HWY_SCALAR

// The links of the lanes' cells, of which each lane picks one: that of a face's rank. `cells_by_4`
// are four times the cells' numbers. LanesLinks are for cells that caches hold, LinkEach for those
// that they do not: where it makes no difference they are the same.
#if HWY_TARGET == HWY_SCALAR

class LanesLinks {
 public:
  LanesLinks(const WalkableTets::Cell* HWY_RESTRICT cells, const std::uint32_t* cells_by_4)
      : cell_(cells[cells_by_4[0] / 4]) {}
  HWY_INLINE Links pick(VU rank) const {
    const WalkableTets::Link& link = cell_[hn::GetLane(rank)];
    return {hn::Set(DU(), link.cell), hn::Set(DU(), link.apex)};
  }

 private:
  const WalkableTets::Cell& cell_;
};
using LinkEach = LanesLinks;

#else

#if HWY_TARGET <= HWY_AVX3

// Whole cells are loaded as soon as their numbers are known, and the links permuted once the ranks
// are: the loads are out of the way by then.
class LanesLinks {
 public:
  HWY_INLINE LanesLinks(const WalkableTets::Cell* HWY_RESTRICT cells,
                        const std::uint32_t* cells_by_4) {
    static_assert(sizeof(WalkableTets::Cell) == 32);
    const auto* const links = reinterpret_cast<const std::uint64_t*>(cells);
    auto load = [&](std::size_t cell_by_4) {
      return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(links + cell_by_4));
    };
    for (std::size_t i = 0; i < 8; ++i) {
      const TwoNumbers cell = LoadTwo(cells_by_4 + 2 * i);
      pairs_[i] = _mm512_mask_broadcast_i64x4(_mm512_castsi256_si512(load(cell.first)), 0xF0,
                                              load(cell.second));
    }
  }
  HWY_INLINE Links pick(VU rank) const {
    // Two pairs of cells are a table of 16 links. (The forms with an all-true mask are the plain
    // ones, without GCC 12's false alarm about uninitialised memory in them.)
    const __m512i place = _mm512_add_epi32(rank.raw, _mm512_set4_epi32(12, 8, 4, 0));
    const __m512i low =
        _mm512_maskz_cvtepu32_epi64(0xFF, _mm512_maskz_extracti64x4_epi64(0x0F, place, 0));
    const __m512i high =
        _mm512_maskz_cvtepu32_epi64(0xFF, _mm512_maskz_extracti64x4_epi64(0x0F, place, 1));
    auto from = [&](std::size_t pair, __m512i places) {
      return _mm512_permutex2var_epi64(pairs_[pair], places, pairs_[pair + 1]);
    };
    const __m512i first = _mm512_mask_mov_epi64(from(0, low), 0xF0, from(2, low));
    const __m512i last = _mm512_mask_mov_epi64(from(4, high), 0xF0, from(6, high));
    const DU du;
    return {hn::ConcatEven(du, VU{last}, VU{first}), hn::ConcatOdd(du, VU{last}, VU{first})};
  }

 private:
  __m512i pairs_[8];
};

#endif

// The links of these numbers side by side.
template <class D>
HWY_INLINE hn::Vec<D> LoadEach(D d, const std::uint64_t* HWY_RESTRICT links,
                               const std::uint32_t* HWY_RESTRICT numbers) {
  if constexpr (hn::MaxLanes(D()) == 2) {
    const TwoNumbers two = LoadTwo(numbers);
    const hn::Half<D> half;
    return hn::Combine(d, hn::LoadU(half, links + two.second), hn::LoadU(half, links + two.first));
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, LoadEach(half, links, numbers + hn::MaxLanes(half)),
                       LoadEach(half, links, numbers));
  }
}

// One load of 8 bytes a lane, once the rank is known.
class LinkEach {
 public:
  HWY_INLINE LinkEach(const WalkableTets::Cell* HWY_RESTRICT cells, const std::uint32_t* cells_by_4)
      : links_(reinterpret_cast<const std::uint64_t*>(cells)), cells_by_4_(cells_by_4) {
    static_assert(sizeof(WalkableTets::Link) == sizeof(std::uint64_t));
  }
  HWY_INLINE Links pick(VU rank) const {
    const DU du;
    const hn::Repartition<std::uint64_t, DU> d64;
    HWY_ALIGN std::uint32_t numbers[kMaxLanes];
    hn::Store(hn::Add(hn::Load(du, cells_by_4_), rank), du, numbers);
    const VU first = hn::BitCast(du, LoadEach(d64, links_, numbers));
    const VU last = hn::BitCast(du, LoadEach(d64, links_, numbers + hn::MaxLanes(d64)));
    return {hn::ConcatEven(du, last, first), hn::ConcatOdd(du, last, first)};
  }

 private:
  const std::uint64_t* links_;
  const std::uint32_t* cells_by_4_;
};

#if HWY_TARGET > HWY_AVX3
using LanesLinks = LinkEach;
#endif

#endif  // HWY_TARGET == HWY_SCALAR

// Asks for what lies at base + 2 * pairs[lane].
HWY_INLINE void Prefetch(const float* base, const std::uint32_t* pairs) {
#if HWY_TARGET == HWY_SCALAR
  hwy::Prefetch(base + 2 * static_cast<std::size_t>(pairs[0]));
#else
  for (std::size_t lane = 0; lane < hn::Lanes(DF()); lane += 2) {
    const TwoNumbers two = LoadTwo(pairs + lane);
    hwy::Prefetch(base + 2 * two.first);
    hwy::Prefetch(base + 2 * two.second);
  }
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
