// Walking tetrahedra with packets of rays. Compiled once for each instruction set: to be included
// after hwy/foreach_target.h alone (see tet_packets.cpp).
//
// Each lane of a packet walks a ray of its own; several packets take turns, so that while one waits
// for memory the others compute. A lane whose ray has ended is given the next one. The decisions
// are TetWalker's, bit for bit: the same products of the same sheared vertices are compared, none
// is fused with a sum.

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

#include "hwy/highway.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/packet_start.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DF = HWY_CAPPED(float, 16);
using DU = hn::RebindToUnsigned<DF>;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using MF = hn::Mask<DF>;

constexpr std::size_t kMaxLanes = 16;

// One corner of the triangles by which the lanes' rays came into their cells.
struct CornerState {
  HWY_ALIGN float x[kMaxLanes];
  HWY_ALIGN float y[kMaxLanes];
  HWY_ALIGN float z[kMaxLanes];
  HWY_ALIGN float s[kMaxLanes];
  HWY_ALIGN std::uint32_t id[kMaxLanes];
};

// What a packet's lanes are at; see TetWalker for the meaning of low, high and third. Arrays, so
// that a lane can be given another ray.
struct PacketState {
  CornerState low, high, third;
  HWY_ALIGN std::uint32_t cell[kMaxLanes];
  HWY_ALIGN std::uint32_t apex[kMaxLanes];
  HWY_ALIGN float slope_x[kMaxLanes];
  HWY_ALIGN float slope_y[kMaxLanes];
  HWY_ALIGN float offset_x[kMaxLanes];
  HWY_ALIGN float offset_y[kMaxLanes];
  HWY_ALIGN float t_per_z[kMaxLanes];
  HWY_ALIGN float z_in[kMaxLanes];
  HWY_ALIGN float s_in[kMaxLanes];
  HWY_ALIGN std::uint32_t active[kMaxLanes];  // all ones or zero
};

// Four floats that lie together in memory, a lane each.
struct FourFloats {
  VF a, b, c, d;
};

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE FourFloats LoadFour(const float* HWY_RESTRICT base,
                               const std::uint32_t* HWY_RESTRICT indices) {
  const DF d;
  const float* const p = base + 4 * static_cast<std::size_t>(indices[0]);
  return {hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2]), hn::Set(d, p[3])};
}

#else

// What lanes 0, 4, 8, ... (counted from `indices`) load, side by side.
template <class D>
HWY_INLINE hn::Vec<D> LoadEveryFourth(D d, const float* HWY_RESTRICT base,
                                      const std::uint32_t* HWY_RESTRICT indices) {
  if constexpr (hn::MaxLanes(D()) <= 4) {
    return hn::LoadU(d, base + 4 * static_cast<std::size_t>(indices[0]));
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, LoadEveryFourth(half, base, indices + hn::MaxLanes(half)),
                       LoadEveryFourth(half, base, indices));
  }
}

// The four floats at base + 4 * index: one 16-byte load a lane, then a transposition within blocks
// of four lanes. On x86 that is faster than four gathers.
HWY_INLINE FourFloats LoadFour(const float* HWY_RESTRICT base,
                               const std::uint32_t* HWY_RESTRICT indices) {
  const DF d;
  const hn::Repartition<std::uint64_t, DF> d64;
  const VF p0 = LoadEveryFourth(d, base, indices);
  const VF p1 = LoadEveryFourth(d, base, indices + 1);
  const VF p2 = LoadEveryFourth(d, base, indices + 2);
  const VF p3 = LoadEveryFourth(d, base, indices + 3);
  const auto ab01 = hn::BitCast(d64, hn::InterleaveLower(d, p0, p1));
  const auto ab23 = hn::BitCast(d64, hn::InterleaveLower(d, p2, p3));
  const auto cd01 = hn::BitCast(d64, hn::InterleaveUpper(d, p0, p1));
  const auto cd23 = hn::BitCast(d64, hn::InterleaveUpper(d, p2, p3));
  return {hn::BitCast(d, hn::InterleaveLower(d64, ab01, ab23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, ab01, ab23)),
          hn::BitCast(d, hn::InterleaveLower(d64, cd01, cd23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, cd01, cd23))};
}

