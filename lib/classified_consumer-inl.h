// What compositing volume, intervals and isosurfaces does with the segments of packets (see
// PacketWalk): ClassifiedPixel's work, segments of order 1. Compiled once for each instruction set:
// to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_LIB_CLASSIFIED_CONSUMER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_LIB_CLASSIFIED_CONSUMER_INL_H_
#undef PLUME_LIB_CLASSIFIED_CONSUMER_INL_H_
#else
#define PLUME_LIB_CLASSIFIED_CONSUMER_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "hwy/highway.h"
#include "plume/lib/volume_packets.h"
#include "plume/preint/classified_form-inl.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

template <class Pieces>
struct ClassifiedConsumer {
  static constexpr bool kMeasure = true;

  ClassifiedPackets& scene;
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
    HWY_ALIGN float last[kMaxLanes];
    HWY_ALIGN float reached[kMaxLanes];
    HWY_ALIGN float side[kMaxLanes];  // 0: the next scalar is the passage's first
    HWY_ALIGN float factor[kMaxLanes];
    HWY_ALIGN float highlight[kMaxLanes];
    HWY_ALIGN std::uint32_t surfaces[kMaxLanes];
    HWY_ALIGN std::uint32_t visits[kMaxLanes];
    HWY_ALIGN float z[kMaxLanes];  // where segments end
    std::uint32_t ray[kMaxLanes];
    bool jumps = false;  // a lane's scalar is not where its last passage ended
  };
  Lanes lanes[kMaxPackets] = {};

  void begin(std::size_t packet, std::size_t lane, const PacketStart& start) {
    Lanes& mine = lanes[packet];
    const PacketColor& color = colors[start.ray];
    mine.r[lane] = color.r;
    mine.g[lane] = color.g;
    mine.b[lane] = color.b;
    mine.transmittance[lane] = color.transmittance;
    const PacketVisit& visit = scene.visits[start.ray];
    mine.piece[lane] = visit.piece;
    mine.last[lane] = visit.last;
    mine.reached[lane] = visit.reached;
    mine.side[lane] = visit.side;
    mine.factor[lane] = visit.shading.factor;
    mine.highlight[lane] = visit.shading.highlight;
    mine.ray[lane] = start.ray;
    mine.jumps = mine.jumps || visit.side != 0;
  }

  // Where the segments end that visit() is about to be given.
  HWY_INLINE void ends_at(std::size_t packet, VF z) { hn::Store(z, DF(), lanes[packet].z); }

  // Not inlined: it is long, and walks have many copies of where it is called.
  HWY_NOINLINE MF visit(std::size_t packet, MF active, VF length, VF s_in, VF s_out, VU cells) {
    const DF d;
    Lanes& mine = lanes[packet];
    if (cell_values != nullptr) {
      s_in = hn::GatherIndex(d, cell_values, hn::BitCast(hn::RebindToSigned<DU>(), cells));
      s_out = s_in;
    }
    const VF most = hn::Set(d, std::numeric_limits<float>::max());
    const MF known = hn::And(hn::Le(hn::Abs(s_in), most), hn::Le(hn::Abs(s_out), most));
    // Zero times what is not a number would not be zero.
    s_in = hn::IfThenElseZero(known, s_in);
    s_out = hn::IfThenElseZero(known, s_out);
    const MF starts = hn::And(hn::And(active, known), hn::Eq(hn::Load(d, mine.side), hn::Zero(d)));
    if (HWY_UNLIKELY(!hn::AllFalse(d, starts))) begin_passages(mine, BitsOf(starts), s_in);
    const MF seeing = hn::And(active, known);
    if (cell_values != nullptr || mine.jumps) {
      // A jump is a way of no length through all that lies between.
      composite(mine, seeing, hn::Load(d, mine.last), s_in, hn::Zero(d), length, cells);
      mine.jumps = false;
    }
    composite(mine, seeing, s_in, s_out, length, hn::Zero(d), cells);
    hn::Store(s_out, d, mine.last);
    // What lies behind a scalar that is not known is another passage.
    if (HWY_UNLIKELY(!hn::AllTrue(d, known)))
      hn::Store(hn::IfThenElseZero(known, hn::Load(d, mine.side)), d, mine.side);
    return hn::Le(hn::Load(d, mine.transmittance), hn::Set(d, enough));
  }

  void end(std::size_t packet, std::size_t lane, const PacketStart& start, float z,
           std::uint32_t cells) {
    const Lanes& mine = lanes[packet];
    PacketColor& color = colors[start.ray];
    const float transmittance = mine.transmittance[lane];
    color = {mine.r[lane],           mine.g[lane],        mine.b[lane],
             transmittance,          color.cells + cells, z,
             transmittance <= enough};
    scene.visits[start.ray] = {mine.piece[lane],
                               mine.last[lane],
                               mine.reached[lane],
                               mine.side[lane],
                               {mine.factor[lane], mine.highlight[lane]}};
  }

  // Hands out what was counted.
  void count() const {
    for (const Lanes& mine : lanes)
      for (std::size_t lane = 0; lane < kMaxLanes; ++lane) {
        scene.surfaces_crossed += mine.surfaces[lane];
        scene.intervals_visited += mine.visits[lane];
      }
  }

 private:
  // `behind` is what lies between the jump or segment and where visit()'s segments end.
  HWY_INLINE void composite(Lanes& mine, MF active, VF s_in, VF s_out, VF length, VF behind,
                            VU cells) {
    if (scene.light == nullptr)
      composite_part<false>(mine, active, s_in, s_out, length, behind, cells);
    else
      composite_part<true>(mine, active, s_in, s_out, length, behind, cells);
  }

  template <bool kLit>
  HWY_NOINLINE void composite_part(Lanes& mine, MF active, VF s_in, VF s_out, VF length, VF behind,
                                   VU cells) {
    const DF d;
    const DU du;
    optics::Sums sums{hn::Load(d, mine.r), hn::Load(d, mine.g), hn::Load(d, mine.b),
                      hn::Load(d, mine.transmittance)};
    optics::Visits state{hn::Load(du, mine.piece), hn::Load(d, mine.reached),
                         hn::Load(d, mine.side), hn::Load(du, mine.surfaces),
                         hn::Load(du, mine.visits)};
    optics::Lit visited{hn::Load(d, mine.factor), hn::Load(d, mine.highlight)};
    optics::CompositeClassified<kLit>(pieces, active, s_in, s_out, length, state, sums, visited,
                                      [&](MF surface, MF visit, VF rest) {
                                        return light_at(mine, BitsOf(surface), BitsOf(visit),
                                                        hn::Add(rest, behind), cells);
                                      });
    hn::Store(sums.r, d, mine.r);
    hn::Store(sums.g, d, mine.g);
    hn::Store(sums.b, d, mine.b);
    hn::Store(sums.transmittance, d, mine.transmittance);
    hn::Store(state.piece, du, mine.piece);
    hn::Store(state.reached, d, mine.reached);
    hn::Store(state.side, d, mine.side);
    hn::Store(state.surfaces, du, mine.surfaces);
    hn::Store(state.visits, du, mine.visits);
    if constexpr (kLit) {
      hn::Store(visited.factor, d, mine.factor);
      hn::Store(visited.highlight, d, mine.highlight);
    }
  }

  HWY_NOINLINE optics::Lit light_at(const Lanes& mine, unsigned surface, unsigned visit, VF rest,
                                    VU cells) const {
    const DF d;
    HWY_ALIGN float factor[kMaxLanes], highlight[kMaxLanes], back[kMaxLanes];
    HWY_ALIGN std::uint32_t cell[kMaxLanes];
    hn::Store(rest, d, back);
    hn::Store(cells, DU(), cell);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      const bool lit =
          ((surface >> lane) & 1u) != 0 || (scene.light_intervals && ((visit >> lane) & 1u) != 0);
      const Shading shading =
          lit ? scene.light->at(mine.ray[lane], mine.z[lane], back[lane], cell[lane]) : Shading{};
      factor[lane] = shading.factor;
      highlight[lane] = shading.highlight;
    }
    return {hn::Load(d, factor), hn::Load(d, highlight)};
  }

  // The first scalar of a passage: one strictly inside of an interval shows all of that at once.
  HWY_NOINLINE void begin_passages(Lanes& mine, unsigned lanes_that_begin, VF s_in) {
    const DF d;
    HWY_ALIGN float first[kMaxLanes];
    hn::Store(s_in, d, first);
    for (unsigned bits = lanes_that_begin; bits != 0; bits &= bits - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
      const float scalar = first[lane];
      const std::size_t piece = scene.pieces.piece_of(scalar);
      mine.piece[lane] = static_cast<std::uint32_t>(piece);
      mine.last[lane] = scalar;
      mine.reached[lane] = scalar;
      mine.side[lane] = 2;
      const float kind = scene.pieces.pieces[piece].kind;
      if (!(kind > 0)) continue;
      const auto interval = static_cast<std::size_t>(kind) - 1;
      const auto& ends = scene.pieces.ends[interval];
      if (scalar == ends.low) continue;
      if (scalar == ends.high) {
        mine.side[lane] = -2;
        continue;
      }
      const SegmentColor& whole = scene.pieces.whole_intervals[interval];
      float& transmittance = mine.transmittance[lane];
      mine.r[lane] += transmittance * whole.r;
      mine.g[lane] += transmittance * whole.g;
      mine.b[lane] += transmittance * whole.b;
      transmittance -= transmittance * whole.alpha;
      mine.reached[lane] = ends.high;
      mine.side[lane] = 1;
      mine.factor[lane] = 1;
      mine.highlight[lane] = 0;
      ++mine.visits[lane];
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
