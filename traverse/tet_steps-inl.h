// Steps through tetrahedra. Compiled once for each instruction set: to be included after
// hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_TET_STEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_TET_STEPS_INL_H_
#undef PLUME_TRAVERSE_TET_STEPS_INL_H_
#else
#define PLUME_TRAVERSE_TET_STEPS_INL_H_
#endif
// clang-format on

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "hwy/highway.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"
#include "plume/traverse/tet_corners-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// What cells are read by.
enum class TetReads { cached, large, compact };

// TetWalker::decide() and advance(), a ray a lane (see PacketWalk).
//
// Of a mesh that is larger than the caches only the link that is followed is loaded; of compact
// cells all 16 bytes, and the apex is worked out from them.
template <int kAxis, TetReads kReads>
class TetSteps {
 public:
  using Start = TetStart;
  static constexpr bool kMayWait = true;
  static constexpr bool kCompact = kReads == TetReads::compact;

  // Corners are written here only while a lane is given a ray; `cells` and `apex_by_2` always, as
  // places to load from, in steps of 8 bytes. `previous` is for compact cells.
  static constexpr int kShift = kCompact ? 1 : 2;
  struct State : LaneState {
    HWY_ALIGN std::uint32_t cells[kMaxLanes];
    HWY_ALIGN std::uint32_t apex_by_2[kMaxLanes];
    HWY_ALIGN std::uint32_t previous[kMaxLanes];
    LaneCorners corners[3];
  };

  template <bool kMeasure>
  struct Packet : SegmentStart<kMeasure> {
    Corner<kMeasure> a, b, c;
    VU previous;    // the cells that compact ones were come to from
    Across across;  // of b, and of products' sizes, nothing where nothing is measured

    HWY_INLINE void Load(const State& state) {
      const DF d;
      SegmentStart<kMeasure>::Load(state);
      a.Load(state.corners[0]);
      b.Load(state.corners[1]);
      c.Load(state.corners[2]);
      if constexpr (kCompact) previous = hn::Load(DU(), state.previous);
      across.a = hn::Load(d, state.corners[0].across);
      if constexpr (kMeasure) across.b = hn::Load(d, state.corners[1].across);
      across.c = hn::Load(d, state.corners[2].across);
    }
    HWY_INLINE void Store(State& state) const {
      const DF d;
      SegmentStart<kMeasure>::Store(state);
      a.Store(state.corners[0]);
      b.Store(state.corners[1]);
      c.Store(state.corners[2]);
      hn::Store(across.a, d, state.corners[0].across);
      if constexpr (kMeasure) hn::Store(across.b, d, state.corners[1].across);
      hn::Store(across.c, d, state.corners[2].across);
      if constexpr (kCompact) hn::Store(previous, DU(), state.previous);
    }
  };

  explicit TetSteps(const WalkableTets& mesh)
      : mesh_(mesh), points_(mesh.points.data()->position) {}

  static void Put(State& state, std::size_t lane, const TetStart& start) {
    state.put(lane, start);
    for (std::size_t c = 0; c < 3; ++c) {
      LaneCorners& corner = state.corners[c];
      corner.x[lane] = start.corners[c].x;
      corner.y[lane] = start.corners[c].y;
      corner.z[lane] = start.corners[c].z;
      corner.s[lane] = start.corners[c].scalar;
      corner.id[lane] = start.ids[c];
      const ShearedPoint& p = start.corners[(c + 1) % 3];
      const ShearedPoint& q = start.corners[(c + 2) % 3];
      corner.across[lane] = std::copysign(SizeOf(p, q), start.right[c] ? -1.0f : 1.0f);
    }
    state.cells[lane] = start.cell << kShift;
    state.apex_by_2[lane] = 2 * start.apex;
    state.previous[lane] = kNone;
  }
  // From cell 0 to wherever numbers lead.
  static void PutNothing(State& state, std::size_t lane) { Put(state, lane, TetStart{}); }