#endif  // HWY_TARGET == HWY_SCALAR

// Neighbour and apex behind the faces of these numbers (4 * cell + rank).
struct Links {
  VU cell, apex;
};

#if HWY_TARGET == HWY_SCALAR

HWY_INLINE Links LoadLinks(const WalkableTets::Cell* HWY_RESTRICT cells, VU numbers) {
  const std::uint32_t number = hn::GetLane(numbers);
  const WalkableTets::Link link = cells[number / 4][number % 4];
  return {hn::Set(DU(), link.cell), hn::Set(DU(), link.apex)};
}

#else

// The links of these numbers side by side.
template <class D>
HWY_INLINE hn::Vec<D> LoadEach(D d, const std::uint64_t* HWY_RESTRICT links,
                               const std::uint32_t* HWY_RESTRICT numbers) {
  if constexpr (hn::MaxLanes(D()) == 1) {
    return hn::LoadU(d, links + numbers[0]);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, LoadEach(half, links, numbers + hn::MaxLanes(half)),
                       LoadEach(half, links, numbers));
  }
}

// One load of 8 bytes a lane.
HWY_INLINE Links LoadLinks(const WalkableTets::Cell* HWY_RESTRICT cells, VU numbers) {
  static_assert(sizeof(WalkableTets::Link) == sizeof(std::uint64_t));
  const DU du;
  const hn::Repartition<std::uint64_t, DU> d64;
  const auto* HWY_RESTRICT links = reinterpret_cast<const std::uint64_t*>(cells);
  HWY_ALIGN std::uint32_t stored[kMaxLanes];
  hn::Store(numbers, du, stored);
  const VU first = hn::BitCast(du, LoadEach(d64, links, stored));
  const VU last = hn::BitCast(du, LoadEach(d64, links, stored + hn::MaxLanes(d64)));
  return {hn::ConcatEven(du, last, first), hn::ConcatOdd(du, last, first)};
}

#endif  // HWY_TARGET == HWY_SCALAR

// x * y - z * w without the cancellation that single precision would suffer: the error is below two
// units in the last place of the result where a fused multiply-add is at hand.
// Source: Jeannerod, Louvet, Muller, "Further analysis of Kahan's algorithm for the accurate
// computation of 2x2 determinants" (Math. Comp. 82, 2013).
HWY_INLINE VF DifferenceOfProducts(VF x, VF y, VF z, VF w) {
  const VF zw = hn::Mul(z, w);
  const VF error = hn::NegMulAdd(z, w, zw);
  return hn::Add(hn::MulSub(x, y, zw), error);
}

// A corner of all lanes. Where nothing is measured, z and s are left alone.
template <bool kMeasure>
struct Corner {
  VF x, y, z, s;
  VU id;

  static HWY_INLINE Corner Load(const CornerState& state) {
    const DF d;
    Corner corner;
    corner.x = hn::Load(d, state.x);
    corner.y = hn::Load(d, state.y);
    corner.z = corner.s = corner.x;
    if constexpr (kMeasure) {
      corner.z = hn::Load(d, state.z);
      corner.s = hn::Load(d, state.s);
    }
    corner.id = hn::Load(DU(), state.id);
    return corner;
  }
  HWY_INLINE void Store(CornerState& state) const {
    const DF d;
    hn::Store(x, d, state.x);
    hn::Store(y, d, state.y);
    if constexpr (kMeasure) {
      hn::Store(z, d, state.z);
      hn::Store(s, d, state.s);
    }
    hn::Store(id, DU(), state.id);
  }
};

// mask ? a : b
template <bool kMeasure>
HWY_INLINE Corner<kMeasure> Choose(MF mask, const Corner<kMeasure>& a, const Corner<kMeasure>& b) {
  Corner<kMeasure> chosen = a;
  chosen.x = hn::IfThenElse(mask, a.x, b.x);
  chosen.y = hn::IfThenElse(mask, a.y, b.y);
  if constexpr (kMeasure) {
    chosen.z = hn::IfThenElse(mask, a.z, b.z);
    chosen.s = hn::IfThenElse(mask, a.s, b.s);
  }
  chosen.id = hn::IfThenElse(hn::RebindMask(DU(), mask), a.id, b.id);
  return chosen;
}

