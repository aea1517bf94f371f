// Steps through the hexahedra of a curvilinear grid. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_GRID_STEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_GRID_STEPS_INL_H_
#undef PLUME_TRAVERSE_GRID_STEPS_INL_H_
#else
#define PLUME_TRAVERSE_GRID_STEPS_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/traverse/grid_behind-inl.h"
#include "plume/traverse/grid_packet-inl.h"
#include "plume/traverse/grid_questions-inl.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"
#include "plume/traverse/patch_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// GridWalker's leave() and advance(), a ray a lane (see PacketWalk), for hexahedra that have one
// way in and one out; lanes whose cell has more, or may have (a face that is crossed twice), ask
// the scalar walker for the face that they leave by.
//
// A cell is seen from the face by which the ray comes in, the front: its corners 0 to 3 go around
// it, corner m of the back is joined to corner m of the front, and side m has the corners m and
// m + 1 of both. A quadrilateral winds about the ray an odd number of times if and only if an odd
// number of its edges crosses y = 0 on the ray's right. The front does, so one of the back and the
// sides does, or three, or all. The face left by is the next cell's front: corners and edges that
// it keeps keep their places, so that its loop winds about the ray in the same direction.
template <bool kTwisted>
class GridSteps {
 public:
  using Start = GridStart;

  using State = GridState;
  template <bool kMeasure>
  using Packet = GridPacket<kMeasure>;

  GridSteps(const WalkableGrid& mesh, int axis)
      : mesh_(mesh), points_(mesh.points.data()->position), axis_(axis), directions_(mesh) {}

  void Put(State& state, std::size_t lane, const GridStart& start) const {
    state.put(lane, start);
    directions_.PutPlace(state, lane, start);
  }

  // At point 0, with no direction to go.
  void PutNothing(State& state, std::size_t lane) const {
    GridStart nothing;
    nothing.u = nothing.v = nothing.ahead = kNowhere;
    Put(state, lane, nothing);
  }

  template <bool kMeasure>
  HWY_INLINE VU Cells(const State&, const Packet<kMeasure>& packet) const {
    return directions_.CellAt(packet.index);
  }

  template <bool kMeasure>
  HWY_INLINE StepResult Step(State& state, Packet<kMeasure>& packet) const {
    // Where a step has asked, the next ones most likely ask as well.
    if (HWY_UNLIKELY(state.asks_on != 0)) return TakeAsking(state, packet);
    return Take<false>(state, packet);
  }

 private:
  static constexpr std::uint32_t kNowhere = 6;  // a direction in which nothing moves

  // Where rays run along twisted faces five of six steps of a packet ask.
  static constexpr unsigned kAsksOn = 8;