  template <bool kMeasure>
  HWY_INLINE VU Cells(const State& state, const Packet<kMeasure>&) const {
    return hn::ShiftRight<kShift>(hn::Load(DU(), state.cells));
  }

  // Points are asked for by so many cells that they mostly are at hand.
  template <bool kMeasure>
  HWY_INLINE void Prefetch(const State& state, const Packet<kMeasure>&) const {
    const auto* const whole = reinterpret_cast<const float*>(mesh_.cells.data());
    HWY_NAMESPACE::Prefetch(kCompact ? compact_cells() : whole, state.cells);
  }

  template <bool kMeasure>
  HWY_INLINE StepResult Step(State& state, Packet<kMeasure>& packet) const {
    return Step<false>(hn::Zero(DF()), state, packet);
  }
  HWY_INLINE StepResult StepUnless(VF waits, State& state, Packet<true>& packet) const {
    return Step<true>(waits, state, packet);
  }

 private:
  template <bool kWaits, bool kMeasure>
  HWY_INLINE StepResult Step(VF waits, State& state, Packet<kMeasure>& packet) const {
    const DF d;
    const DU du;
    const auto cells = read_cells(state, packet);
    const ShearedLanes at = Shear(LoadFour(points_, state.apex_by_2), kAxis, state);
    Corner<kMeasure> apex;
    apex.x = at.x;
    apex.y = at.y;
    apex.z = at.z;
    apex.s = at.s;
    apex.id = hn::ShiftRight<1>(hn::Load(du, state.apex_by_2));

    Corner<kMeasure>&a = packet.a, &b = packet.b, &c = packet.c;
    // Right of the ray: low.x * high.y > high.x * low.y, where the apex is high if it is up and low
    // otherwise; then both products change their signs, and no rounding does. The sign of the
    // products' difference is that of the comparison; adding zero makes -0 a 0, whose difference
    // from 0 has no sign.
    const VF y = hn::Abs(apex.y);
    const VF x = hn::Xor(apex.x, hn::And(apex.y, hn::SignBit(d)));
    auto crosses_right = [&](const Corner<kMeasure>& corner) {
      const VF product = hn::Mul(corner.x, y);
      const VF right = hn::Sub(hn::MulAdd(x, corner.y, hn::Zero(d)), product);
      const VF bit = hn::And(right, hn::Xor(corner.y, apex.y));
      if constexpr (!kMeasure || !kByWeights) return bit;
      // DifferenceOfProducts(x, corner.y, corner.x, y), no number where the sign is not what was
      // decided.
      const VF error = hn::NegMulAdd(corner.x, y, product);
      const VF size = hn::Add(hn::MulSub(x, corner.y, product), error);
      return hn::CopySign(hn::Or(size, AllBits(hn::Xor(size, right))), bit);
    };
    const VF to_a = crosses_right(a), to_b = crosses_right(b), to_c = crosses_right(c);
    // The faces that leave out a, b, c: one of them winds.
    VF out_a = hn::Xor(packet.across.a, hn::Xor(to_b, to_c));
    VF out_c = hn::Xor(packet.across.c, hn::Xor(to_a, to_b));
    VF out_b = hn::Not(hn::Xor(out_a, out_c));
    const VF all = hn::And(out_a, out_c);
    if (HWY_UNLIKELY(!hn::AllFalse(d, MaskOfBits(all)))) {
      // ... or all three: TetWalker::way_out_of_two().
      auto smaller = [&](VU m, VU n) { return hn::BitCast(d, hn::VecFromMask(du, hn::Lt(m, n))); };
      const VF in_a = hn::Not(hn::Xor(a.y, apex.y)), in_c = hn::Not(hn::Xor(c.y, apex.y));
      const VU in = Choose(in_a, a.id, Choose(in_c, c.id, b.id));
      const VU p = Choose(in_a, b.id, a.id), q = Choose(in_c, b.id, c.id);
      const VF take_p = hn::Not(hn::Xor(smaller(apex.id, in), smaller(p, q)));
      out_a = Choose(all, hn::AndNot(in_a, take_p), out_a);
      out_c = Choose(all, hn::AndNot(in_c, hn::Not(take_p)), out_c);
      out_b = Choose(all, hn::Not(hn::Or(out_a, out_c)), out_b);
    }

    const VU behind = Choose(out_c, c.id, Choose(out_a, a.id, b.id));
    const Links next = next_cells(cells, packet, Rank(behind, a.id, b.id, c.id, apex.id), apex.id);
    if constexpr (kWaits) {
      out_a = hn::AndNot(waits, out_a);
      out_b = hn::AndNot(waits, out_b);
      out_c = hn::AndNot(waits, out_c);
    }
    Across& across = packet.across;
    across.a = Choose(out_b, to_c, Choose(out_c, to_b, across.a));
    if constexpr (kMeasure) across.b = Choose(out_c, to_a, Choose(out_a, to_c, across.b));
    across.c = Choose(out_a, to_b, Choose(out_b, to_a, across.c));
    a.Replace(out_a, apex);
    b.Replace(out_b, apex);
    c.Replace(out_c, apex);

    // A lane that has left goes on in cell 0 until it is given another ray: through compact cells,
    // which mean nothing without a way in, to any number.
    auto left = hn::Eq(next.cell, hn::Set(du, kNone));
    if constexpr (kCompact) left = hn::Gt(next.cell, hn::Set(du, last_cell_));
    auto go_to = [&](VU there, VU here) {
      if constexpr (kWaits) return Choose(waits, here, there);
      return there;
    };
    const VU cell = hn::Load(du, state.cells);
    if constexpr (kCompact)
      packet.previous = go_to(hn::ShiftRight<kShift>(cell), packet.previous);
    else
      hn::Store(go_to(hn::Add(next.apex, next.apex), hn::Load(du, state.apex_by_2)), du,
                state.apex_by_2);
    hn::Store(go_to(hn::IfThenZeroElse(left, hn::ShiftLeft<kShift>(next.cell)), cell), du,
              state.cells);

    StepResult result;
    result.left = hn::RebindMask(d, left);
    if constexpr (kMeasure) Measure(a, b, c, across, result);
    return result;
  }