// What a step tells: where the rays cross the face that they leave by (if measured), and which of
// them have left the mesh.
struct StepResult {
  VF z, s;
  MF left;
};

// Where rays cross the triangles low, high, third: measure_triangle() in single precision, with
// products that do not cancel. The edge from low to high crosses y = 0 on the right; on the left
// it is that between the third corner and the one across from it. Error of z and s: 4 units in
// the last place of their largest value in the triangle.
HWY_INLINE void Measure(const Corner<true>& low, const Corner<true>& high,
                        const Corner<true>& third, StepResult& result) {
  const DF d;
  const VF zero = hn::Zero(d);
  const MF third_up = hn::Ge(third.y, zero);
  auto left_low = [&](VF of_low, VF of_third) {
    return hn::IfThenElse(third_up, of_low, of_third);
  };
  auto left_high = [&](VF of_high, VF of_third) {
    return hn::IfThenElse(third_up, of_third, of_high);
  };
  const VF x0 = left_low(low.x, third.x), y0 = left_low(low.y, third.y);
  const VF x1 = left_high(high.x, third.x), y1 = left_high(high.y, third.y);
  const VF right = hn::Max(zero, DifferenceOfProducts(low.x, high.y, high.x, low.y));
  const VF left = hn::Max(zero, DifferenceOfProducts(x1, y0, x0, y1));
  // If both edges pass through the ray, one of them will do.
  const VF of_right = hn::IfThenElse(hn::Gt(hn::Add(left, right), zero), left, hn::Set(d, 1.0f));
  const VF w_low = hn::Mul(of_right, high.y);
  const VF w_high = hn::Neg(hn::Mul(of_right, low.y));
  const VF w_0 = hn::Mul(right, y1);
  const VF w_1 = hn::Neg(hn::Mul(right, y0));
  const VF scale = hn::Div(hn::Set(d, 1.0f), hn::Add(hn::Add(w_low, w_high), hn::Add(w_0, w_1)));
  auto blend = [&](VF of_low, VF of_high, VF of_third) {
    const VF sum = hn::MulAdd(
        w_low, hn::Sub(of_low, of_third),
        hn::MulAdd(w_high, hn::Sub(of_high, of_third),
                   hn::MulAdd(w_0, hn::Sub(left_low(of_low, of_third), of_third),
                              hn::Mul(w_1, hn::Sub(left_high(of_high, of_third), of_third)))));
    return hn::MulAdd(sum, scale, of_third);
  };
  result.z = blend(low.z, high.z, third.z);
  result.s = blend(low.s, high.s, third.s);
}

