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
    OpenLanes mine(lanes[packet]);
    optics::Composite(pieces, s_in, s_out, hn::IfThenElseZero(active, length), mine.piece,
                      mine.sums);
    return mine.close(enough);
  }

  // Composites no further than a knot of the transfer function. (In a segment a knot is rare, but
  // among sixteen segments it is not, and to go on to the next piece costs the same for one lane.)
  HWY_INLINE VisitedPart visit_part(std::size_t packet, MF active, VF length, VF s_in, VF s_out,
                                    VU cells) {
    take_cell_values(cells, s_in, s_out);
    OpenLanes mine(lanes[packet]);
    optics::Course course(s_in, s_out, hn::IfThenElseZero(active, length));
    const optics::Record range = course.find_piece(pieces, mine.piece);
    optics::CompositePart(pieces, range, course, mine.piece, mine.sums);
    const MF enough_seen = mine.close(enough);
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

  // A packet's lanes in registers.
  struct OpenLanes {
    Lanes& lanes;
    optics::Sums sums;
    VU piece;

    HWY_INLINE explicit OpenLanes(Lanes& from)
        : lanes(from),
          sums{hn::Load(DF(), from.r), hn::Load(DF(), from.g), hn::Load(DF(), from.b),
               hn::Load(DF(), from.transmittance)},
          piece(hn::Load(DU(), from.piece)) {}
    // Returns those that have seen enough.
    HWY_INLINE MF close(float enough) const {
      const DF d;
      hn::Store(sums.r, d, lanes.r);
      hn::Store(sums.g, d, lanes.g);
      hn::Store(sums.b, d, lanes.b);
      hn::Store(sums.transmittance, d, lanes.transmittance);
      hn::Store(piece, DU(), lanes.piece);
      return hn::Le(sums.transmittance, hn::Set(d, enough));
    }
  };
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
