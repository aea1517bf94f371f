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
#include "plume/traverse/grid_walker.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"
#include "plume/traverse/patch_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// One of a table's eight entries a lane.
HWY_INLINE VU LookUp(const std::uint32_t* HWY_RESTRICT table, VU place) {
  const DU du;
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(DU()) >= 8)
    return hn::TableLookupLanes(hn::Load(du, table), hn::IndicesFromVec(du, place));
#endif
  return hn::GatherIndex(du, table, hn::BitCast(hn::RebindToSigned<DU>(), place));
}

// GridWalker's leave() and advance(), a ray a lane (see PacketWalk), for hexahedra that have one
// way in and one out; lanes whose cell has more, or may have (a face that is crossed twice), ask
// the scalar walker for that step.
//
// A cell is seen from the face by which the ray comes in, the front: its corners 0 to 3 go around
// it, corner m of the back is joined to corner m of the front, and side m has the corners m and
// m + 1 of both. A quadrilateral winds about the ray an odd number of times if and only if an odd
// number of its edges crosses y = 0 on the ray's right. The front does, so one of the back and the
// sides does, or three, or all. The face left by is the next cell's front: corners and edges that
// it keeps keep their places, so that its loop winds about the ray in the same direction.
class GridSteps {
 public:
  using Start = GridStart;
  static constexpr bool kInRegisters = false;

  // Written here while a lane is given a ray or has asked the scalar walker; `back_by_2` always, as
  // places to load from: twice the numbers of the back's points.
  struct State : LaneState {
    HWY_ALIGN std::uint32_t back_by_2[4][kMaxLanes];
    HWY_ALIGN float x[4][kMaxLanes];
    HWY_ALIGN float y[4][kMaxLanes];
    HWY_ALIGN float z[4][kMaxLanes];
    HWY_ALIGN float s[4][kMaxLanes];
    HWY_ALIGN float right[4][kMaxLanes];
    HWY_ALIGN std::uint32_t first_by_2[kMaxLanes];
    HWY_ALIGN std::uint32_t u[kMaxLanes];
    HWY_ALIGN std::uint32_t v[kMaxLanes];
    HWY_ALIGN std::uint32_t ahead[kMaxLanes];
    HWY_ALIGN std::uint32_t index[3][kMaxLanes];
    HWY_ALIGN float winding[kMaxLanes];  // of the front's loop about the ray; its sign counts
    std::uint32_t rank[kMaxLanes];
    const ShearedFrame* frame[kMaxLanes];
  };

  template <bool kMeasure>
  struct Packet : SegmentStart<kMeasure> {
    QuadLanes<kMeasure> front;
    VF right[4];  // whether the front's edges, from corner m to m + 1, cross on the right
    VU first_by_2;
    VU u, v, ahead;  // directions, numbered as in GridStart
    VU index[3];

    HWY_INLINE void Load(const State& state) {
      const DF d;
      const DU du;
      SegmentStart<kMeasure>::Load(state);
      for (std::size_t m = 0; m < 4; ++m) {
        front.x[m] = hn::Load(d, state.x[m]);
        front.y[m] = hn::Load(d, state.y[m]);
        if constexpr (kMeasure) {
          front.z[m] = hn::Load(d, state.z[m]);
          front.s[m] = hn::Load(d, state.s[m]);
        }
        right[m] = hn::Load(d, state.right[m]);
      }
      first_by_2 = hn::Load(du, state.first_by_2);
      u = hn::Load(du, state.u);
      v = hn::Load(du, state.v);
      ahead = hn::Load(du, state.ahead);
      for (std::size_t a = 0; a < 3; ++a) index[a] = hn::Load(du, state.index[a]);
    }
    HWY_INLINE void Store(State& state) const {
      const DF d;
      const DU du;
      SegmentStart<kMeasure>::Store(state);
      for (std::size_t m = 0; m < 4; ++m) {
        hn::Store(front.x[m], d, state.x[m]);
        hn::Store(front.y[m], d, state.y[m]);
        if constexpr (kMeasure) {
          hn::Store(front.z[m], d, state.z[m]);
          hn::Store(front.s[m], d, state.s[m]);
        }
        hn::Store(right[m], d, state.right[m]);
      }
      hn::Store(first_by_2, du, state.first_by_2);
      hn::Store(u, du, state.u);
      hn::Store(v, du, state.v);
      hn::Store(ahead, du, state.ahead);
      for (std::size_t a = 0; a < 3; ++a) hn::Store(index[a], du, state.index[a]);
    }
  };

