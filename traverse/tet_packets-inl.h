// Walking tetrahedra with packets of rays. Compiled once for each instruction set: to be included
// after hwy/foreach_target.h alone (see tet_packets.cpp).
//
// Each lane of a packet walks a ray of its own; several packets take turns, so that while one waits
// for memory the others compute. A lane whose ray has ended is given the next one when it is its
// packet's turn again: what decides that has been known for long by then, so that a branch that was
// guessed wrong costs little. The decisions are TetWalker's, bit for bit: the same products of the
// same sheared vertices are compared, none is fused with a sum. (Where a host program has numbers
// below 1e-38 flushed to zero, products that differ by less are taken as equal.)
//
// A bit of a lane is the sign of a float.

// clang-format off
#if defined(PLUME_TRAVERSE_TET_PACKETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_TET_PACKETS_INL_H_
#undef PLUME_TRAVERSE_TET_PACKETS_INL_H_
#else
#define PLUME_TRAVERSE_TET_PACKETS_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <utility>

#include "hwy/highway.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_start.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Packets that take turns; on meshes larger than the caches, where they ask ahead, some 64 rays on
// their way. (Counting cells, AVX-512 on 50 million: 3.06 times the benchmarks' baseline with 4
// packets, 2.90 with 8. AVX2 on 10 million: 3.4 with 8 that ask ahead, 2.9 with 4 that do not.)
constexpr std::size_t kPackets = 4;
constexpr std::size_t kMaxPackets = HWY_TARGET <= HWY_AVX3 ? 4 : 8;
static_assert(kPackets <= kMaxPackets && kMaxPackets * kMaxLanes <= kMaxPacketLanes);

// What a packet's lanes are given, as arrays, so that a lane can be given another ray. Corners are
// written there only while that is done; `cells_by_4` and `apex_by_2` always, as places to load
// from.
struct PacketState {
  struct LaneCorners {
    HWY_ALIGN float x[kMaxLanes];
    HWY_ALIGN float y[kMaxLanes];
    HWY_ALIGN float z[kMaxLanes];
    HWY_ALIGN float s[kMaxLanes];
    HWY_ALIGN std::uint32_t id[kMaxLanes];
    HWY_ALIGN float right[kMaxLanes];
  };
  HWY_ALIGN std::uint32_t cells_by_4[kMaxLanes];
  HWY_ALIGN std::uint32_t apex_by_2[kMaxLanes];
  HWY_ALIGN float slope_x[kMaxLanes];
  HWY_ALIGN float slope_y[kMaxLanes];
  HWY_ALIGN float offset_x[kMaxLanes];
  HWY_ALIGN float offset_y[kMaxLanes];
  HWY_ALIGN float t_per_z[kMaxLanes];
  HWY_ALIGN float z_in[kMaxLanes];
  HWY_ALIGN float s_in[kMaxLanes];
  HWY_ALIGN std::uint32_t active[kMaxLanes];  // all ones or zero
  LaneCorners corners[3];
  std::uint32_t begun[kMaxLanes];  // the packet's turn when the lane's ray came in
  std::uint32_t turn = 0;
  unsigned live = 0;   // lanes that have a ray
  unsigned ended = 0;  // those whose ray has ended
  bool refilled = false;
};

// x * y - z * w without the cancellation that single precision would suffer: the error is below two
// units in the last place of the result where a fused multiply-add is at hand.
// Source: Jeannerod, Louvet, Muller, "Further analysis of Kahan's algorithm for the accurate
// computation of 2x2 determinants" (Math. Comp. 82, 2013).
HWY_INLINE VF DifferenceOfProducts(VF x, VF y, VF z, VF w) {
  const VF zw = hn::Mul(z, w);
  const VF error = hn::NegMulAdd(z, w, zw);
  return hn::Add(hn::MulSub(x, y, zw), error);
}

// A corner of the triangle by which the lanes' rays come into their cells. Where nothing is
// measured, z and s are left alone.
template <bool kMeasure>
struct Corner {
  VF x, y, z, s;
  VU id;

