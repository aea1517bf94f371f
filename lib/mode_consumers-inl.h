// What the modes that show one number a ray do with the segments of packets (see PacketWalk).
// Compiled once for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_LIB_MODE_CONSUMERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_LIB_MODE_CONSUMERS_INL_H_
#undef PLUME_LIB_MODE_CONSUMERS_INL_H_
#else
#define PLUME_LIB_MODE_CONSUMERS_INL_H_
#endif
// clang-format on

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "hwy/highway.h"
#include "plume/lib/mode_packets.h"
#include "plume/lib/piece_tables-inl.h"
#include "plume/preint/optical_depth-inl.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// The scalar of cells in which it is constant, where it is that.
class CellScalars {
 public:
  explicit CellScalars(const std::vector<float>& values)
      : values_(values.empty() ? nullptr : values.data()) {}

  HWY_INLINE void replace(VU cells, VF& s_in, VF& s_out) const {
    if (values_ == nullptr) return;
    s_in = hn::GatherIndex(DF(), values_, hn::BitCast(hn::RebindToSigned<DU>(), cells));
    s_out = s_in;
  }
  bool any() const { return values_ != nullptr; }

 private:
  const float* values_;
};

// A sum a lane and all that rounding took from it: Knuth's two-sum. A sum that is not finite stays
// what it would be by itself.
struct LaneSums {
  HWY_ALIGN float high[kMaxPackets][kMaxLanes] = {};
  HWY_ALIGN float low[kMaxPackets][kMaxLanes] = {};

  void clear(std::size_t packet, std::size_t lane) { high[packet][lane] = low[packet][lane] = 0; }
  HWY_INLINE void add(std::size_t packet, VF value) {
    const DF d;
    const VF before = hn::Load(d, high[packet]);
    const VF after = hn::Add(before, value);
    const VF added = hn::Sub(after, before);
    const VF lost = hn::Add(hn::Sub(before, hn::Sub(after, added)), hn::Sub(value, added));
    hn::Store(after, d, high[packet]);
    hn::Store(hn::Add(hn::Load(d, low[packet]), lost), d, low[packet]);
  }
  double sum(std::size_t packet, std::size_t lane) const {
    const double sum = high[packet][lane];
    return std::isfinite(sum) ? sum + low[packet][lane] : sum;
  }
};

HWY_INLINE MF NoLanes() { return hn::MaskFromVec(hn::Zero(DF())); }

HWY_INLINE void TakeDown(const ModePackets& packets, const PacketStart& start, float z,
                         std::uint32_t cells, bool stopped = false) {
  PacketColor& color = packets.colors[start.ray];
  color.cells += cells;
  color.z = z;
  color.opaque = stopped;
}

// Cells; the walk measures where a ray leaves, as the next passage is not to begin before.
struct CellsConsumer {
  static constexpr bool kMeasure = true;

  const ModePackets& packets;

  void begin(std::size_t, std::size_t, const PacketStart&) {}
  HWY_INLINE MF visit(std::size_t, MF, VF, VF, VF, VU) { return NoLanes(); }
  void end(std::size_t, std::size_t, const PacketStart& start, float z, std::uint32_t cells) {
    TakeDown(packets, start, z, cells);
  }
};

// The greatest scalar, or the least, which is the greatest of those turned around.
struct ExtremeConsumer {
  static constexpr bool kMeasure = true;

  const ModePackets& packets;
  const CellScalars cell_scalars;
  const float sign;
  HWY_ALIGN float best[kMaxPackets][kMaxLanes];

  ExtremeConsumer(const ModePackets& all, const std::vector<float>& cell_values)
      : packets(all), cell_scalars(cell_values), sign(all.mode == Mode::minimum ? -1.0f : 1.0f) {
    for (auto& lanes : best)
      for (float& lane : lanes) lane = -std::numeric_limits<float>::infinity();
  }

  void begin(std::size_t packet, std::size_t lane, const PacketStart& start) {
    float& mine = best[packet][lane];
    mine = sign * static_cast<float>(packets.numbers[start.ray].value);
    if (!cell_scalars.any() && sign * start.scalar > mine) mine = sign * start.scalar;
  }
  // What a segment begins with, the one before ends with, or begin() has seen.
  HWY_INLINE MF visit(std::size_t packet, MF, VF, VF s_in, VF s_out, VU cells) {
    const DF d;
    cell_scalars.replace(cells, s_in, s_out);
    const VF before = hn::Load(d, best[packet]), value = hn::Mul(s_out, hn::Set(d, sign));
    // Not the instruction for the greater of two, which takes what is no number.
    hn::Store(hn::IfThenElse(hn::Gt(value, before), value, before), d, best[packet]);
    return NoLanes();
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    packets.numbers[start.ray].value = sign * best[packet][lane];
    TakeDown(packets, start, z, cells);
  }
};

// The integral of the scalar, and the length over which it is known where that is asked for.
template <bool kLength>
struct ScalarSumConsumer {
  static constexpr bool kMeasure = true;

  const ModePackets& packets;
  const CellScalars cell_scalars;
  LaneSums integral, length;

  ScalarSumConsumer(const ModePackets& all, const std::vector<float>& cell_values)
      : packets(all), cell_scalars(cell_values) {}

