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
#include "plume/lib/composite_by-inl.h"
#include "plume/lib/mode_packets.h"
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
    cell_scalars.replace(cells, s_in, s_out);
    see(packet, hn::Eq(s_out, s_out), s_out);
    return NoLanes();
  }
  template <class Curved>
  HWY_INLINE MF visit_curved(std::size_t packet, MF active, VF, VF, VF s_out,
                             const Curved& scalar) {
    see(packet, hn::And(active, hn::Eq(s_out, s_out)), s_out);
    scalar.ForEachExtremum([&](MF lanes, VF value) { see(packet, hn::And(active, lanes), value); });
    return NoLanes();
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    packets.numbers[start.ray].value = sign * best[packet][lane];
    TakeDown(packets, start, z, cells);
  }

 private:
  HWY_INLINE void see(std::size_t packet, MF lanes, VF scalar) {
    const DF d;
    const VF before = hn::Load(d, best[packet]), value = hn::Mul(scalar, hn::Set(d, sign));
    // Not the instruction for the greater of two, which may take what is no number.
    hn::Store(hn::IfThenElse(hn::And(lanes, hn::Gt(value, before)), value, before), d,
              best[packet]);
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
    add(packet, hn::Mul(hn::Mul(way, hn::Set(d, 0.5f)), hn::Add(s_in, s_out)), way);
    return NoLanes();
  }
  template <class Curved>
  HWY_INLINE MF visit_curved(std::size_t packet, MF active, VF way, VF, VF, const Curved& scalar) {
    const VF mine = hn::IfThenElseZero(active, way);
    add(packet, hn::Mul(mine, scalar.Mean()), mine);
    return NoLanes();
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    PacketNumber& number = packets.numbers[start.ray];
    number.value += integral.sum(packet, lane);
    if constexpr (kLength) number.length += length.sum(packet, lane);
    TakeDown(packets, start, z, cells);
  }

 private:
  HWY_INLINE void add(std::size_t packet, VF part, VF way) {
    const MF known = hn::Eq(part, part);
    integral.add(packet, hn::IfThenElseZero(known, part));
    if constexpr (kLength) length.add(packet, hn::IfThenElseZero(known, way));
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
    cell_scalars.replace(cells, s_in, s_out);
    add(packet, active, s_in, s_out, length);
    return NoLanes();
  }
  template <class Curved>
  HWY_INLINE MF visit_curved(std::size_t packet, MF active, VF length, VF, VF,
                             const Curved& scalar) {
    scalar.ForEachLinearPart(
        active, length, packets.tolerance,
        [&](MF on, VF from, VF to, VF part) { add(packet, on, from, to, part); });
    return NoLanes();
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    packets.numbers[start.ray].value += depth.sum(packet, lane);
    TakeDown(packets, start, z, cells);
  }

 private:
  HWY_INLINE void add(std::size_t packet, MF active, VF s_in, VF s_out, VF length) {
    const DU du;
    VU at = hn::Load(du, piece[packet]);
    optics::AddDepths(pieces, s_in, s_out, hn::IfThenElseZero(active, length), at,
                      [&](VF part) { depth.add(packet, part); });
    hn::Store(at, du, piece[packet]);
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
    cell_scalars.replace(cells, s_in, s_out);
    const unsigned unclear =
        BitsOf(hn::And(active, hn::Not(clear(packet, hn::Min(s_in, s_out), hn::Max(s_in, s_out)))));
    if (HWY_LIKELY(unclear == 0)) return NoLanes();
    return look(packet, unclear, length, s_in, s_out, NoLanes(), nullptr, 0);
  }
  // No place of a segment is farther from its chord than the polynomial bends.
  template <class Curved>
  HWY_INLINE MF visit_curved(std::size_t packet, MF active, VF length, VF s_in, VF s_out,
                             const Curved& scalar) {
    const VF least = hn::Sub(hn::Min(s_in, s_out), scalar.Bend());
    const VF greatest = hn::Add(hn::Max(s_in, s_out), scalar.Bend());
    const unsigned unclear = BitsOf(hn::And(active, hn::Not(clear(packet, least, greatest))));
    if (HWY_LIKELY(unclear == 0)) return NoLanes();
    return look(packet, unclear, length, s_in, s_out, scalar.Curves(), scalar.Inner(),
                Curved::kCount);
  }
  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    TakeDown(packets, start, z, cells, found[packet][lane]);
  }

 private:
  // A segment with a scalar that is no number may be taken for clear: it is transparent.
  HWY_INLINE MF clear(std::size_t packet, VF least, VF greatest) const {
    const DF d;
    const VF from = hn::Load(d, low[packet]), to = hn::Load(d, high[packet]);
    return hn::And(hn::Gt(least, from), hn::Lt(greatest, to));
  }
  void set_clear(std::size_t packet, std::size_t lane, float scalar) {
    const PacketFirst::Clear range = packets.first->around(scalar);
    low[packet][lane] = range.low;
    high[packet][lane] = range.high;
  }
  HWY_NOINLINE MF look(std::size_t packet, unsigned lanes, VF length, VF s_in, VF s_out, MF curved,
                       const VF* inner, std::size_t count) {
    const DF d;
    HWY_ALIGN float way[kMaxLanes], front[kMaxLanes], back[kMaxLanes], ends[kMaxLanes] = {};
    HWY_ALIGN float inside[2][kMaxLanes] = {};
    hn::Store(length, d, way);
    hn::Store(s_in, d, front);
    hn::Store(s_out, d, back);
    for (std::size_t i = 0; i < count; ++i) hn::Store(inner[i], d, inside[i]);
    const unsigned bent = BitsOf(curved);
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes);
      Segment segment{0, way[lane], front[lane], back[lane], 0};
      if ((bent >> lane & 1u) != 0)
        segment.order = count == 1 ? ScalarOrder::quadratic : ScalarOrder::cubic;
      for (std::size_t i = 0; i < count; ++i) segment.inner[i] = inside[i][lane];
      if (packets.first->contributes(rays[packet][lane], z_out[packet][lane], segment)) {
        found[packet][lane] = true;
        ends[lane] = 1;
      } else {
        set_clear(packet, lane, back[lane]);
      }
    }
    return hn::Gt(hn::Load(d, ends), hn::Zero(d));
  }
};

// Calls walk(consumer) with the mode's consumer; without kCells none is for mode cell_count.
template <bool kCells, class Walk>
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
      if constexpr (kCells) by(CellsConsumer{packets});
      break;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