// One step of a packet: TetWalker::leave() and advance(). `kAxis` is the rays' longest axis, the
// same for all lanes.
template <int kAxis, bool kMeasure>
HWY_INLINE StepResult Step(const WalkableTets& mesh, PacketState& state) {
  using Corners = Corner<kMeasure>;
  const DF d;
  const DU du;
  const FourFloats point = LoadFour(mesh.points.data()->position, state.apex);
  const VF px = kAxis == 0 ? point.b : kAxis == 1 ? point.c : point.a;
  const VF py = kAxis == 0 ? point.c : kAxis == 1 ? point.a : point.b;
  const VF pz = kAxis == 0 ? point.a : kAxis == 1 ? point.b : point.c;
  Corners apex;
  apex.x =
      hn::Sub(hn::Sub(px, hn::Load(d, state.offset_x)), hn::Mul(hn::Load(d, state.slope_x), pz));
  apex.y =
      hn::Sub(hn::Sub(py, hn::Load(d, state.offset_y)), hn::Mul(hn::Load(d, state.slope_y), pz));
  apex.z = pz;
  apex.s = point.d;
  apex.id = hn::Load(du, state.apex);

  const Corners low = Corners::Load(state.low);
  const Corners high = Corners::Load(state.high);
  const Corners third = Corners::Load(state.third);
  const VF zero = hn::Zero(d);
  const MF up = hn::Ge(apex.y, zero);
  const Corners across = Choose(up, low, high);
  const Corners beside = Choose(up, high, low);
  // Right of the ray: low.x * high.y > high.x * low.y, where the apex is high if it is up and low
  // otherwise; then both products change their signs, and no rounding does.
  const VF flip = hn::IfThenElse(up, zero, hn::SignBit(d));
  const VF x = hn::Xor(apex.x, flip);
  const VF y = hn::Xor(apex.y, flip);
  MF first = hn::Gt(hn::Mul(across.x, y), hn::Mul(x, across.y));
  const MF second =
      hn::And(hn::Xor(hn::Ge(third.y, zero), up), hn::Gt(hn::Mul(third.x, y), hn::Mul(x, third.y)));
  const MF both_ways = hn::AndNot(first, second);
  if (HWY_UNLIKELY(!hn::AllFalse(d, both_ways))) {
    const MF smaller_in = hn::RebindMask(d, hn::Lt(apex.id, beside.id));
    const MF smaller_out = hn::RebindMask(d, hn::Lt(across.id, third.id));
    first = hn::Or(first, hn::AndNot(hn::Xor(smaller_in, smaller_out), both_ways));
  }
  const MF swing = hn::And(first, second);  // the edge to the third corner is the new first one

  const VU behind =
      hn::IfThenElse(hn::RebindMask(du, first),
                     hn::IfThenElse(hn::RebindMask(du, swing), across.id, beside.id), third.id);
  const Corners new_across = Choose(swing, third, across);
  const Corners new_beside = Choose(first, apex, beside);
  const Corners new_third = Choose(first, Choose(second, beside, third), apex);
  const Corners new_low = Choose(up, new_across, new_beside);
  const Corners new_high = Choose(up, new_beside, new_across);
  new_low.Store(state.low);
  new_high.Store(state.high);
  new_third.Store(state.third);

  // The rank of the corner left behind, as minus the sum of true comparisons.
  const VU rank = hn::Add(hn::Add(hn::VecFromMask(du, hn::Lt(new_across.id, behind)),
                                  hn::VecFromMask(du, hn::Lt(new_beside.id, behind))),
                          hn::VecFromMask(du, hn::Lt(new_third.id, behind)));
  const Links next =
      LoadLinks(mesh.cells.data(), hn::Sub(hn::ShiftLeft<2>(hn::Load(du, state.cell)), rank));
  // A lane that has left goes on in cell 0 until it is given another ray.
  const auto out = hn::Eq(next.cell, hn::Set(du, kNone));
  hn::Store(hn::IfThenZeroElse(out, next.cell), du, state.cell);
  hn::Store(next.apex, du, state.apex);

  StepResult result;
  result.z = result.s = apex.x;
  if constexpr (kMeasure) Measure(new_low, new_high, new_third, result);
  const auto active = hn::Ne(hn::Load(du, state.active), hn::Zero(du));
  result.left = hn::RebindMask(d, hn::And(out, active));
  return result;
}

// Puts a ray into a lane.
HWY_INLINE void PutRay(PacketState& state, std::size_t lane, const PacketStart& start) {
  CornerState* const corners[] = {&state.low, &state.high, &state.third};
  for (std::size_t c = 0; c < 3; ++c) {
    corners[c]->x[lane] = start.corners[c].x;
    corners[c]->y[lane] = start.corners[c].y;
    corners[c]->z[lane] = start.corners[c].z;
    corners[c]->s[lane] = start.corners[c].scalar;
    corners[c]->id[lane] = start.ids[c];
  }
  state.cell[lane] = start.cell;
  state.apex[lane] = start.apex;
  state.slope_x[lane] = start.line.slope_x;
  state.slope_y[lane] = start.line.slope_y;
  state.offset_x[lane] = start.line.offset_x;
  state.offset_y[lane] = start.line.offset_y;
  state.t_per_z[lane] = start.t_per_z;
  state.z_in[lane] = start.z;
  state.s_in[lane] = start.scalar;
  state.active[lane] = ~std::uint32_t{0};
}

