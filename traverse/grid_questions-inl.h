// What packets of rays through a curvilinear grid ask of the scalar walker. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_GRID_QUESTIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_GRID_QUESTIONS_INL_H_
#undef PLUME_TRAVERSE_GRID_QUESTIONS_INL_H_
#else
#define PLUME_TRAVERSE_GRID_QUESTIONS_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <optional>

#include "hwy/highway.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/traverse/grid_packet-inl.h"
#include "plume/traverse/grid_walker.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// By which face a ray leaves a cell that has, or may have, more than one way out, and where it
// crosses a face that it sees edge-on, the scalar walker says.
//
// Most of what is asked are excursions: out of the cell by a twisted face that the ray grazes, into
// the cell behind it, and back by the same face. They are asked for once: both places where the
// face is crossed and the face left by in the end are known from then on.
class GridQuestions {
 public:
  GridQuestions(const WalkableGrid& mesh, const GridDirections& directions)
      : mesh_(mesh), directions_(directions) {}

  // Finds the faces that the `strange` lanes leave by. `grazed`: lanes whose front has even
  // winding; `alone`: those that cross no other face either. Returned are the lanes of which it is
  // known where they leave.
  template <bool kMeasure>
  HWY_INLINE MF Decide(GridState& state, const GridPacket<kMeasure>& packet, VF strange, VF grazed,
                       VF alone) const {
    const DF d;
    const DU du;
    const VU cell = directions_.CellAt(packet.index), from = hn::Xor(packet.ahead, hn::Set(du, 1));
    const VU left_cell = hn::Load(du, state.excursion_cell);
    // Behind the grazed face: back by it. In front of it again: out for good.
    const MF back =
        hn::And(MaskOfBits(alone), hn::RebindMask(d, hn::Ne(left_cell, hn::Set(du, kNone))));
    const MF again = hn::And(MaskOfBits(grazed), hn::RebindMask(d, hn::Eq(left_cell, cell)));
    const auto again_u = hn::RebindMask(du, again);
    hn::Store(hn::IfThenElse(again_u, hn::Load(du, state.excursion_exit), from), du, state.exit);
    const VU other = hn::IfThenElseZero(hn::RebindMask(du, back), hn::Set(du, 1));
    const VU rank = hn::IfThenZeroElse(again_u, hn::Load(du, state.rank));
    hn::Store(hn::Xor(rank, other), du, state.rank);
    hn::Store(hn::Load(d, state.excursion_z), d, state.exit_z);
    hn::Store(hn::Load(d, state.excursion_s), d, state.exit_s);
    const MF asks = hn::AndNot(hn::Or(back, again), MaskOfBits(strange));
    const unsigned asking = BitsOf(asks) & state.live;
    if (asking != 0) AskWalkers(state, asking, cell, from);
    const MF nowhere = hn::RebindMask(d, hn::Eq(hn::Load(du, state.exit), hn::Set(du, kNowhere)));
    return hn::AndNot(hn::Or(again, nowhere), MaskOfBits(strange));
  }

  // Has the scalar walker measure where lanes have come through their fronts.
  template <bool kMeasure>
  HWY_NOINLINE void MeasureAgain(const GridState& state, const GridPacket<kMeasure>& packet,
                                 unsigned asking, StepResult& result) const {
    const DF d;
    const DU du;
    HWY_ALIGN std::uint32_t cell[kMaxLanes], face[kMaxLanes];
    HWY_ALIGN float z[kMaxLanes], s[kMaxLanes];
    VU index[3];  // of the cell before
    for (std::size_t a = 0; a < 3; ++a)
      index[a] = hn::Sub(packet.index[a], directions_.Move(a, packet.ahead));
    hn::Store(directions_.CellAt(index), du, cell);
    hn::Store(packet.ahead, du, face);
    hn::Store(result.z, d, z);
    hn::Store(result.s, d, s);
    for (; asking != 0; asking &= asking - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(asking);
      GridWalker walker(mesh_, *state.frame[lane]);
      walker.enter({cell[lane], face[lane]}, 0);
      const Crossing place = walker.crossing_of(face[lane]);
      z[lane] = static_cast<float>(place.z);
      s[lane] = place.scalar;
    }
    result.z = hn::Load(d, z);
    result.s = hn::Load(d, s);
  }

 private:
  // Asks the scalar walker for the faces by which lanes leave their cells, having come `from`
  // those.
  HWY_NOINLINE void AskWalkers(GridState& state, unsigned asking, VU cells, VU from) const {
    const DU du;
    HWY_ALIGN std::uint32_t cell[kMaxLanes], face[kMaxLanes];
    hn::Store(cells, du, cell);
    hn::Store(from, du, face);
    for (; asking != 0; asking &= asking - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(asking);
      GridWalker walker(mesh_, *state.frame[lane]);
      walker.enter({cell[lane], face[lane]}, state.rank[lane]);
      std::optional<GridWalker::Excursion> excursion;
      const std::optional<Crossing> exit = walker.leave(&excursion);
      state.exit[lane] = kNowhere;
      state.excursion_cell[lane] = kNone;
      // There always is a way out; without one the ray would end here, as at the boundary.
      if (!exit) continue;
      state.exit[lane] = walker.face();
      state.rank[lane] = walker.rank();
      state.exit_z[lane] = static_cast<float>(exit->z);
      state.exit_s[lane] = exit->scalar;
      if (!excursion) continue;
      state.excursion_cell[lane] = cell[lane];
      state.excursion_exit[lane] = excursion->exit_face;
      state.excursion_z[lane] = static_cast<float>(excursion->back.z);
      state.excursion_s[lane] = excursion->back.scalar;
    }
  }

  const WalkableGrid& mesh_;
  const GridDirections& directions_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
