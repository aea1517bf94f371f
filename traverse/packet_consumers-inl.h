// What is done with the cells that packets meet (see PacketWalk). Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_PACKET_CONSUMERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_PACKET_CONSUMERS_INL_H_
#undef PLUME_TRAVERSE_PACKET_CONSUMERS_INL_H_
#else
#define PLUME_TRAVERSE_PACKET_CONSUMERS_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "hwy/highway.h"
#include "plume/traverse/packet_walk-inl.h"
#include "plume/traverse/packets.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Counts steps, and nothing else.
struct CountConsumer {
  static constexpr bool kMeasure = false;

  std::span<std::uint32_t> counts;

  void begin(std::size_t, std::size_t, const PacketStart&) {}
  void end(std::size_t, std::size_t, const PacketStart& start, float, std::uint32_t cells) {
    counts[start.ray] += cells;
  }
};

struct IntegralConsumer {
  static constexpr bool kMeasure = true;

  std::span<PacketIntegral> sums;
  HWY_ALIGN float lengths[kMaxPackets][kMaxLanes] = {};
  HWY_ALIGN float integrals[kMaxPackets][kMaxLanes] = {};

  void begin(std::size_t packet, std::size_t lane, const PacketStart&) {
    lengths[packet][lane] = integrals[packet][lane] = 0;
  }
  HWY_INLINE MF visit(std::size_t packet, MF /*active*/, VF length, VF s_in, VF s_out, VU) {
    const DF d;
    const VF half = hn::Mul(length, hn::Set(d, 0.5f));
    hn::Store(hn::Add(hn::Load(d, lengths[packet]), length), d, lengths[packet]);
    hn::Store(hn::MulAdd(half, hn::Add(s_in, s_out), hn::Load(d, integrals[packet])), d,
              integrals[packet]);
    return hn::MaskFromVec(hn::Zero(d));
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float,
           std::uint32_t cells) {
    PacketIntegral& sum = sums[start.ray];
    sum.length += lengths[packet][lane];
    sum.integral += integrals[packet][lane];
    sum.cells += cells;
  }
};

struct IsosurfaceConsumer {
  static constexpr bool kMeasure = true;

  const float isovalue;
  std::span<PacketHit> hits;
  HWY_ALIGN float travelled[kMaxPackets][kMaxLanes] = {};
  HWY_ALIGN float distances[kMaxPackets][kMaxLanes] = {};

  void begin(std::size_t packet, std::size_t lane, const PacketStart&) {
    travelled[packet][lane] = 0;
    distances[packet][lane] = std::numeric_limits<float>::infinity();
  }
  HWY_INLINE MF visit(std::size_t packet, MF active, VF length, VF s_in, VF s_out, VU) {
    const DF d;
    const VF value = hn::Set(d, isovalue);
    const VF front = hn::Sub(s_in, value), back = hn::Sub(s_out, value);
    const VF way = hn::Load(d, travelled[packet]);
    const MF hit = hn::And(active, MaskOfBits(hn::Xor(front, back)));
    if (HWY_UNLIKELY(!hn::AllFalse(d, hit))) {
      const VF share = hn::Div(front, hn::Sub(front, back));
      const VF place = hn::MulAdd(length, share, way);
      hn::Store(hn::IfThenElse(hit, place, hn::Load(d, distances[packet])), d, distances[packet]);
    }
    hn::Store(hn::Add(way, length), d, travelled[packet]);
    return hit;
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float,
           std::uint32_t cells) {
    hits[start.ray].distance = distances[packet][lane];
    hits[start.ray].cells += cells;
  }
};

struct SegmentConsumer {
  static constexpr bool kMeasure = true;

  PacketSegmentSink& sink;
  std::uint32_t rays[kMaxPackets][kMaxLanes] = {};

  void begin(std::size_t packet, std::size_t lane, const PacketStart& start) {
    rays[packet][lane] = start.ray;
  }
  MF visit(std::size_t packet, MF active, VF length, VF s_in, VF s_out, VU cells) {
    const DF d;
    HWY_ALIGN float lengths[kMaxLanes], front[kMaxLanes], back[kMaxLanes];
    HWY_ALIGN std::uint32_t cell[kMaxLanes], on[kMaxLanes];
    hn::Store(length, d, lengths);
    hn::Store(s_in, d, front);
    hn::Store(s_out, d, back);
    hn::Store(cells, DU(), cell);
    hn::Store(hn::VecFromMask(DU(), hn::RebindMask(DU(), active)), DU(), on);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
      if (on[lane] != 0)
        sink.take({rays[packet][lane], cell[lane], lengths[lane], front[lane], back[lane]});
    return hn::MaskFromVec(hn::Zero(d));
  }
  void end(std::size_t, std::size_t, const PacketStart&, float, std::uint32_t) {}
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