// An empty lane walks from cell 0 to wherever numbers lead, and is not looked at.
HWY_INLINE void PutNothing(PacketState& state, std::size_t lane) {
  PutRay(state, lane, PacketStart{});
  state.active[lane] = 0;
}

// Walks all rays that `feeder` has, `kPackets` packets in turn. `consumer` sees what they meet:
//     begin(packet, lane, start);  end(packet, lane, start, z, left): z is where the ray was last;
//     MF visit(packet, active, length, s_in, s_out, cells): all lanes at once, for each step; those
//     returned have seen enough. Lengths are in world units and >= 0 (see trace.h).
// Without Consumer::kMeasure lengths, scalars and z mean nothing.
template <int kAxis, std::size_t kPackets, class Consumer>
void WalkPackets(const WalkableTets& mesh, Consumer& consumer, PacketFeeder& feeder) {
  const DF d;
  const DU du;
  const std::size_t lanes = hn::Lanes(d);
  PacketState states[kPackets];
  const PacketStart* starts[kPackets][kMaxLanes] = {};
  std::size_t live = 0;
  auto refill = [&](std::size_t packet, std::size_t lane) {
    const PacketStart* start = feeder.next(starts[packet][lane]);
    starts[packet][lane] = start;
    if (start == nullptr) {
      PutNothing(states[packet], lane);
      return;
    }
    PutRay(states[packet], lane, *start);
    consumer.begin(packet, lane, *start);
    ++live;
  };
  for (std::size_t packet = 0; packet < kPackets; ++packet)
    for (std::size_t lane = 0; lane < lanes; ++lane) refill(packet, lane);

  while (live > 0) {
    for (std::size_t packet = 0; packet < kPackets; ++packet) {
      PacketState& state = states[packet];
      const MF active = hn::RebindMask(d, hn::Ne(hn::Load(du, state.active), hn::Zero(du)));
      const VF s_in = hn::Load(d, state.s_in);
      const VU cells = hn::Load(du, state.cell);
      const StepResult step = Step<kAxis, Consumer::kMeasure>(mesh, state);
      VF length = s_in;
      if constexpr (Consumer::kMeasure) {
        const VF z_in = hn::Load(d, state.z_in);
        length = hn::Mul(hn::Sub(step.z, z_in), hn::Load(d, state.t_per_z));
        // Where cells overlap a ray would have to go back; it waits instead.
        const MF onwards = hn::Gt(length, hn::Zero(d));
        length = hn::IfThenElseZero(onwards, length);
        hn::Store(hn::IfThenElse(onwards, step.z, z_in), d, state.z_in);
        hn::Store(step.s, d, state.s_in);
      }
      const MF enough = consumer.visit(packet, active, length, s_in, step.s, cells);
      const MF ended = hn::Or(step.left, hn::And(active, enough));
      if (HWY_LIKELY(hn::AllFalse(d, ended))) continue;
      HWY_ALIGN std::uint32_t which[kMaxLanes];
      HWY_ALIGN std::uint32_t gone[kMaxLanes];
      hn::Store(hn::VecFromMask(du, hn::RebindMask(du, ended)), du, which);
      hn::Store(hn::VecFromMask(du, hn::RebindMask(du, step.left)), du, gone);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (which[lane] == 0) continue;
        --live;
        consumer.end(packet, lane, *starts[packet][lane], state.z_in[lane], gone[lane] != 0);
        refill(packet, lane);
      }
    }
  }
}

// The same, with the axis known when it runs.
template <std::size_t kPackets, class Consumer>
void WalkAlong(const WalkableTets& mesh, int axis, Consumer& consumer, PacketFeeder& feeder) {
  switch (axis) {
    case 0:
      return WalkPackets<0, kPackets>(mesh, consumer, feeder);
    case 1:
      return WalkPackets<1, kPackets>(mesh, consumer, feeder);
    default:
      return WalkPackets<2, kPackets>(mesh, consumer, feeder);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
