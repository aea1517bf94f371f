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
#include <optional>

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
// the scalar walker for the face that they leave by.
//
// A cell is seen from the face by which the ray comes in, the front: its corners 0 to 3 go around
// it, corner m of the back is joined to corner m of the front, and side m has the corners m and
// m + 1 of both. A quadrilateral winds about the ray an odd number of times if and only if an odd
// number of its edges crosses y = 0 on the ray's right. The front does, so one of the back and the
// sides does, or three, or all. The face left by is the next cell's front: corners and edges that
// it keeps keep their places, so that its loop winds about the ray in the same direction.
//
// Most of what is asked are excursions: out of the cell by a twisted face that the ray grazes, into
// the cell behind it, and back by the same face. They are asked for once: both places where the
// face is crossed and the face left by in the end are known from then on.
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
    // Of the front's loop about the ray, or of that crossing alone where there are two; its sign
    // counts.
    HWY_ALIGN float winding[kMaxLanes];
    // Which of the front's crossings it is (see pair_crossings.h); known where there are two.
    HWY_ALIGN std::uint32_t rank[kMaxLanes];
    const ShearedFrame* frame[kMaxLanes];

    // Of the excursion that a lane whose front is grazed is on; the cell is kNone where nothing is
    // known of it.
    HWY_ALIGN std::uint32_t excursion_cell[kMaxLanes];  // that it left and will come back to
    HWY_ALIGN std::uint32_t excursion_exit[kMaxLanes];  // the face by which it leaves that then
    HWY_ALIGN float excursion_z[kMaxLanes];             // where it comes back
    HWY_ALIGN float excursion_s[kMaxLanes];

    // What Decide() found: the face that a lane leaves by (kNowhere: by none), and where, if that
    // is known.
    HWY_ALIGN std::uint32_t exit[kMaxLanes] = {};
    HWY_ALIGN float exit_z[kMaxLanes] = {};
    HWY_ALIGN float exit_s[kMaxLanes] = {};
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

  HWY_INLINE void Prefetch(const State& state) const {
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

    // Lanes in which it is not clear by which face the ray leaves: the front winds an even number
    // of times, or several sides wind, or a face has, or may have, two crossings (`doubtful`).
    VF several = hn::And(side[0], side[1]);
    several = hn::Or(several, hn::And(hn::Or(side[0], side[1]), side[2]));
    several = hn::Or(several, hn::And(hn::Or(hn::Or(side[0], side[1]), side[2]), side[3]));
    const VF odd = Xor3(right[0], right[1], hn::Xor(right[2], right[3]));
    VF before[4];  // the front's edges: do they cross y = 0?
    for (std::size_t m = 0; m < 4; ++m) before[m] = hn::Xor(p.y[m], p.y[(m + 1) % 4]);
    VF doubtful = WindsTwice(along[0], along[1], along[2], right_along[0], right_along[1],
                             right_along[2], right_along[3]);
    for (std::size_t m = 0; m < 4; ++m) {
      const std::size_t n = (m + 1) % 4;
      doubtful = hn::Or(doubtful, WindsTwice(before[m], across[n], along[m], right[m],
                                             right_across[n], right_along[m], right_across[m]));
    }
    if (twisted_) {
      // Faces with all corners on one side of y = 0 (or in one place) are not crossed.
      const VF back_crosses = Or3(along[0], along[1], along[2]);
      VF side_crosses[4];
      for (std::size_t m = 0; m < 4; ++m)
        side_crosses[m] = Or3(before[m], across[(m + 1) % 4], along[m]);
      doubtful = hn::Or(doubtful, Grazed(p, q, odd, side, products, back_crosses, side_crosses));
    }
    const VF strange = Or3(several, hn::Not(odd), doubtful);

    StepResult result;
    result.left = hn::MaskFromVec(hn::Zero(d));
    MF measured = result.left;
    const VU opposite = hn::Set(du, 1);
    if (HWY_UNLIKELY((BitsOf(MaskOfBits(strange)) & state.live) != 0)) {
      const VF others = Or3(hn::Or(side[0], side[1]), hn::Or(side[2], side[3]), doubtful);
      measured = Decide(state, packet, strange, hn::Not(odd), hn::Not(hn::Or(odd, others)));
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
    auto left = hn::RebindMask(du, result.left);
    for (std::size_t a = 0; a < 3; ++a) {
      packet.index[a] = hn::Add(packet.index[a], LookUp(move_[a], packet.ahead));
      left = hn::Or(left, hn::Gt(packet.index[a], hn::Set(du, mesh_.dimensions[a] - 2)));
    }
    StoreBack(state, packet);

    result.left = hn::RebindMask(d, left);
    if (HWY_UNLIKELY(!mesh_.hidden.empty()))
      result.left = hn::Or(result.left, Hidden(state, packet, result.left));
    if constexpr (kMeasure) {
      const MF beside = MeasurePatch(p, hn::Load(d, state.winding), result.z, result.s);
      result.z = hn::IfThenElse(measured, hn::Load(d, state.exit_z), result.z);
      result.s = hn::IfThenElse(measured, hn::Load(d, state.exit_s), result.s);
      const unsigned asking = BitsOf(hn::AndNot(measured, beside)) & state.live;
      if (HWY_UNLIKELY(asking != 0)) MeasureAgain(state, packet, asking, result);
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
  // `odd_front` and `odd_sides` are of odd winding; `..._crosses` tells where any edge crosses
  // y = 0.
  template <bool kMeasure>
  static HWY_INLINE VF Grazed(const QuadLanes<kMeasure>& p, const QuadLanes<kMeasure>& q,
                              VF odd_front, const VF (&odd_sides)[4], const Products& products,
                              VF back_crosses, const VF (&side_crosses)[4]) {
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
        Xor3(odd_front, hn::Xor(odd_sides[0], odd_sides[1]), hn::Xor(odd_sides[2], odd_sides[3]));
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
    if (winding == 0) winding = start.rank == 0 ? 1 : -1;
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
    state.excursion_cell[lane] = kNone;
  }

  // Finds the faces that the `strange` lanes leave by. `grazed`: lanes whose front has even
  // winding; `alone`: those that cross no other face either. Returned are the lanes of which it is
  // known where they leave.
  template <bool kMeasure>
  HWY_INLINE MF Decide(State& state, const Packet<kMeasure>& packet, VF strange, VF grazed,
                       VF alone) const {
    const DF d;
    const DU du;
    const VU cell = CellAt(packet.index), from = hn::Xor(packet.ahead, hn::Set(du, 1));
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

  // Asks the scalar walker for the faces by which lanes leave their cells, having come `from`
  // those.
  HWY_NOINLINE void AskWalkers(State& state, unsigned asking, VU cells, VU from) const {
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

  // Has the scalar walker measure where lanes have come through their fronts.
  template <bool kMeasure>
  HWY_NOINLINE void MeasureAgain(const State& state, const Packet<kMeasure>& packet,
                                 unsigned asking, StepResult& result) const {
    const DF d;
    const DU du;
    HWY_ALIGN std::uint32_t cell[kMaxLanes], face[kMaxLanes];
    HWY_ALIGN float z[kMaxLanes], s[kMaxLanes];
    VU index[3];  // of the cell before
    for (std::size_t a = 0; a < 3; ++a)
      index[a] = hn::Sub(packet.index[a], LookUp(move_[a], packet.ahead));
    hn::Store(CellAt(index), du, cell);
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
        hn::Sub(packet.first_by_2, Choose(turned, LookUp(stride_by_2_, behind), hn::Zero(du)));
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
