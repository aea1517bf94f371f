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
// of their corners and edges (EdgeCells). Cells differ too much to be decided side by side, but
// each has corners and edges enough to fill vectors: so lane after lane is decided (EdgeLanes), and
// all lanes' ways out are measured together. Steps through a cell with more than one way in and
// out, and those of cells without a record, are asked of the scalar walker.
class EdgeSteps {
 public:
  using Start = CellStart;

  struct State : LaneState {
    HWY_ALIGN std::uint32_t cell[kMaxLanes];
    HWY_ALIGN std::uint32_t face[kMaxLanes];  // by which the ray came in
    HWY_ALIGN std::uint32_t rank[kMaxLanes];
    EdgeRay ray[kMaxLanes];
    unsigned once = 0;  // lanes that cross that face once, or a loop whose parity would tell
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

  template <bool kMeasure>
  HWY_INLINE StepResult Step(State& state, SegmentStart<kMeasure>&) const {
    const DF d;
    const DU du;
    HWY_ALIGN std::uint32_t cell[kMaxLanes];
    EdgeExits exits;
    const unsigned known = state.live & state.once;
    unsigned asking = (state.live & ~state.once) |
                      lanes_.Leave<kMeasure>(state.ray, state.cell, state.face, known, exits);
    unsigned left = 0, inside_bits = 0;
    for (unsigned lanes = known; lanes != 0; lanes &= lanes - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes);
      const std::uint32_t here = state.cell[lane];
      const auto& sides = mesh_.face_sides[exits.face[lane]];
      const std::uint32_t next = sides.owner ^ sides.neighbor ^ here;
      const std::uint32_t inside = sides.owner == here ? 0 : 1;
      const std::uint32_t leaves = next == kNone ? 1 : 0;
      left |= leaves << lane;
      inside_bits |= inside << lane;
      cell[lane] = next & (leaves - 1);
    }
    StepResult result;
    result.left = MaskOf(left);
    if constexpr (kMeasure) {
      QuadLanes<true> quad;
      for (std::size_t i = 0; i < 4; ++i) {
        HWY_ALIGN std::uint32_t pairs[kMaxLanes];
        hn::Store(hn::Add(hn::ShiftLeft<3>(hn::Iota(du, 0)),
                          hn::Set(du, static_cast<std::uint32_t>(2 * i))),
                  du, pairs);
        const FourFloats corner = LoadFour(exits.corners[0], pairs);
        quad.x[i] = corner.a;
        quad.y[i] = corner.b;
        quad.z[i] = corner.c;
        quad.s[i] = corner.d;
      }
      // Loops are seen from outside of their owner; from there a way out winds positively where z
      // grows along the ray.
      const VF from_outside = hn::Load(d, state.t_per_z);
      const VF winding = hn::IfThenElse(MaskOf(inside_bits), hn::Neg(from_outside), from_outside);
      const MF beside = MeasurePatch(quad, winding, result.z, result.s);
      asking |= BitsOf(beside) & state.live;
    }
    if (HWY_UNLIKELY(asking != 0)) AskWalker<kMeasure>(state, asking, cell, exits, result);
    for (unsigned lanes = state.live; lanes != 0; lanes &= lanes - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes);
      state.cell[lane] = cell[lane];
      state.face[lane] = exits.face[lane];
      state.rank[lane] = exits.rank[lane];
    }
    return result;
  }

 private:
  static MF MaskOf(unsigned bits) {
    const DU du;
    const VU bit = hn::Shl(hn::Set(du, 1), hn::Iota(du, 0));
    return hn::RebindMask(DF(), hn::Ne(hn::And(bit, hn::Set(du, bits)), hn::Zero(du)));
  }

  // Whether parity tells how often the face is crossed by which a lane's ray comes in: of a loop of
  // up to four corners it does.
  void set_once(State& state, std::size_t lane, std::uint32_t face) const {
    const std::size_t size = mesh_.loop(face).size();
    const bool once = size <= 4 || (size <= kMostEdgeCellCorners &&
                                    lanes_.Crossings(*state.ray[lane].frame, face) == 1);
    state.once = (state.once & ~(1u << lane)) | static_cast<unsigned>(once) << lane;
  }

  void PutPlace(State& state, std::size_t lane, const CellStart& start) const {
    state.cell[lane] = start.cell;
    state.face[lane] = start.face;
    state.rank[lane] = start.rank;
    state.ray[lane].put(*start.frame);
    set_once(state, lane, start.face);
  }

  // Takes the step of some lanes over from the scalar walker.
  template <bool kMeasure>
  HWY_NOINLINE void AskWalker(State& state, unsigned asking, std::uint32_t* cell, EdgeExits& exits,
                              StepResult& result) const {
    AskedLanes<kMeasure> asked(result);
    for (; asking != 0; asking &= asking - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(asking);
      CellWalker walker(mesh_, *state.ray[lane].frame);
      walker.enter({state.cell[lane], state.face[lane]}, state.rank[lane]);
      cell[lane] = exits.face[lane] = exits.rank[lane] = 0;
      if (!asked.ask(lane, walker)) continue;
      cell[lane] = walker.cell();
      exits.face[lane] = walker.face();
      exits.rank[lane] = walker.rank();
      set_once(state, lane, walker.face());
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