  GridSteps(const WalkableGrid& mesh, int axis)
      : mesh_(mesh),
        points_(mesh.points.data()->position),
        axis_(axis),
        twisted_(mesh.planar_faces != PlanarFaces::all) {
    const std::uint32_t step[3] = {1, mesh.dimensions[0], mesh.dimensions[0] * mesh.dimensions[1]};
    for (std::size_t a = 0; a < 3; ++a) {
      stride_by_2_[2 * a] = 0u - 2 * step[a];
      stride_by_2_[2 * a + 1] = 2 * step[a];
      move_[a][2 * a] = ~0u;
      move_[a][2 * a + 1] = 1;
    }
    // As many entries as lanes, for permutations.
    for (std::size_t i = 8; i < kMaxLanes; ++i) stride_by_2_[i] = stride_by_2_[i - 8];
    for (auto& move : move_)
      for (std::size_t i = 8; i < kMaxLanes; ++i) move[i] = move[i - 8];
  }

  void Put(State& state, std::size_t lane, const GridStart& start) const {
    state.put(lane, start);
    PutPlace(state, lane, start);
  }

  // At point 0, with no direction to go.
  void PutNothing(State& state, std::size_t lane) const {
    GridStart nothing;
    nothing.u = nothing.v = nothing.ahead = kNowhere;
    Put(state, lane, nothing);
  }

  template <bool kMeasure>
  HWY_INLINE VU Cells(const State&, const Packet<kMeasure>& packet) const {
    return CellAt(packet.index);
  }

  template <class AnyPacket>
  HWY_INLINE void Prefetch(const State& state, const AnyPacket&) const {
    for (const auto& corner : state.back_by_2) HWY_NAMESPACE::Prefetch(points_, corner);
  }