  // What compact cells say of the lanes' neighbours.
  struct CompactLanes {
    VU of_1, of_2, of_3;

    HWY_INLINE VU Sum(VU face) const {
      const DU du;
      auto is = [&](std::uint32_t rank) { return hn::Eq(face, hn::Set(du, rank)); };
      return hn::IfThenElse(is(1), of_1,
                            hn::IfThenElse(is(2), of_2, hn::IfThenElseZero(is(3), of_3)));
    }
    // WalkableTets::CompactCell::neighbor().
    HWY_INLINE VU neighbor(VU out, VU in, VU across_in) const {
      return hn::Xor(across_in, hn::Xor(Sum(in), Sum(out)));
    }
  };

  // What the edge between two corners spans with the ray; no number where rounded products, by
  // which crossing() decides, have another order.
  static float SizeOf(const ShearedPoint& p, const ShearedPoint& q) {
    const double exact = static_cast<double>(p.x) * q.y - static_cast<double>(q.x) * p.y;
    const float one = p.x * q.y, other = q.x * p.y;
    const bool as_decided = exact < 0 ? one < other : exact > 0 ? one > other : true;
    return as_decided ? static_cast<float>(std::abs(exact))
                      : std::numeric_limits<float>::quiet_NaN();
  }

  // How many of the four are below it: numbers of points are below 2^31.
  static HWY_INLINE VU Rank(VU id, VU a, VU b, VU c, VU d) {
    auto below = [&](VU other) { return hn::ShiftRight<31>(hn::Sub(other, id)); };
    return hn::Add(hn::Add(below(a), below(b)), hn::Add(below(c), below(d)));
  }

