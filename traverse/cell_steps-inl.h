// Steps through cells of up to eight corners. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_CELL_STEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_CELL_STEPS_INL_H_
#undef PLUME_TRAVERSE_CELL_STEPS_INL_H_
#else
#define PLUME_TRAVERSE_CELL_STEPS_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/traverse/cell_walker.h"
#include "plume/traverse/edge_steps-inl.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"
#include "plume/traverse/patch_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// CellWalker's leave() and advance(), a ray a lane (see PacketWalk), for hexahedra, wedges,
// pyramids and tetrahedra (CornerCell) with one way in and one out. Lanes in other cells, or whose
// cell has more ways (or may have: a face that is crossed twice), ask the scalar walker for that
// step.
//
// A face winds about the ray an odd number of times if and only if an odd number of its edges
// crosses y = 0 on the ray's right; edges between corners that coincide do not cross. Of the six
// faces two do: the one by which the ray came in, and the way out.
class CellSteps {
 public:
  using Start = CellStart;

  // `from` is the face by which the ray came in, of the cell's six; where that is kNoCorners,
  // `face` says which of all.
  struct State : LaneState {
    HWY_ALIGN std::uint32_t cell[kMaxLanes];
    HWY_ALIGN std::uint32_t from[kMaxLanes];
    std::uint32_t face[kMaxLanes];
    std::uint32_t rank[kMaxLanes];
    const ShearedFrame* frame[kMaxLanes];
  };

  template <bool kMeasure>
  struct Packet : SegmentStart<kMeasure> {
    VU cell, from;

    HWY_INLINE void Load(const State& state) {
      SegmentStart<kMeasure>::Load(state);
      cell = hn::Load(DU(), state.cell);
      from = hn::Load(DU(), state.from);
    }
    HWY_INLINE void Store(State& state) const {
      SegmentStart<kMeasure>::Store(state);
      hn::Store(cell, DU(), state.cell);
      hn::Store(from, DU(), state.from);
    }
  };

  CellSteps(const WalkableCells& mesh, int axis)
      : mesh_(mesh),
        cells_(mesh.corner_cells.data()),
        points_(mesh.points.data()->position),
        axis_(axis) {}

  void Put(State& state, std::size_t lane, const CellStart& start) const {
    state.put(lane, start);
    PutPlace(state, lane, start);
  }
  // In cell 0, from nowhere.
  void PutNothing(State& state, std::size_t lane) const { Put(state, lane, CellStart{}); }

  template <bool kMeasure>
  HWY_INLINE VU Cells(const State&, const Packet<kMeasure>& packet) const {
    return packet.cell;
  }

  template <bool kMeasure>
  HWY_INLINE void Prefetch(const State&, const Packet<kMeasure>& packet) const {
    HWY_ALIGN std::uint32_t pairs[kMaxLanes];
    hn::Store(hn::ShiftLeft<3>(packet.cell), DU(), pairs);
    HWY_NAMESPACE::Prefetch(reinterpret_cast<const float*>(cells_), pairs);
  }