  template <bool kMeasure>
  HWY_INLINE StepResult Step(State& state, Packet<kMeasure>& packet) const {
    const DF d;
    const DU du;
    QuadLanes<kMeasure>& p = packet.front;
    QuadLanes<kMeasure> q;
    VF flipped_x[4], flipped_y[4];
    for (std::size_t m = 0; m < 4; ++m) {
      const ShearedLanes at = Shear(LoadFour(points_, state.back_by_2[m]), axis_, state);
      q.x[m] = at.x;
      q.y[m] = at.y;
      if constexpr (kMeasure) {
        q.z[m] = at.z;
        q.s[m] = at.s;
      }
      flipped_y[m] = hn::Abs(at.y);
      flipped_x[m] = hn::Xor(at.x, hn::And(at.y, hn::SignBit(d)));
    }
    // Whether edges between front and back, and of the back, cross y = 0, and on the right (see
    // TetSteps::Step).
    auto side_of = [&](std::size_t m, VF x, VF y) {
      return hn::Sub(hn::MulAdd(flipped_x[m], y, hn::Zero(d)), hn::Mul(x, flipped_y[m]));
    };
    VF across[4], along[4], right_across[4], right_along[4];
    Products products;
    for (std::size_t m = 0; m < 4; ++m) {
      const std::size_t n = (m + 1) % 4;
      const VF down = hn::And(q.y[m], hn::SignBit(d));
      const VF with_front = side_of(m, p.x[m], p.y[m]), with_next = side_of(m, q.x[n], q.y[n]);
      products.with_front[m] = hn::Xor(with_front, down);
      products.with_next[m] = hn::Xor(with_next, down);
      across[m] = hn::Xor(p.y[m], q.y[m]);
      along[m] = hn::Xor(q.y[n], q.y[m]);
      right_across[m] = hn::And(with_front, across[m]);
      right_along[m] = hn::And(with_next, along[m]);
    }
    const VF* const right = packet.right;
    VF side[4];  // whether side m winds an odd number of times
    for (std::size_t m = 0; m < 4; ++m)
      side[m] = Xor3(right[m], right_across[m], hn::Xor(right_across[(m + 1) % 4], right_along[m]));

    // Lanes that this step does not hold for: the front winds an even number of times, or several
    // sides wind, or a face has, or may have, two crossings.
    VF several = hn::And(side[0], side[1]);
    several = hn::Or(several, hn::And(hn::Or(side[0], side[1]), side[2]));
    several = hn::Or(several, hn::And(hn::Or(hn::Or(side[0], side[1]), side[2]), side[3]));
    const VF odd = Xor3(right[0], right[1], hn::Xor(right[2], right[3]));
    VF strange = hn::Or(several, hn::Not(odd));
    VF before[4];  // the front's edges: do they cross y = 0?
    for (std::size_t m = 0; m < 4; ++m) before[m] = hn::Xor(p.y[m], p.y[(m + 1) % 4]);
    strange = hn::Or(strange, WindsTwice(along[0], along[1], along[2], right_along[0],
                                         right_along[1], right_along[2]));
    for (std::size_t m = 0; m < 4; ++m) {
      const std::size_t n = (m + 1) % 4;
      strange = hn::Or(strange, WindsTwice(before[m], across[n], along[m], right[m],
                                           right_across[n], right_along[m]));
    }
    if (twisted_) {
      // Faces with all corners on one side of y = 0 (or in one place) are not crossed.
      const VF back_crosses = Or3(along[0], along[1], along[2]);
      VF side_crosses[4];
      for (std::size_t m = 0; m < 4; ++m)
        side_crosses[m] = Or3(before[m], across[(m + 1) % 4], along[m]);
      strange = hn::Or(strange, Grazed(p, q, side, products, back_crosses, side_crosses));
    }

    const VU index[3] = {packet.index[0], packet.index[1], packet.index[2]};

    // The front of the next cell: the back, or side m, whose corners m and m + 1 stay.
    const VF stay[4] = {hn::Or(side[3], side[0]), hn::Or(side[0], side[1]),
                        hn::Or(side[1], side[2]), hn::Or(side[2], side[3])};
    auto next_corners = [&](VF(&front)[4], const VF(&back)[4]) {
      VF next[4];
      for (std::size_t m = 0; m < 4; ++m) {
        const VF turned = Choose(side[(m + 1) % 4], back[(m + 1) % 4],
                                 Choose(side[(m + 2) % 4], back[(m + 3) % 4], back[m]));
        next[m] = Choose(stay[m], front[m], turned);
      }
      for (std::size_t m = 0; m < 4; ++m) front[m] = next[m];
    };
    next_corners(p.x, q.x);
    next_corners(p.y, q.y);
    if constexpr (kMeasure) {
      next_corners(p.z, q.z);
      next_corners(p.s, q.s);
    }
    VF next_right[4];
    for (std::size_t m = 0; m < 4; ++m) {
      const std::size_t n = (m + 1) % 4, o = (m + 2) % 4, l = (m + 3) % 4;
      next_right[m] = Choose(side[m], right[m],
                             Choose(side[n], right_across[n],
                                    Choose(side[o], right_along[o],
                                           Choose(side[l], right_across[m], right_along[m]))));
    }
    for (std::size_t m = 0; m < 4; ++m) packet.right[m] = next_right[m];

    const VU opposite = hn::Set(du, 1);
    const VU u_by_2 = LookUp(stride_by_2_, packet.u);
    const VU v_by_2 = LookUp(stride_by_2_, packet.v);
    const VU ahead_by_2 = LookUp(stride_by_2_, packet.ahead);
    const VU further =
        hn::Add(ahead_by_2, Choose(side[1], u_by_2, Choose(side[2], v_by_2, hn::Zero(du))));
    packet.first_by_2 = hn::Add(packet.first_by_2, Choose(stay[0], hn::Zero(du), further));
    const VU u = packet.u, v = packet.v, ahead = packet.ahead;
    packet.u = Choose(side[1], hn::Xor(ahead, opposite), Choose(side[3], ahead, u));
    packet.v = Choose(side[0], ahead, Choose(side[2], hn::Xor(ahead, opposite), v));
    packet.ahead = Choose(
        side[0], hn::Xor(v, opposite),
        Choose(side[1], u, Choose(side[2], v, Choose(side[3], hn::Xor(u, opposite), ahead))));
    auto left = hn::MaskFromVec(hn::Zero(du));
    for (std::size_t a = 0; a < 3; ++a) {
      packet.index[a] = hn::Add(packet.index[a], LookUp(move_[a], packet.ahead));
      left = hn::Or(left, hn::Gt(packet.index[a], hn::Set(du, mesh_.dimensions[a] - 2)));
    }
    StoreBack(state, packet);

    StepResult result;
    result.left = hn::RebindMask(d, left);
    if (HWY_UNLIKELY(!mesh_.hidden.empty()))
      result.left = hn::Or(result.left, Hidden(state, packet, result.left));
    MF asks = MaskOfBits(strange);
    if constexpr (kMeasure)
      asks = hn::Or(asks, MeasurePatch(p, hn::Load(d, state.winding), result.z, result.s));
    const unsigned asking = BitsOf(asks) & state.live;
    if (HWY_UNLIKELY(asking != 0)) {
      HWY_ALIGN std::uint32_t cell[kMaxLanes];
      HWY_ALIGN std::uint32_t from[kMaxLanes];
      hn::Store(CellAt(index), du, cell);
      hn::Store(hn::Xor(ahead, opposite), du, from);
      AskWalker(state, packet, asking, cell, from, result);
    }
    return result;
  }

