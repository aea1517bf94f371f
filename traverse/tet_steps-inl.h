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

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "hwy/highway.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

struct LaneCorners {
  HWY_ALIGN float x[kMaxLanes];
  HWY_ALIGN float y[kMaxLanes];
  HWY_ALIGN float z[kMaxLanes];
  HWY_ALIGN float s[kMaxLanes];
  HWY_ALIGN std::uint32_t id[kMaxLanes];
  HWY_ALIGN float right[kMaxLanes];
};

// A corner of the triangle by which the lanes' rays come into their cells. Where nothing is
// measured, z and s are left alone.
template <bool kMeasure>
struct Corner {
  VF x, y, z, s;
  VU id;

  HWY_INLINE void Load(const LaneCorners& from) {
    const DF d;
    x = hn::Load(d, from.x);
    y = hn::Load(d, from.y);
    if constexpr (kMeasure) {
      z = hn::Load(d, from.z);
      s = hn::Load(d, from.s);
    }
    id = hn::Load(DU(), from.id);
  }
  HWY_INLINE void Store(LaneCorners& to) const {
    const DF d;
    hn::Store(x, d, to.x);
    hn::Store(y, d, to.y);
    if constexpr (kMeasure) {
      hn::Store(z, d, to.z);
      hn::Store(s, d, to.s);
    }
    hn::Store(id, DU(), to.id);
  }
  // Takes another's place in the lanes whose bit is set.
  HWY_INLINE void Replace(VF bits, const Corner& other) {
    x = Choose(bits, other.x, x);
    y = Choose(bits, other.y, y);
    if constexpr (kMeasure) {
      z = Choose(bits, other.z, z);
      s = Choose(bits, other.s, s);
    }
    id = Choose(bits, other.id, id);
  }
};

struct Nothing {};

// Where rays cross the triangle a, b, c: measure_triangle() in single precision, with products that
// do not cancel. No bound on one crossing has been measured; sums of lengths are
// held against the twin's in tests/traverse/tet_packets_test.cpp.
HWY_INLINE void Measure(const Corner<true>& a, const Corner<true>& b, const Corner<true>& c,
                        StepResult& result) {
  const DF d;
  const VF ab = hn::Xor(a.y, b.y), ac = hn::Xor(a.y, c.y);  // on different sides of y = 0
  const VF lone_b = hn::AndNot(ac, ab), lone_c = hn::AndNot(ab, ac);
  Corner<true> lone = a, p = b, q = c;
  auto place = [&](VF Corner<true>::*of) {
    lone.*of = Choose(lone_b, b.*of, Choose(lone_c, c.*of, a.*of));
    p.*of = Choose(lone_b, a.*of, b.*of);
    q.*of = Choose(lone_c, a.*of, c.*of);
  };
  place(&Corner<true>::x);
  place(&Corner<true>::y);
  place(&Corner<true>::z);
  place(&Corner<true>::s);
  const VF p_height = hn::Sub(p.y, lone.y), q_height = hn::Sub(q.y, lone.y);
  VF p_distance = hn::Abs(DifferenceOfProducts(lone.x, p.y, p.x, lone.y));
  VF q_distance = hn::Abs(DifferenceOfProducts(lone.x, q.y, q.x, lone.y));
  // Only their ratio counts: brought to about 1 by a power of two, so that no product of three
  // coordinates underflows.
  const DU du;
  const VU exponent =
      hn::And(hn::BitCast(du, hn::Max(p_distance, q_distance)), hn::Set(du, 0x7F800000u));
  const VF scale = hn::BitCast(d, hn::Sub(hn::Set(du, 0x7F000000u), exponent));
  p_distance = hn::Mul(p_distance, scale);
  // If both edges pass through the ray, one of them will do.
  q_distance = hn::Max(hn::Mul(q_distance, scale), hn::Set(d, 1e-30f));
  const VF share = hn::Div(lone.y, hn::MulAdd(p_distance, q_height, hn::Mul(q_distance, p_height)));
  const VF of_p = hn::Mul(q_distance, share), of_q = hn::Mul(p_distance, share);  // negative
  result.z =
      hn::NegMulAdd(of_p, hn::Sub(p.z, lone.z), hn::NegMulAdd(of_q, hn::Sub(q.z, lone.z), lone.z));
  result.s =
      hn::NegMulAdd(of_p, hn::Sub(p.s, lone.s), hn::NegMulAdd(of_q, hn::Sub(q.s, lone.s), lone.s));
}