  // A step where strange lanes ask here, or the same once more in a function that does: what only
  // they need would be written to memory by every step.
  template <bool kAsks, bool kMeasure>
  HWY_INLINE StepResult Take(State& state, Packet<kMeasure>& packet) const {
    const DF d;
    const DU du;
    Behind<kMeasure> behind;
    LookBehind<kTwisted, kAsks>(mesh_, points_, axis_, state, packet, behind);
    QuadLanes<kMeasure>& p = packet.front;
    QuadLanes<kMeasure>& q = behind.q;
    const VF* const right = packet.right;
    VF(&side)[4] = behind.side;
    VF(&right_across)[4] = behind.right_across;
    VF(&right_along)[4] = behind.right_along;

    StepResult result;
    result.left = hn::MaskFromVec(hn::Zero(d));
    MF measured = result.left;
    const VU opposite = hn::Set(du, 1);
    const bool asks = (BitsOf(MaskOfBits(behind.strange)) & state.live) != 0;
    if constexpr (kAsks) state.asks_on = asks ? kAsksOn : state.asks_on - (state.asks_on != 0);
    if (HWY_UNLIKELY(asks)) {
      if constexpr (!kAsks) {
        return TakeAsking(state, packet);
      } else {
        const VF odd = behind.odd, strange = behind.strange;
        const VF others = Or3(hn::Or(side[0], side[1]), hn::Or(side[2], side[3]), behind.doubtful);
        measured = GridQuestions(mesh_, directions_)
                       .Decide(state, packet, strange, hn::Not(odd), hn::Not(hn::Or(odd, others)));
        const VU exit = hn::Load(du, state.exit);
        auto leaves_by = [&](VU face) {
          return hn::VecFromMask(d, hn::RebindMask(d, hn::Eq(exit, face)));
        };
        const VU face[4] = {hn::Xor(packet.v, opposite), packet.u, packet.v,
                            hn::Xor(packet.u, opposite)};
        for (std::size_t m = 0; m < 4; ++m) side[m] = Choose(strange, leaves_by(face[m]), side[m]);
        result.left = MaskOfBits(hn::And(strange, leaves_by(hn::Set(du, kNowhere))));
        TurnAround(packet, hn::And(strange, leaves_by(hn::Xor(packet.ahead, opposite))), q,
                   right_along);
      }
    }

    // The front of the next cell: the back, or side m, whose corners m and m + 1 stay.
    const VF stay[4] = {hn::Or(side[3], side[0]), hn::Or(side[0], side[1]),
                        hn::Or(side[1], side[2]), hn::Or(side[2], side[3])};
    auto next_corners = [&](VF(&front)[4], const VF(&back)[4]) {
      VF next[4];
      HWY_UNROLL(4)
      for (std::size_t m = 0; m < 4; ++m) {
        const VF turned = Choose(side[(m + 1) % 4], back[(m + 1) % 4],
                                 Choose(side[(m + 2) % 4], back[(m + 3) % 4], back[m]));
        next[m] = Choose(stay[m], front[m], turned);
      }
      HWY_UNROLL(4)
      for (std::size_t m = 0; m < 4; ++m) front[m] = next[m];
    };
    next_corners(p.x, q.x);
    next_corners(p.y, q.y);
    if constexpr (kMeasure) {
      next_corners(p.z, q.z);
      next_corners(p.s, q.s);
    }
    VF next_right[4];
    HWY_UNROLL(4)
    for (std::size_t m = 0; m < 4; ++m) {
      const std::size_t n = (m + 1) % 4, o = (m + 2) % 4, l = (m + 3) % 4;
      next_right[m] = Choose(side[m], right[m],
                             Choose(side[n], right_across[n],
                                    Choose(side[o], right_along[o],
                                           Choose(side[l], right_across[m], right_along[m]))));
    }
    HWY_UNROLL(4)
    for (std::size_t m = 0; m < 4; ++m) packet.right[m] = next_right[m];

    const VU u_by_2 = directions_.StrideBy2(packet.u);
    const VU v_by_2 = directions_.StrideBy2(packet.v);
    const VU ahead_by_2 = directions_.StrideBy2(packet.ahead);
    const VU further =
        hn::Add(ahead_by_2, Choose(side[1], u_by_2, Choose(side[2], v_by_2, hn::Zero(du))));
    packet.first_by_2 = hn::Add(packet.first_by_2, Choose(stay[0], hn::Zero(du), further));
    const VU u = packet.u, v = packet.v, ahead = packet.ahead;
    packet.u = Choose(side[1], hn::Xor(ahead, opposite), Choose(side[3], ahead, u));
    packet.v = Choose(side[0], ahead, Choose(side[2], hn::Xor(ahead, opposite), v));
    packet.ahead = Choose(
        side[0], hn::Xor(v, opposite),
        Choose(side[1], u, Choose(side[2], v, Choose(side[3], hn::Xor(u, opposite), ahead))));
    auto left = hn::RebindMask(du, result.left);
    for (std::size_t a = 0; a < 3; ++a) {
      packet.index[a] = hn::Add(packet.index[a], directions_.Move(a, packet.ahead));
      left = hn::Or(left, hn::Gt(packet.index[a], hn::Set(du, mesh_.dimensions[a] - 2)));
    }
    directions_.StoreBack(state, packet);

    result.left = hn::RebindMask(d, left);
    if (HWY_UNLIKELY(!mesh_.hidden.empty()))
      result.left = hn::Or(result.left, Hidden(state, packet, result.left));
    if constexpr (kMeasure) {
      const MF beside = MeasurePatch(p, hn::Load(d, state.winding), result.z, result.s);
      if constexpr (kAsks) {
        result.z = hn::IfThenElse(measured, hn::Load(d, state.exit_z), result.z);
        result.s = hn::IfThenElse(measured, hn::Load(d, state.exit_s), result.s);
      }
      const unsigned asking = BitsOf(hn::AndNot(measured, beside)) & state.live;
      if (HWY_UNLIKELY(asking != 0))
        GridQuestions(mesh_, directions_).MeasureAgain(state, packet, asking, result);
    }
    return result;
  }