 private:
  static constexpr std::uint32_t kNowhere = 6;  // a direction in which nothing moves

  static HWY_INLINE VF Xor3(VF a, VF b, VF c) { return hn::Xor(a, hn::Xor(b, c)); }
  static HWY_INLINE VF Or3(VF a, VF b, VF c) { return hn::Or(a, hn::Or(b, c)); }

  // Products of the back's corners m with other points, as far as several faces need them.
  struct Products {
    VF with_front[4];  // of corner m and that of the front: q.x * p.y - p.x * q.y
    VF with_next[4];   // of corner m and m + 1
  };

  // Lanes in which a face other than the front of even winding may be crossed twice all the same.
  // `odd_sides` are those of odd winding, and `..._crosses` tells where any edge crosses y = 0.
  template <bool kMeasure>
  static HWY_INLINE VF Grazed(const QuadLanes<kMeasure>& p, const QuadLanes<kMeasure>& q,
                              const VF (&odd_sides)[4], const Products& products, VF back_crosses,
                              const VF (&side_crosses)[4]) {
    const DF d;
    VF x = hn::Zero(d), y = hn::Zero(d);
    for (std::size_t m = 0; m < 4; ++m) {
      x = hn::Max(x, hn::Max(hn::Abs(p.x[m]), hn::Abs(q.x[m])));
      y = hn::Max(y, hn::Max(hn::Abs(p.y[m]), hn::Abs(q.y[m])));
    }
    const GrazeTest test(x, y);
    const auto product = GrazeTest::Product;
    const VF* const k = products.with_next;
    const VF back_odd =
        hn::Not(hn::Xor(hn::Xor(odd_sides[0], odd_sides[1]), hn::Xor(odd_sides[2], odd_sides[3])));
    const VF back_passed = test.PassedBy(k[0], hn::Neg(k[2]), hn::Neg(k[3]), k[1],
                                         product(q.x[0], q.y[0], q.x[2], q.y[2]),
                                         product(q.x[1], q.y[1], q.x[3], q.y[3]));
    VF grazed = hn::AndNot(hn::Or(back_odd, back_passed), back_crosses);
    for (std::size_t m = 0; m < 4; ++m) {
      const std::size_t n = (m + 1) % 4;
      const VF passed = test.PassedBy(
          product(p.x[m], p.y[m], p.x[n], p.y[n]), k[m], hn::Neg(products.with_front[m]),
          hn::Neg(products.with_front[n]), product(p.x[m], p.y[m], q.x[n], q.y[n]),
          product(p.x[n], p.y[n], q.x[m], q.y[m]));
      grazed = hn::Or(grazed, hn::AndNot(hn::Or(odd_sides[m], passed), side_crosses[m]));
    }
    return grazed;
  }