// TetWalker::decide() and advance(), a ray a lane (see PacketWalk). With kLarge the mesh is larger
// than the caches.
template <int kAxis, bool kLarge>
class TetSteps {
 public:
  using Start = TetStart;
  static constexpr bool kInRegisters = true;

  // Whether the next apexes' points are fetched at the end of a step rather than at the beginning
  // of the next one: out of the way of what the packets in between compute, and asked for as early
  // as can be. With 16 lanes and a measured face, or beyond the caches, that is a tenth faster
  // (blunt fin's integral, 10 million cells); otherwise registers run out, and it is as much
  // slower.
  template <bool kMeasure>
  static constexpr bool kAhead = HWY_TARGET <= HWY_AVX3&& HWY_ARCH_X86 && (kMeasure || kLarge);

  // Corners are written here only while a lane is given a ray; `cells_by_4` and `apex_by_2` always,
  // as places to load from.
  struct State : LaneState {
    HWY_ALIGN std::uint32_t cells_by_4[kMaxLanes];
    HWY_ALIGN std::uint32_t apex_by_2[kMaxLanes];
    LaneCorners corners[3];
  };

  template <bool kMeasure>
  struct Packet : SegmentStart<kMeasure> {
    Corner<kMeasure> a, b, c;
    VU apex;
    VF right_a, right_c;  // whether the edges across from a and c cross on the right
    // The apex', where it is known.
    [[no_unique_address]] std::conditional_t<kAhead<kMeasure>, FourFloats, Nothing> point;

    HWY_INLINE void Load(const State& state) {
      const DF d;
      SegmentStart<kMeasure>::Load(state);
      a.Load(state.corners[0]);
      b.Load(state.corners[1]);
      c.Load(state.corners[2]);
      apex = hn::ShiftRight<1>(hn::Load(DU(), state.apex_by_2));
      right_a = hn::Load(d, state.corners[0].right);
      right_c = hn::Load(d, state.corners[2].right);
    }
    HWY_INLINE void Store(State& state) const {
      const DF d;
      SegmentStart<kMeasure>::Store(state);
      a.Store(state.corners[0]);
      b.Store(state.corners[1]);
      c.Store(state.corners[2]);
      hn::Store(right_a, d, state.corners[0].right);
      hn::Store(right_c, d, state.corners[2].right);
    }
  };

  explicit TetSteps(const WalkableTets& mesh)
      : cells_(mesh.cells.data()), points_(mesh.points.data()->position) {}

  static void Put(State& state, std::size_t lane, const TetStart& start) {
    state.put(lane, start);
    for (std::size_t c = 0; c < 3; ++c) {
      LaneCorners& corner = state.corners[c];
      corner.x[lane] = start.corners[c].x;
      corner.y[lane] = start.corners[c].y;
      corner.z[lane] = start.corners[c].z;
      corner.s[lane] = start.corners[c].scalar;
      corner.id[lane] = start.ids[c];
      corner.right[lane] = start.right[c] ? -1.0f : 1.0f;
    }
    state.cells_by_4[lane] = 4 * start.cell;
    state.apex_by_2[lane] = 2 * start.apex;
  }
  // From cell 0 to wherever numbers lead.
  static void PutNothing(State& state, std::size_t lane) { Put(state, lane, TetStart{}); }

  template <bool kMeasure>
  HWY_INLINE VU Cells(const State& state, const Packet<kMeasure>&) const {
    return hn::ShiftRight<2>(hn::Load(DU(), state.cells_by_4));
  }

  template <bool kMeasure>
  HWY_INLINE void Prefetch(const State& state, const Packet<kMeasure>&) const {
    HWY_NAMESPACE::Prefetch(reinterpret_cast<const float*>(cells_), state.cells_by_4);
    if constexpr (!kAhead<kMeasure>) HWY_NAMESPACE::Prefetch(points_, state.apex_by_2);
  }

  template <bool kMeasure>
  HWY_INLINE void FetchAhead(const State& state, Packet<kMeasure>& packet) const {
    if constexpr (kAhead<kMeasure>) packet.point = LoadFour(points_, state.apex_by_2);
  }