  const float* compact_cells() const {
    return reinterpret_cast<const float*>(mesh_.compact_cells.data());
  }

  // Of compact cells, what they say of neighbours; the apex' place is left in the state.
  template <bool kMeasure>
  HWY_INLINE auto read_cells(State& state, const Packet<kMeasure>& packet) const {
    if constexpr (!kCompact) {
      using Reader = std::conditional_t<kReads == TetReads::large, LinkEach, LanesLinks>;
      return Reader(mesh_.cells.data(), state.cells);
    } else {
      static_assert(sizeof(WalkableTets::CompactCell) == 16);
      const DU du;
      const FourFloats cell = LoadFour(compact_cells(), state.cells);
      const VU sum = hn::Xor(packet.a.id, hn::Xor(packet.b.id, packet.c.id));
      // Lanes without a ray may come to any number.
      const VU apex = hn::Min(hn::Xor(hn::BitCast(du, cell.a), sum), hn::Set(du, last_point_));
      hn::Store(hn::Add(apex, apex), du, state.apex_by_2);
      return CompactLanes{hn::BitCast(du, cell.b), hn::BitCast(du, cell.c),
                          hn::BitCast(du, cell.d)};
    }
  }

  // Across the faces of these ranks. Of compact cells the apex is not known yet.
  template <class Cells, bool kMeasure>
  static HWY_INLINE Links next_cells(const Cells& cells, const Packet<kMeasure>& packet, VU rank,
                                     VU apex) {
    if constexpr (!kCompact) {
      return cells.pick(rank);
    } else {
      const VU in = Rank(apex, packet.a.id, packet.b.id, packet.c.id, apex);
      return {cells.neighbor(rank, in, packet.previous), hn::Zero(DU())};
    }
  }

  const WalkableTets& mesh_;
  const float* points_;
  const std::uint32_t last_cell_ = static_cast<std::uint32_t>(mesh_.cell_count()) - 1;
  const std::uint32_t last_point_ = static_cast<std::uint32_t>(mesh_.points.size()) - 1;
};

// Calls walk.operator()<kAxis>() for the axis, 0 to 2.
template <class WalkAlong>
HWY_INLINE void WithAxis(int axis, const WalkAlong& walk) {
  switch (axis) {
    case 0:
      return walk.template operator()<0>();
    case 1:
      return walk.template operator()<1>();
    default:
      return walk.template operator()<2>();
  }
}

// Walks all rays of `feeder`, whose longest axis is `axis`.
template <class Consumer>
void Walk(const WalkableTets& mesh, int axis, Consumer& consumer, PacketFeeder& feeder) {
  constexpr std::size_t kLargeMesh = 500000;  // cells
  auto walk_by = [&]<int kAxis, TetReads kReads, std::size_t kCount, bool kPrefetch>() {
    using Steps = TetSteps<kAxis, kReads>;
    PacketWalk<Steps, kCount, kPrefetch, Consumer>(Steps(mesh), consumer, feeder).run();
  };
  auto walk = [&]<int kAxis>() {
    if (mesh.is_compact())
      return walk_by.template operator()<kAxis, TetReads::compact, kAheadPackets, true>();
    if (mesh.cell_count() < kLargeMesh) {
      constexpr TetReads kCached =
          std::is_same_v<LanesLinks, LinkEach> ? TetReads::large : TetReads::cached;
      // A step that only counts is so short that the loads which ask ahead are a good part of it.
      if constexpr (!Consumer::kMeasure)
        return walk_by.template operator()<kAxis, kCached, kPackets, false>();
      if constexpr (kCached != TetReads::large)
        return walk_by.template operator()<kAxis, kCached, kAheadPackets, true>();
    }
    walk_by.template operator()<kAxis, TetReads::large, kAheadPackets, true>();
  };
  WithAxis(axis, walk);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