  HWY_INLINE VU CellAt(const VU (&index)[3]) const {
    const DU du;
    const VU i_cells = hn::Set(du, mesh_.dimensions[0] - 1);
    const VU j_cells = hn::Set(du, mesh_.dimensions[1] - 1);
    return hn::Add(index[0], hn::Mul(i_cells, hn::Add(index[1], hn::Mul(j_cells, index[2]))));
  }

  template <bool kMeasure>
  HWY_INLINE void StoreBack(State& state, const Packet<kMeasure>& packet) const {
    const DU du;
    const VU u_by_2 = LookUp(stride_by_2_, packet.u);
    const VU v_by_2 = LookUp(stride_by_2_, packet.v);
    const VU corner = hn::Add(packet.first_by_2, LookUp(stride_by_2_, packet.ahead));
    hn::Store(corner, du, state.back_by_2[0]);
    hn::Store(hn::Add(corner, u_by_2), du, state.back_by_2[1]);
    hn::Store(hn::Add(hn::Add(corner, u_by_2), v_by_2), du, state.back_by_2[2]);
    hn::Store(hn::Add(corner, v_by_2), du, state.back_by_2[3]);
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

  void PutPlace(State& state, std::size_t lane, const GridStart& start) const {
    int winding = 0;
    for (std::size_t m = 0; m < 4; ++m) {
      const ShearedPoint& corner = start.corners[m];
      state.x[m][lane] = corner.x;
      state.y[m][lane] = corner.y;
      state.z[m][lane] = corner.z;
      state.s[m][lane] = corner.scalar;
      const int crosses = crossing(corner, start.corners[(m + 1) % 4]);
      state.right[m][lane] = crosses != 0 ? -1.0f : 1.0f;
      winding += crosses;
    }
    state.winding[lane] = winding < 0 ? -1.0f : 1.0f;
    const std::uint32_t first = 2 * start.first;
    const std::uint32_t u = stride_by_2_[start.u], v = stride_by_2_[start.v];
    const std::uint32_t back = first + stride_by_2_[start.ahead];
    state.first_by_2[lane] = first;
    state.back_by_2[0][lane] = back;
    state.back_by_2[1][lane] = back + u;
    state.back_by_2[2][lane] = back + u + v;
    state.back_by_2[3][lane] = back + v;
    state.u[lane] = start.u;
    state.v[lane] = start.v;
    state.ahead[lane] = start.ahead;
    for (std::size_t a = 0; a < 3; ++a) state.index[a][lane] = start.index[a];
    state.rank[lane] = start.rank;
    state.frame[lane] = start.frame;
  }

  // Takes the step of some lanes over from the scalar walker. `cell` and `from` are the cell and
  // the face by which the ray came into it.
  template <bool kMeasure>
  HWY_NOINLINE void AskWalker(State& state, Packet<kMeasure>& packet, unsigned asking,
                              const std::uint32_t* cell, const std::uint32_t* from,
                              StepResult& result) const {
    AskedLanes<kMeasure> asked(result);
    packet.Store(state);
    for (; asking != 0; asking &= asking - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(asking);
      const ShearedFrame& frame = *state.frame[lane];
      GridWalker walker(mesh_, frame);
      walker.enter({cell[lane], from[lane]}, state.rank[lane]);
      if (!asked.ask(lane, walker)) continue;
      GridStart next;
      set_place(next, mesh_, frame, walker.cell(), walker.face(), walker.rank());
      PutPlace(state, lane, next);
    }
    packet.Load(state);
    asked.put(result);
  }

  const WalkableGrid& mesh_;
  const float* points_;
  const int axis_;
  const bool twisted_;
  // By direction: twice the step from point to point, and what it adds to a cell's index.
  HWY_ALIGN std::uint32_t stride_by_2_[kMaxLanes] = {};
  HWY_ALIGN std::uint32_t move_[3][kMaxLanes] = {};
};

// Walks all rays of `feeder`, whose longest axis is `axis`.
template <class Consumer>
void Walk(const WalkableGrid& mesh, int axis, Consumer& consumer, PacketFeeder& feeder) {
  PacketWalk<GridSteps, kPackets, false, Consumer>(GridSteps(mesh, axis), consumer, feeder).run();
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