  template <bool kMeasure>
  HWY_NOINLINE StepResult TakeAsking(State& state, Packet<kMeasure>& packet) const {
    return Take<true>(state, packet);
  }

  // Lanes that have not left and are in a hidden cell now.
  template <bool kMeasure>
  HWY_NOINLINE MF Hidden(const State& state, const Packet<kMeasure>& packet, MF left) const {
    const DF d;
    HWY_ALIGN std::uint32_t cell[kMaxLanes];
    hn::Store(Cells(state, packet), DU(), cell);
    HWY_ALIGN float hidden[kMaxLanes] = {};
    for (unsigned on = state.live & ~BitsOf(left); on != 0; on &= on - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(on);
      if (mesh_.hidden[cell[lane]]) hidden[lane] = 1;
    }
    return hn::Gt(hn::Load(d, hidden), hn::Zero(d));
  }

  // Makes the front the back of lanes that leave by it: the cell as seen from behind, where the
  // loop's direction turns as well.
  template <bool kMeasure>
  HWY_INLINE void TurnAround(Packet<kMeasure>& packet, VF turned, QuadLanes<kMeasure>& back,
                             VF (&right_along)[4]) const {
    const DU du;
    const QuadLanes<kMeasure>& front = packet.front;
    for (std::size_t m = 0; m < 4; ++m) {
      const std::size_t other = (4 - m) % 4;
      back.x[m] = Choose(turned, front.x[other], back.x[m]);
      back.y[m] = Choose(turned, front.y[other], back.y[m]);
      if constexpr (kMeasure) {
        back.z[m] = Choose(turned, front.z[other], back.z[m]);
        back.s[m] = Choose(turned, front.s[other], back.s[m]);
      }
      right_along[m] = Choose(turned, packet.right[3 - m], right_along[m]);
    }
    const VU u = packet.u, behind = hn::Xor(packet.ahead, hn::Set(du, 1));
    packet.u = Choose(turned, packet.v, u);
    packet.v = Choose(turned, u, packet.v);
    packet.ahead = Choose(turned, behind, packet.ahead);
    packet.first_by_2 =
        hn::Sub(packet.first_by_2, Choose(turned, directions_.StrideBy2(behind), hn::Zero(du)));
  }
  const WalkableGrid& mesh_;
  const float* points_;
  const int axis_;
  const GridDirections directions_;
};

// Walks all rays of `feeder`, whose longest axis is `axis`.
template <class Consumer>
void Walk(const WalkableGrid& mesh, int axis, Consumer& consumer, PacketFeeder& feeder) {
  // Where fewer cells than one in so many are near twisted faces.
  constexpr std::size_t kFew = 32;
  auto walk = [&](const auto& steps) {
    PacketWalk<std::decay_t<decltype(steps)>, kPackets, false, Consumer>(steps, consumer, feeder)
        .run();
  };
  if (kFew * mesh.twisted.cell_count() < mesh.cell_count())
    walk(GridSteps<false>(mesh, axis));
  else
    walk(GridSteps<true>(mesh, axis));
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