  void begin(std::size_t packet, std::size_t lane, const PacketStart&) {
    integral.clear(packet, lane);
    if constexpr (kLength) length.clear(packet, lane);
  }
  HWY_INLINE MF visit(std::size_t packet, MF, VF way, VF s_in, VF s_out, VU cells) {
    const DF d;
    cell_scalars.replace(cells, s_in, s_out);
    const VF part = hn::Mul(hn::Mul(way, hn::Set(d, 0.5f)), hn::Add(s_in, s_out));
    const MF known = hn::Eq(part, part);
    integral.add(packet, hn::IfThenElseZero(known, part));
    if constexpr (kLength) length.add(packet, hn::IfThenElseZero(known, way));
    return NoLanes();
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    PacketNumber& number = packets.numbers[start.ray];
    number.value += integral.sum(packet, lane);
    if constexpr (kLength) number.length += length.sum(packet, lane);
    TakeDown(packets, start, z, cells);
  }
};

template <class Pieces>
struct DepthSumConsumer {
  static constexpr bool kMeasure = true;

  const ModePackets& packets;
  const Pieces& pieces;
  const CellScalars cell_scalars;
  LaneSums depth;
  HWY_ALIGN std::uint32_t piece[kMaxPackets][kMaxLanes] = {};

  DepthSumConsumer(const ModePackets& all, const Pieces& table,
                   const std::vector<float>& cell_values)
      : packets(all), pieces(table), cell_scalars(cell_values) {}

  void begin(std::size_t packet, std::size_t lane, const PacketStart&) {
    depth.clear(packet, lane);
  }
  HWY_INLINE MF visit(std::size_t packet, MF active, VF length, VF s_in, VF s_out, VU cells) {
    const DU du;
    cell_scalars.replace(cells, s_in, s_out);
    VU at = hn::Load(du, piece[packet]);
    optics::AddDepths(pieces, active, s_in, s_out, length, at,
                      [&](VF part) { depth.add(packet, part); });
    hn::Store(at, du, piece[packet]);
    return NoLanes();
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    packets.numbers[start.ray].value += depth.sum(packet, lane);
    TakeDown(packets, start, z, cells);
  }
};

// As long as a lane's scalar stays between the same two that are not transparent, that is all
// there is to look at.
struct FirstConsumer {
  static constexpr bool kMeasure = true;

  const ModePackets& packets;
  const CellScalars cell_scalars;
  HWY_ALIGN float low[kMaxPackets][kMaxLanes] = {};
  HWY_ALIGN float high[kMaxPackets][kMaxLanes] = {};
  HWY_ALIGN float z_out[kMaxPackets][kMaxLanes] = {};
  std::uint32_t rays[kMaxPackets][kMaxLanes] = {};
  bool found[kMaxPackets][kMaxLanes] = {};

  FirstConsumer(const ModePackets& all, const std::vector<float>& cell_values)
      : packets(all), cell_scalars(cell_values) {}

  void begin(std::size_t packet, std::size_t lane, const PacketStart& start) {
    set_clear(packet, lane, start.scalar);
    rays[packet][lane] = start.ray;
    found[packet][lane] = false;
  }
  HWY_INLINE void ends_at(std::size_t packet, VF z) { hn::Store(z, DF(), z_out[packet]); }
  HWY_INLINE MF visit(std::size_t packet, MF active, VF length, VF s_in, VF s_out, VU cells) {
    const DF d;
    cell_scalars.replace(cells, s_in, s_out);
    const VF from = hn::Load(d, low[packet]), to = hn::Load(d, high[packet]);
    const MF clear = hn::And(hn::And(hn::Gt(s_in, from), hn::Lt(s_in, to)),
                             hn::And(hn::Gt(s_out, from), hn::Lt(s_out, to)));
    const unsigned unclear = BitsOf(hn::AndNot(clear, active));
    if (HWY_LIKELY(unclear == 0)) return NoLanes();
    return look(packet, unclear, length, s_in, s_out);
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    TakeDown(packets, start, z, cells, found[packet][lane]);
  }

 private:
  void set_clear(std::size_t packet, std::size_t lane, float scalar) {
    const PacketFirst::Clear clear = packets.first->around(scalar);
    low[packet][lane] = clear.low;
    high[packet][lane] = clear.high;
  }
  HWY_NOINLINE MF look(std::size_t packet, unsigned lanes, VF length, VF s_in, VF s_out) {
    const DF d;
    HWY_ALIGN float way[kMaxLanes], front[kMaxLanes], back[kMaxLanes], ends[kMaxLanes] = {};
    hn::Store(length, d, way);
    hn::Store(s_in, d, front);
    hn::Store(s_out, d, back);
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes);
      if (packets.first->contributes(rays[packet][lane], z_out[packet][lane], way[lane],
                                     front[lane], back[lane])) {
        found[packet][lane] = true;
        ends[lane] = 1;
      } else {
        set_clear(packet, lane, back[lane]);
      }
    }
    return hn::Gt(hn::Load(d, ends), hn::Zero(d));
  }
};

// Calls walk(consumer) with the mode's consumer.
template <class Walk>
void ReduceBy(const ModePackets& packets, const std::vector<float>& cell_values, const Walk& walk) {
  auto by = [&](auto consumer) { walk(consumer); };
  switch (packets.mode) {
    case Mode::volume:
      break;
    case Mode::maximum:
    case Mode::minimum:
      return by(ExtremeConsumer(packets, cell_values));
    case Mode::average:
      return by(ScalarSumConsumer<true>(packets, cell_values));
    case Mode::integral:
      return by(ScalarSumConsumer<false>(packets, cell_values));
    case Mode::optical_depth:
      return WithTable(packets.extinction->pieces, [&](const auto& table) {
        by(DepthSumConsumer<std::decay_t<decltype(table)>>(packets, table, cell_values));
      });
    case Mode::depth:
      return by(FirstConsumer(packets, cell_values));
    case Mode::cell_count:
      return by(CellsConsumer{packets});
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