  template <bool kMeasure>
  HWY_INLINE StepResult Step(State& state, Packet<kMeasure>& packet) const {
    const DF d;
    const DU du;
    CornerLanes<kMeasure> corner;
    LoadCorners(state, packet.cell, corner);

    // Of each two ends of an edge one has an even number of ones in its number: those are mirrored
    // at y = 0 where they are below, so that the sign of a product says on which side the edge
    // crosses (see TetSteps::Step).
    VF crosses[12], right[12], product[12];
    for (std::size_t e = 0; e < 12; ++e) {
      const std::size_t a = kEdge[e][0], b = kEdge[e][1];
      const bool first = (0x69u >> a & 1) != 0;  // corners 0, 3, 5, 6
      const std::size_t turned = first ? a : b, other = first ? b : a;
      const VF down = hn::And(corner.y[turned], hn::SignBit(d));
      const VF x = hn::Xor(corner.x[turned], down), y = hn::Abs(corner.y[turned]);
      const VF difference =
          hn::Sub(hn::MulAdd(x, corner.y[other], hn::Zero(d)), hn::Mul(corner.x[other], y));
      crosses[e] = hn::Xor(corner.y[a], corner.y[b]);
      right[e] = hn::And(difference, crosses[e]);
      product[e] = hn::Xor(difference, first ? down : hn::Xor(down, hn::SignBit(d)));
    }
    VF odd[6], strange = hn::Zero(d);
    VU odd_bits = hn::Zero(du);
    for (std::size_t f = 0; f < 6; ++f) {
      const std::uint8_t* const e = kFaceEdges[f];
      odd[f] = hn::Xor(hn::Xor(right[e[0]], right[e[1]]), hn::Xor(right[e[2]], right[e[3]]));
      odd_bits = hn::Or(odd_bits, hn::ShiftLeftSame(hn::ShiftRight<31>(hn::BitCast(du, odd[f])),
                                                    static_cast<int>(f)));
      strange = hn::Or(strange, WindsTwice(crosses[e[0]], crosses[e[1]], crosses[e[2]], right[e[0]],
                                           right[e[1]], right[e[2]], right[e[3]]));
    }
    strange = hn::Or(strange, Grazed(corner, crosses, product, odd));

    // The way out: the one odd face besides the one that the ray came in by.
    const VU one = hn::Set(du, 1);
    const VU exits = hn::Xor(odd_bits, hn::Shl(one, packet.from));
    const auto no_single = hn::Or(hn::Eq(exits, hn::Zero(du)),
                                  hn::Ne(hn::And(exits, hn::Sub(exits, one)), hn::Zero(du)));
    // A power of two's logarithm is its exponent.
    const hn::RebindToSigned<DF> di;
    const VU exit =
        hn::Sub(hn::ShiftRight<23>(hn::BitCast(du, hn::ConvertTo(d, hn::BitCast(di, exits)))),
                hn::Set(du, 127));
    const auto asks_bits = hn::Or(hn::RebindMask(d, no_single), MaskOfBits(strange));
    const VU safe_exit = hn::IfThenZeroElse(hn::RebindMask(du, asks_bits), exit);

    const auto* const words = reinterpret_cast<const std::uint32_t*>(cells_);
    const VU at_word = hn::Add(hn::ShiftLeft<4>(packet.cell), hn::Set(du, 8));
    const VU link = hn::GatherIndex(du, words, hn::BitCast(di, hn::Add(at_word, safe_exit)));
    const auto left = hn::Eq(link, hn::Set(du, kNone));
    const VU from = hn::And(link, hn::Set(du, 7));
    // Out of a cell that is no CornerCell, or into one.
    const VU no_corners = hn::Set(du, kNoCorners);
    const auto foreign =
        hn::Or(hn::Eq(packet.from, no_corners), hn::AndNot(left, hn::Eq(from, no_corners)));
    MF asks = hn::Or(asks_bits, hn::RebindMask(d, foreign));

    StepResult result;
    result.left = hn::RebindMask(d, left);
    if constexpr (kMeasure) {
      QuadLanes<true> quad;
      PickFace(corner, safe_exit, quad);
      // Seen from outside a way out winds positively where z grows along the ray; the loops of the
      // first of each two faces are seen from inside.
      const VF even = hn::BitCast(d, hn::ShiftLeft<31>(hn::AndNot(safe_exit, one)));
      const VF winding = hn::Xor(hn::Load(d, state.t_per_z), even);
      asks = hn::Or(asks, MeasurePatch(quad, winding, result.z, result.s));
    }
    const unsigned asking = BitsOf(asks) & state.live;
    if (HWY_UNLIKELY(asking != 0)) packet.Store(state);  // where the lanes come from
    packet.cell = hn::IfThenZeroElse(left, hn::ShiftRight<3>(link));
    packet.from = from;
    if (HWY_UNLIKELY(asking != 0)) AskWalker(state, packet, asking, result);
    return result;
  }

