// What compositing a volume does with the segments of packets (see PacketWalk). Compiled once for
// each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_LIB_VOLUME_CONSUMER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_LIB_VOLUME_CONSUMER_INL_H_
#undef PLUME_LIB_VOLUME_CONSUMER_INL_H_
#else
#define PLUME_LIB_VOLUME_CONSUMER_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <span>

#include "hwy/highway.h"
#include "plume/lib/volume_packets.h"
#include "plume/preint/closed_form-inl.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

template <class Pieces>
struct VolumeConsumer {
  static constexpr bool kMeasure = true;
  static constexpr bool kByParts = true;

  const PieceTable& table;
  const Pieces& pieces;
  const float* cell_values;  // null where the field is on points
  float enough;              // transmittance at which a ray ends
  std::span<PacketColor> colors;
  struct Lanes {
    HWY_ALIGN float r[kMaxLanes];
    HWY_ALIGN float g[kMaxLanes];
    HWY_ALIGN float b[kMaxLanes];
    HWY_ALIGN float transmittance[kMaxLanes];
    HWY_ALIGN std::uint32_t piece[kMaxLanes];
  };
  Lanes lanes[kMaxPackets] = {};

  void begin(std::size_t packet, std::size_t lane, const PacketStart& start) {
    Lanes& mine = lanes[packet];
    const PacketColor& color = colors[start.ray];
    mine.r[lane] = color.r;
    mine.g[lane] = color.g;
    mine.b[lane] = color.b;
    mine.transmittance[lane] = color.transmittance;
    mine.piece[lane] = static_cast<std::uint32_t>(table.piece_at(start.scalar));
  }

  HWY_INLINE MF visit(std::size_t packet, MF active, VF length, VF s_in, VF s_out, VU cells) {
    take_cell_values(cells, s_in, s_out);
    return composite(packet, [&](VU& piece, optics::Sums& sums) {
      optics::Composite(pieces, s_in, s_out, hn::IfThenElseZero(active, length), piece, sums);
    });
  }

  // Composites no further than a knot of the transfer function. (In a segment a knot is rare, but
  // among sixteen segments it is not, and to go on to the next piece costs the same for one lane.)
  HWY_INLINE VisitedPart visit_part(std::size_t packet, MF active, VF length, VF s_in, VF s_out,
                                    VU cells) {
    take_cell_values(cells, s_in, s_out);
    optics::Course course(s_in, s_out, hn::IfThenElseZero(active, length));
    const MF enough_seen = composite(packet, [&](VU& piece, optics::Sums& sums) {
      const optics::Record range = course.find_piece(pieces, piece);
      optics::CompositePart(pieces, range, course, piece, sums);
    });
    return {enough_seen, hn::AndNot(enough_seen, course.active), course.turned(course.in),
            course.length};
  }

  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    const Lanes& mine = lanes[packet];
    PacketColor& color = colors[start.ray];
    const float transmittance = mine.transmittance[lane];
    color = {mine.r[lane],           mine.g[lane],        mine.b[lane],
             transmittance,          color.cells + cells, z,
             transmittance <= enough};
  }

 private:
  HWY_INLINE void take_cell_values(VU cells, VF& s_in, VF& s_out) const {
    if (cell_values == nullptr) return;
    s_in = hn::GatherIndex(DF(), cell_values, hn::BitCast(hn::RebindToSigned<DU>(), cells));
    s_out = s_in;
  }

  // Those that have seen enough.
  template <class Add>
  HWY_INLINE MF composite(std::size_t packet, const Add& add) {
    const DF d;
    const DU du;
    Lanes& mine = lanes[packet];
    optics::Sums sums{hn::Load(d, mine.r), hn::Load(d, mine.g), hn::Load(d, mine.b),
                      hn::Load(d, mine.transmittance)};
    VU piece = hn::Load(du, mine.piece);
    add(piece, sums);
    hn::Store(sums.r, d, mine.r);
    hn::Store(sums.g, d, mine.g);
    hn::Store(sums.b, d, mine.b);
    hn::Store(sums.transmittance, d, mine.transmittance);
    hn::Store(piece, du, mine.piece);
    return hn::Le(sums.transmittance, hn::Set(d, enough));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