  HWY_INLINE void Load(const PacketState::LaneCorners& from) {
    const DF d;
    x = hn::Load(d, from.x);
    y = hn::Load(d, from.y);
    if constexpr (kMeasure) {
      z = hn::Load(d, from.z);
      s = hn::Load(d, from.s);
    }
    id = hn::Load(DU(), from.id);
  }
  HWY_INLINE void Store(PacketState::LaneCorners& to) const {
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

// What changes with every step of a packet: in registers as far as there are any.
template <bool kMeasure>
struct Packet {
  Corner<kMeasure> a, b, c;
  VU apex;
  VF right_a, right_c;  // whether the edges across from a and c cross on the right
  VF z_in, s_in;

  HWY_INLINE void Load(const PacketState& state) {
    const DF d;
    a.Load(state.corners[0]);
    b.Load(state.corners[1]);
    c.Load(state.corners[2]);
    apex = hn::ShiftRight<1>(hn::Load(DU(), state.apex_by_2));
    right_a = hn::Load(d, state.corners[0].right);
    right_c = hn::Load(d, state.corners[2].right);
    if constexpr (kMeasure) {
      z_in = hn::Load(d, state.z_in);
      s_in = hn::Load(d, state.s_in);
    }
  }
  HWY_INLINE void Store(PacketState& state) const {
    const DF d;
    a.Store(state.corners[0]);
    b.Store(state.corners[1]);
    c.Store(state.corners[2]);
    hn::Store(right_a, d, state.corners[0].right);
    hn::Store(right_c, d, state.corners[2].right);
    if constexpr (kMeasure) {
      hn::Store(z_in, d, state.z_in);
      hn::Store(s_in, d, state.s_in);
    }
  }
};

// Where rays cross the faces that they leave by, and which of them have left the mesh.
struct StepResult {
  VF z, s;
  MF left;
};

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

// One step of a packet: TetWalker::decide() and advance(). `kAxis` is the rays' longest axis, the
// same for all lanes.
template <int kAxis, bool kMeasure>
HWY_INLINE StepResult Step(const WalkableTets::Cell* HWY_RESTRICT cells,
                           const float* HWY_RESTRICT points, PacketState& state,
                           Packet<kMeasure>& packet) {
  const DF d;
  const DU du;
  const LanesLinks links(cells, state.cells_by_4);
  const FourFloats point = LoadFour(points, state.apex_by_2);
  const VF px = kAxis == 0 ? point.b : kAxis == 1 ? point.c : point.a;
  const VF py = kAxis == 0 ? point.c : kAxis == 1 ? point.a : point.b;
  const VF pz = kAxis == 0 ? point.a : kAxis == 1 ? point.b : point.c;
  Corner<kMeasure> apex;
  apex.x =
      hn::Sub(hn::Sub(px, hn::Load(d, state.offset_x)), hn::Mul(hn::Load(d, state.slope_x), pz));
  apex.y =
      hn::Sub(hn::Sub(py, hn::Load(d, state.offset_y)), hn::Mul(hn::Load(d, state.slope_y), pz));
  apex.z = pz;
  apex.s = point.d;
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

  StepResult result;
  result.left = hn::RebindMask(d, left);
  if constexpr (kMeasure) Measure(a, b, c, result);
  return result;
}

// Puts a ray into a lane.
inline void PutRay(PacketState& state, std::size_t lane, const PacketStart& start) {
  for (std::size_t c = 0; c < 3; ++c) {
    PacketState::LaneCorners& corner = state.corners[c];
    corner.x[lane] = start.corners[c].x;
    corner.y[lane] = start.corners[c].y;
    corner.z[lane] = start.corners[c].z;
    corner.s[lane] = start.corners[c].scalar;
    corner.id[lane] = start.ids[c];
    corner.right[lane] = start.right[c] ? -1.0f : 1.0f;
  }
  state.cells_by_4[lane] = 4 * start.cell;
  state.apex_by_2[lane] = 2 * start.apex;
  state.slope_x[lane] = start.line.slope_x;
  state.slope_y[lane] = start.line.slope_y;
  state.offset_x[lane] = start.line.offset_x;
  state.offset_y[lane] = start.line.offset_y;
  state.t_per_z[lane] = start.t_per_z;
  state.z_in[lane] = start.z;
  state.s_in[lane] = start.scalar;
  state.active[lane] = ~std::uint32_t{0};
  state.begun[lane] = state.turn;
  state.live |= 1u << lane;
}

// An empty lane walks from cell 0 to wherever numbers lead, and is not looked at.
inline void PutNothing(PacketState& state, std::size_t lane) {
  PutRay(state, lane, PacketStart{});
  state.active[lane] = 0;
  state.live &= ~(1u << lane);
}

// A bit for each lane of which that is true.
HWY_INLINE unsigned BitsOf(MF mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(DF(), mask, bytes);
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
}

// Walks all rays that `feeder` has, `kCount` packets in turn. `consumer` sees what they meet:
//     begin(packet, lane, start);
//     MF visit(packet, active, length, s_in, s_out, cells): all lanes at once, for each step; those
//     returned have seen enough. Lengths are in world units and >= 0 (see trace.h);
//     end(packet, lane, start, z, cells): z is where the ray was last, cells how many it met.
// Without Consumer::kMeasure there is no visit(), and z means nothing.
//
// With kPrefetch, what a packet needs next is asked for as soon as it is known: that costs as many
// instructions as the loads themselves, and pays where they go beyond the caches.
template <int kAxis, std::size_t kCount, bool kPrefetch, class Consumer>
class PacketWalk {
 public:
  PacketWalk(const WalkableTets& mesh, Consumer& consumer, PacketFeeder& feeder)
      : cells_(mesh.cells.data()),
        points_(mesh.points.data()->position),
        consumer_(consumer),
        feeder_(feeder) {}

  void run() {
    for (std::size_t packet = 0; packet < kCount; ++packet)
      for (std::size_t lane = 0; lane < hn::Lanes(DF()); ++lane) give_ray(packet, lane);
    run(std::make_index_sequence<kCount>());
  }

 private:
  // Places of packets are constants here, so that packets can be in registers.
  template <std::size_t... kPlace>
  void run(std::index_sequence<kPlace...>) {
    Packet<Consumer::kMeasure> packets[kCount];
    (packets[kPlace].Load(states_[kPlace]), ...);
    while (rays_ > 0) (turn(kPlace, packets[kPlace], packets[(kPlace + 1) % kCount]), ...);
  }

  HWY_INLINE void turn(std::size_t place, Packet<Consumer::kMeasure>& packet,
                       Packet<Consumer::kMeasure>& next) {
    const DF d;
    const DU du;
    PacketState& state = states_[place];
    // The next packet's lanes are refilled one turn ahead: what is written lane by lane and read
    // as a whole at once has to wait.
    const std::size_t next_place = (place + 1) % kCount;
    if (HWY_UNLIKELY(states_[next_place].ended != 0)) {
      next.Store(states_[next_place]);
      refill(next_place);
    }
    if (HWY_UNLIKELY(state.refilled)) {
      packet.Load(state);
      state.refilled = false;
    }
    ++state.turn;
    const VU cells = hn::ShiftRight<2>(hn::Load(du, state.cells_by_4));
    const StepResult step = Step<kAxis, Consumer::kMeasure>(cells_, points_, state, packet);
    if constexpr (kPrefetch) {
      Prefetch(reinterpret_cast<const float*>(cells_), state.cells_by_4);
      Prefetch(points_, state.apex_by_2);
    }
    MF ended = step.left;
    if constexpr (Consumer::kMeasure) {
      // Where cells overlap a ray would have to go back; it waits instead.
      const VF along = hn::Mul(hn::Sub(step.z, packet.z_in), hn::Load(d, state.t_per_z));
      const MF onwards = hn::Gt(along, hn::Zero(d));
      const VF length = hn::IfThenElseZero(onwards, along);
      packet.z_in = hn::IfThenElse(onwards, step.z, packet.z_in);
      const MF active = hn::RebindMask(d, hn::Ne(hn::Load(du, state.active), hn::Zero(du)));
      ended = hn::Or(ended, consumer_.visit(place, active, length, packet.s_in, step.s, cells));
      packet.s_in = step.s;
    }
    state.ended = BitsOf(ended) & state.live;
  }

  HWY_NOINLINE void refill(std::size_t place) {
    PacketState& state = states_[place];
    state.refilled = true;
    for (unsigned ended = std::exchange(state.ended, 0u); ended != 0; ended &= ended - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(ended);
      --rays_;
      consumer_.end(place, lane, *starts_[place][lane], state.z_in[lane],
                    state.turn - state.begun[lane]);
      give_ray(place, lane);
    }
  }

  void give_ray(std::size_t place, std::size_t lane) {
    const PacketStart* const start = feeder_.next(starts_[place][lane]);
    starts_[place][lane] = start;
    if (start == nullptr) return PutNothing(states_[place], lane);
    PutRay(states_[place], lane, *start);
    consumer_.begin(place, lane, *start);
    ++rays_;
  }

  const WalkableTets::Cell* const cells_;
  const float* const points_;
  Consumer& consumer_;
  PacketFeeder& feeder_;
  PacketState states_[kCount];
  const PacketStart* starts_[kCount][kMaxLanes] = {};
  std::size_t rays_ = 0;
};

// The same, with the axis known when it runs, and more packets with prefetching on meshes that are
// larger than the caches.
template <class Consumer>
void WalkAlong(const WalkableTets& mesh, int axis, Consumer& consumer, PacketFeeder& feeder) {
  constexpr std::size_t kLargeMesh = 500000;  // cells
  auto walk = [&]<int kAxis>() {
    if (mesh.cells.size() < kLargeMesh)
      PacketWalk<kAxis, kPackets, false, Consumer>(mesh, consumer, feeder).run();
    else
      PacketWalk<kAxis, kMaxPackets, true, Consumer>(mesh, consumer, feeder).run();
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
