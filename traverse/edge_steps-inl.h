// Steps through cells of any number of corners. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_EDGE_STEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_EDGE_STEPS_INL_H_
#undef PLUME_TRAVERSE_EDGE_STEPS_INL_H_
#else
#define PLUME_TRAVERSE_EDGE_STEPS_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/traverse/cell_walker.h"
#include "plume/traverse/edge_lanes-inl.h"
#include "plume/traverse/packet_walk-inl.h"
#include "plume/traverse/patch_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// CellWalker's leave() and advance(), a ray a lane (see PacketWalk), for cells that have a record
// of their corners and edges (EdgeCells). Cells differ too much to be decided side by side, but one
// has corners and edges enough to fill vectors: so lane after lane is decided (EdgeLanes), and all
// lanes' ways out are measured together. Steps through a cell with more than one way in and out,
// and those of cells without a record, are asked of the scalar walker.
class EdgeSteps {
 public:
  using Start = CellStart;
  static constexpr bool kInRegisters = false;

  struct State : LaneState {
    HWY_ALIGN std::uint32_t cell[kMaxLanes];
    HWY_ALIGN std::uint32_t face[kMaxLanes];  // by which the ray came in
    HWY_ALIGN std::uint32_t rank[kMaxLanes];
    bool once[kMaxLanes];  // no other crossing of that face is odd
    const ShearedFrame* frame[kMaxLanes];
  };

  template <bool kMeasure>
  using Packet = SegmentStart<kMeasure>;

  EdgeSteps(const WalkableCells& mesh, int axis) : mesh_(mesh), lanes_(mesh, axis) {}

  void Put(State& state, std::size_t lane, const CellStart& start) const {
    state.put(lane, start);
    PutPlace(state, lane, start);
  }
  void PutNothing(State& state, std::size_t lane) const {
    state.put(lane, PacketStart{});
    state.cell[lane] = 0;
  }

  template <bool kMeasure>
  HWY_INLINE VU Cells(const State& state, const SegmentStart<kMeasure>&) const {
    return hn::Load(DU(), state.cell);
  }

  HWY_INLINE void Prefetch(const State&) const {}

  template <bool kMeasure>
  HWY_INLINE StepResult Step(State& state, SegmentStart<kMeasure>&) const {
    const DF d;
    const DU du;
    HWY_ALIGN std::uint32_t cell[kMaxLanes] = {}, face[kMaxLanes] = {}, rank[kMaxLanes] = {};
    HWY_ALIGN float winding[kMaxLanes];
    HWY_ALIGN float corners[kMaxLanes][16];
    unsigned asking = 0, left = 0;
    for (unsigned live = state.live; live != 0; live &= live - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(live);
      EdgeExit exit;
      const std::uint32_t here = state.cell[lane];
      if (HWY_UNLIKELY(!state.once[lane] ||
                       !lanes_.Leave<kMeasure>(state, lane, *state.frame[lane], here,
                                               state.face[lane], exit, corners[lane]))) {
        asking |= 1u << lane;
        continue;
      }
      const auto& sides = mesh_.face_sides[exit.face];
      const bool owns = sides.owner == here;
      const std::uint32_t next = owns ? sides.neighbor : sides.owner;
      left |= static_cast<unsigned>(next == kNone) << lane;
      // Loops are seen from outside of their owner; from there a way out winds positively where z
      // grows along the ray.
      winding[lane] = owns ? state.t_per_z[lane] : -state.t_per_z[lane];
      cell[lane] = next == kNone ? 0 : next;
      face[lane] = exit.face;
      rank[lane] = exit.rank;
    }
    StepResult result;
    result.left = MaskOf(left);
    if constexpr (kMeasure) {
      QuadLanes<true> quad;
      for (std::size_t i = 0; i < 4; ++i) {
        HWY_ALIGN std::uint32_t pairs[kMaxLanes];
        hn::Store(hn::Add(hn::ShiftLeft<3>(hn::Iota(du, 0)), hn::Set(du, static_cast<std::uint32_t>(2 * i))), du, pairs);
        const FourFloats corner = LoadFour(corners[0], pairs);
        quad.x[i] = corner.a;
        quad.y[i] = corner.b;
        quad.z[i] = corner.c;
        quad.s[i] = corner.d;
      }
      const MF beside = MeasurePatch(quad, hn::Load(d, winding), result.z, result.s);
      asking |= BitsOf(beside) & state.live;
    }
    if (HWY_UNLIKELY(asking != 0)) AskWalker<kMeasure>(state, asking, cell, face, rank, result);
    hn::Store(hn::Load(du, cell), du, state.cell);
    hn::Store(hn::Load(du, face), du, state.face);
    hn::Store(hn::Load(du, rank), du, state.rank);
    return result;
  }

 private:
  static MF MaskOf(unsigned bits) {
    const DU du;
    const VU bit = hn::Shl(hn::Set(du, 1), hn::Iota(du, 0));
    return hn::RebindMask(DF(), hn::Ne(hn::And(bit, hn::Set(du, bits)), hn::Zero(du)));
  }

  // Parity tells of a loop of up to four corners that it is crossed once, if it is.
  bool is_crossed_once(const ShearedFrame& frame, std::uint32_t face) const {
    const std::size_t size = mesh_.loop(face).size();
    return size <= 4 || (size <= kMostEdgeCellCorners && lanes_.crossings(frame, face) == 1);
  }

  void PutPlace(State& state, std::size_t lane, const CellStart& start) const {
    state.cell[lane] = start.cell;
    state.face[lane] = start.face;
    state.rank[lane] = start.rank;
    state.frame[lane] = start.frame;
    state.once[lane] = is_crossed_once(*start.frame, start.face);
  }

  // Takes the step of some lanes over from the scalar walker.
  template <bool kMeasure>
  HWY_NOINLINE void AskWalker(State& state, unsigned asking, std::uint32_t* cell,
                              std::uint32_t* face, std::uint32_t* rank, StepResult& result) const {
    AskedLanes<kMeasure> asked(result);
    for (; asking != 0; asking &= asking - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(asking);
      CellWalker walker(mesh_, *state.frame[lane]);
      walker.enter({state.cell[lane], state.face[lane]}, state.rank[lane]);
      cell[lane] = face[lane] = rank[lane] = 0;
      if (!asked.ask(lane, walker)) continue;
      cell[lane] = walker.cell();
      face[lane] = walker.face();
      rank[lane] = walker.rank();
      state.once[lane] = is_crossed_once(*state.frame[lane], face[lane]);
    }
    asked.put(result);
  }

  const WalkableCells& mesh_;
  const EdgeLanes lanes_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