 private:
  static constexpr std::uint8_t kEdge[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                                {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  // In the order of kCornerLoop: from corner 0 to 1 of the loop, to 2, to 3 and back.
  static constexpr std::uint8_t kFaceEdges[6][4] = {{4, 10, 6, 8},  {5, 11, 7, 9}, {8, 2, 9, 0},
                                                    {10, 3, 11, 1}, {0, 5, 1, 4},  {2, 7, 3, 6}};

  template <bool kMeasure>
  struct CornerLanes {
    VF x[8], y[8], z[8], s[8];
  };

  template <bool kMeasure>
  HWY_INLINE void LoadCorners(const State& state, VU cell, CornerLanes<kMeasure>& corner) const {
    const DU du;
    HWY_ALIGN std::uint32_t pairs[2][kMaxLanes];
    HWY_ALIGN std::uint32_t point[8][kMaxLanes];
    const VU record = hn::ShiftLeft<3>(cell);  // in steps of two words
    hn::Store(record, du, pairs[0]);
    hn::Store(hn::Add(record, hn::Set(du, 2)), du, pairs[1]);
    for (std::size_t half = 0; half < 2; ++half) {
      const FourFloats ids = LoadFour(reinterpret_cast<const float*>(cells_), pairs[half]);
      const VF four[4] = {ids.a, ids.b, ids.c, ids.d};
      for (std::size_t i = 0; i < 4; ++i) {
        const VU id = hn::BitCast(du, four[i]);
        hn::Store(hn::Add(id, id), du, point[4 * half + i]);
      }
    }
    for (std::size_t c = 0; c < 8; ++c) {
      const ShearedLanes at = Shear(LoadFour(points_, point[c]), axis_, state);
      corner.x[c] = at.x;
      corner.y[c] = at.y;
      if constexpr (kMeasure) {
        corner.z[c] = at.z;
        corner.s[c] = at.s;
      }
    }
  }

  // Lanes in which a face of even winding may be crossed twice all the same (patch_lanes-inl.h).
  template <bool kMeasure>
  static HWY_INLINE VF Grazed(const CornerLanes<kMeasure>& corner, const VF (&crosses)[12],
                              const VF (&product)[12], const VF (&odd)[6]) {
    const DF d;
    VF x = hn::Zero(d), y = hn::Zero(d);
    for (std::size_t c = 0; c < 8; ++c) {
      x = hn::Max(x, hn::Abs(corner.x[c]));
      y = hn::Max(y, hn::Abs(corner.y[c]));
    }
    const GrazeTest test(x, y);
    VF grazed = hn::Zero(d);
    for (std::size_t f = 0; f < 6; ++f) {
      const std::uint8_t* const e = kFaceEdges[f];
      const std::uint8_t* const loop = kCornerLoop[f];
      auto diagonal = [&](std::size_t a, std::size_t b) {
        return GrazeTest::Product(corner.x[a], corner.y[a], corner.x[b], corner.y[b]);
      };
      // Edges run from the smaller corner to the larger; around the loop 0, b, c, d of a face they
      // are a-b, d-c, a-d and b-c up to their signs, which only count in pairs of opposite ones.
      const VF ac = diagonal(loop[0], loop[2]), bd = diagonal(loop[1], loop[3]);
      auto directed = [&](std::size_t edge, std::size_t from) {
        return kEdge[edge][0] == from ? product[edge] : hn::Neg(product[edge]);
      };
      const VF passed = test.PassedBy(directed(e[0], loop[0]), directed(e[2], loop[3]),
                                      directed(e[3], loop[0]), directed(e[1], loop[1]), ac, bd);
      const VF any = hn::Or(crosses[e[0]], hn::Or(crosses[e[1]], crosses[e[2]]));
      grazed = hn::Or(grazed, hn::AndNot(hn::Or(odd[f], passed), any));
    }
    return grazed;
  }

  // The corners of each lane's face, in the order of kCornerLoop.
  static HWY_INLINE void PickFace(const CornerLanes<true>& corner, VU face, QuadLanes<true>& quad) {
    const DF d;
    const VF second = hn::BitCast(d, hn::ShiftLeft<31>(face));
    const VF by_b = hn::BitCast(d, hn::ShiftLeft<30>(face));  // faces 2 and 3
    const VF by_c = hn::BitCast(d, hn::ShiftLeft<29>(face));  // faces 4 and 5
    auto pick = [&](const VF(&of)[8], VF(&to)[4]) {
      for (std::size_t m = 0; m < 4; ++m) {
        auto along = [&](std::size_t axis) {
          return Choose(second, of[kCornerLoop[2 * axis + 1][m]], of[kCornerLoop[2 * axis][m]]);
        };
        to[m] = Choose(by_c, along(2), Choose(by_b, along(1), along(0)));
      }
    };
    pick(corner.x, quad.x);
    pick(corner.y, quad.y);
    pick(corner.z, quad.z);
    pick(corner.s, quad.s);
  }

  static void PutPlace(State& state, std::size_t lane, const CellStart& start) {
    state.cell[lane] = start.cell;
    state.from[lane] = start.from;
    state.face[lane] = start.face;
    state.rank[lane] = start.rank;
    state.frame[lane] = start.frame;
  }

  // Takes the step of some lanes over from the scalar walker; `state` has where they come from.
  template <bool kMeasure>
  HWY_NOINLINE void AskWalker(State& state, Packet<kMeasure>& packet, unsigned asking,
                              StepResult& result) const {
    const DU du;
    AskedLanes<kMeasure> asked(result);
    HWY_ALIGN std::uint32_t cell[kMaxLanes], from[kMaxLanes];
    hn::Store(packet.cell, du, cell);
    hn::Store(packet.from, du, from);
    for (; asking != 0; asking &= asking - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(asking);
      const ShearedFrame& frame = *state.frame[lane];
      const std::uint32_t here = state.cell[lane];
      const std::uint32_t face = state.from[lane] == kNoCorners
                                     ? state.face[lane]
                                     : face_of_corners(mesh_, cells_[here], here, state.from[lane]);
      CellWalker walker(mesh_, frame);
      walker.enter({here, face}, state.rank[lane]);
      if (!asked.ask(lane, walker)) continue;
      CellStart next;
      set_place(next, mesh_, frame, walker.cell(), walker.face(), walker.rank());
      PutPlace(state, lane, next);
      cell[lane] = next.cell;
      from[lane] = next.from;
    }
    packet.cell = hn::Load(du, cell);
    packet.from = hn::Load(du, from);
    asked.put(result);
  }

  const WalkableCells& mesh_;
  const CornerCell* cells_;
  const float* points_;
  const int axis_;
};

// Walks all rays of `feeder`, whose longest axis is `axis`.
template <class Consumer>
void Walk(const WalkableCells& mesh, int axis, Consumer& consumer, PacketFeeder& feeder) {
  if (mesh.corner_cells.empty())
    PacketWalk<EdgeSteps, kPackets, false, Consumer>(EdgeSteps(mesh, axis), consumer, feeder).run();
  else
    PacketWalk<CellSteps, kAheadPackets, true, Consumer>(CellSteps(mesh, axis), consumer, feeder)
        .run();
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