  template <bool kMeasure>
  HWY_INLINE StepResult Step(State& state, Packet<kMeasure>& packet) const {
    const DF d;
    const DU du;
    const std::conditional_t<kLarge, LinkEach, LanesLinks> links(cells_, state.cells_by_4);
    const ShearedLanes at = [&] {
      if constexpr (kAhead<kMeasure>)
        return Shear(packet.point, kAxis, state);
      else
        return Shear(LoadFour(points_, state.apex_by_2), kAxis, state);
    }();
    Corner<kMeasure> apex;
    apex.x = at.x;
    apex.y = at.y;
    apex.z = at.z;
    apex.s = at.s;
    apex.id = packet.apex;

    Corner<kMeasure>&a = packet.a, &b = packet.b, &c = packet.c;
    // Right of the ray: low.x * high.y > high.x * low.y, where the apex is high if it is up and low
    // otherwise; then both products change their signs, and no rounding does. The sign of the
    // products' difference is that of the comparison; adding zero makes -0 a 0, whose difference
    // from 0 has no sign.
    const VF y = hn::Abs(apex.y);
    const VF x = hn::Xor(apex.x, hn::And(apex.y, hn::SignBit(d)));
    auto crosses_right = [&](const Corner<kMeasure>& corner) {
      const VF right = hn::Sub(hn::MulAdd(x, corner.y, hn::Zero(d)), hn::Mul(corner.x, y));
      return hn::And(right, hn::Xor(corner.y, apex.y));
    };
    const VF to_a = crosses_right(a), to_b = crosses_right(b), to_c = crosses_right(c);
    // The faces that leave out a, b, c: one of them winds.
    VF out_a = hn::Xor(packet.right_a, hn::Xor(to_b, to_c));
    VF out_c = hn::Xor(packet.right_c, hn::Xor(to_a, to_b));
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

    const VU behind = Choose(out_a, a.id, Choose(out_b, b.id, c.id));
    // The rank of the corner left behind, as minus the sum of true comparisons.
    auto below = [&](VU id) { return hn::VecFromMask(du, hn::Lt(id, behind)); };
    const VU rank = hn::Sub(hn::Zero(du), hn::Add(hn::Add(below(a.id), below(b.id)),
                                                  hn::Add(below(c.id), below(apex.id))));
    const Links next = links.pick(rank);
    packet.right_a = Choose(out_b, to_c, Choose(out_c, to_b, packet.right_a));
    packet.right_c = Choose(out_a, to_b, Choose(out_b, to_a, packet.right_c));
    a.Replace(out_a, apex);
    b.Replace(out_b, apex);
    c.Replace(out_c, apex);

    // A lane that has left goes on in cell 0 until it is given another ray.
    const auto left = hn::Eq(next.cell, hn::Set(du, kNone));
    hn::Store(hn::IfThenZeroElse(left, hn::ShiftLeft<2>(next.cell)), du, state.cells_by_4);
    hn::Store(hn::Add(next.apex, next.apex), du, state.apex_by_2);
    packet.apex = next.apex;
    FetchAhead(state, packet);

    StepResult result;
    result.left = hn::RebindMask(d, left);
    if constexpr (kMeasure) Measure(a, b, c, result);
    return result;
  }

 private:
  const WalkableTets::Cell* cells_;
  const float* points_;
};

// Walks all rays of `feeder`, whose longest axis is `axis`; more packets with prefetching on meshes
// that are larger than the caches.
template <class Consumer>
void Walk(const WalkableTets& mesh, int axis, Consumer& consumer, PacketFeeder& feeder) {
  constexpr std::size_t kLargeMesh = 500000;  // cells
  auto walk = [&]<int kAxis>() {
    if (mesh.cells.size() < kLargeMesh) {
      const TetSteps<kAxis, false> steps(mesh);
      PacketWalk<TetSteps<kAxis, false>, kPackets, false, Consumer>(steps, consumer, feeder).run();
    } else {
      const TetSteps<kAxis, true> steps(mesh);
      PacketWalk<TetSteps<kAxis, true>, kMaxPackets, true, Consumer>(steps, consumer, feeder).run();
    }
  };
  switch (axis) {
    case 0:
      return walk.template operator()<0>();
    case 1:
      return walk.template operator()<1>();
    default:
      return walk.template operator()<2>();
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
