// Walking with packets of rays, whatever the cells. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone (see tet_packets.cpp).
//
// Each lane of a packet walks a ray of its own; several packets take turns, so that while one waits
// for memory the others compute. A lane whose ray has ended is given the next one when it is its
// packet's turn again: what decides that has been known for long by then, so that a branch that was
// guessed wrong costs little. What a step is, `Steps` says: TetSteps (tet_steps-inl.h) or GridSteps
// (grid_steps-inl.h). Their decisions are the scalar walkers', bit for bit: the same products of
// the same sheared vertices are compared, none is fused with a sum. (Where a host program has
// numbers below 1e-38 flushed to zero, products that differ by less are taken as equal.)
//
// A bit of a lane is the sign of a float.

// clang-format off
#if defined(PLUME_TRAVERSE_PACKET_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_PACKET_WALK_INL_H_
#undef PLUME_TRAVERSE_PACKET_WALK_INL_H_
#else
#define PLUME_TRAVERSE_PACKET_WALK_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <utility>

#include "hwy/highway.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_start.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Packets that take turns, and where they ask ahead.
constexpr std::size_t kPackets = 4;
constexpr std::size_t kAheadPackets = 8;
constexpr std::size_t kMaxPackets = 8;
static_assert(kPackets <= kMaxPackets && kAheadPackets <= kMaxPackets &&
              kMaxPackets * kMaxLanes <= kMaxPacketLanes);

// What a packet's lanes are given, as arrays, so that a lane can be given another ray.
struct LaneState {
  HWY_ALIGN float slope_x[kMaxLanes];
  HWY_ALIGN float slope_y[kMaxLanes];
  HWY_ALIGN float offset_x[kMaxLanes];
  HWY_ALIGN float offset_y[kMaxLanes];
  HWY_ALIGN float t_per_z[kMaxLanes];
  HWY_ALIGN float z_in[kMaxLanes];
  HWY_ALIGN float s_in[kMaxLanes];
  HWY_ALIGN std::uint32_t active[kMaxLanes];  // all ones or zero
  HWY_ALIGN std::uint32_t begun[kMaxLanes];   // the packet's turn when the lane's ray came in
  // Of lanes that wait (see PacketWalk): bits; whether their rays have left; lengths that remain.
  HWY_ALIGN float waits[kMaxLanes];
  HWY_ALIGN float left[kMaxLanes];
  HWY_ALIGN float remain[kMaxLanes];
  std::uint32_t turn = 0;
  unsigned live = 0;   // lanes that have a ray
  unsigned ended = 0;  // those whose ray has ended
  bool refilled = false;

  void put(std::size_t lane, const PacketStart& start) {
    slope_x[lane] = start.line.slope_x;
    slope_y[lane] = start.line.slope_y;
    offset_x[lane] = start.line.offset_x;
    offset_y[lane] = start.line.offset_y;
    t_per_z[lane] = start.t_per_z;
    z_in[lane] = start.z;
    s_in[lane] = start.scalar;
    begun[lane] = turn;
    waits[lane] = left[lane] = 0;
  }
};

// Where the lanes' segments begin.
template <bool kMeasure>
struct SegmentStart {
  VF z_in, s_in;

  HWY_INLINE void Load(const LaneState& state) {
    if constexpr (kMeasure) {
      z_in = hn::Load(DF(), state.z_in);
      s_in = hn::Load(DF(), state.s_in);
    }
  }
  HWY_INLINE void Store(LaneState& state) const {
    if constexpr (kMeasure) {
      hn::Store(z_in, DF(), state.z_in);
      hn::Store(s_in, DF(), state.s_in);
    }
  }
};

// Where rays cross the faces that they leave by, and which of them have left the mesh.
struct StepResult {
  VF z, s;
  MF left;
};

// What a consumer that goes by parts of segments has done: lanes that have seen enough, and those
// of whose segments something is left, where its scalar begins and how long it is.
struct VisitedPart {
  MF enough, waits;
  VF begin, length;
};

// A step's results while scalar walkers take it over in some lanes.
template <bool kMeasure>
class AskedLanes {
 public:
  explicit AskedLanes(const StepResult& result) {
    const DF d;
    if constexpr (kMeasure) {
      hn::Store(result.z, d, z_);
      hn::Store(result.s, d, s_);
    }
    hn::Store(hn::IfThenElseZero(result.left, hn::Set(d, 1)), d, left_);
  }

  // Takes the step of a walker that is in the lane's cell. False where the ray leaves the mesh.
  template <class Walker>
  bool ask(std::size_t lane, Walker& walker) {
    const auto exit = walker.leave();
    // There always is a way out; without one the ray would end here, as at the boundary.
    const bool goes_on = exit && walker.advance();
    left_[lane] = goes_on ? 0.0f : 1.0f;
    if (exit) {
      z_[lane] = static_cast<float>(exit->z);
      s_[lane] = exit->scalar;
    }
    return goes_on;
  }

  void put(StepResult& result) const {
    const DF d;
    if constexpr (kMeasure) {
      result.z = hn::Load(d, z_);
      result.s = hn::Load(d, s_);
    }
    result.left = hn::Gt(hn::Load(d, left_), hn::Zero(d));
  }

 private:
  HWY_ALIGN float z_[kMaxLanes], s_[kMaxLanes], left_[kMaxLanes];
};

struct ShearedLanes {
  VF x, y, z, s;
};
// Points turned so that z is along `axis`, the rays' longest, the same for all lanes.
HWY_INLINE ShearedLanes Turned(const FourFloats& point, int axis) {
  const VF x = axis == 0 ? point.b : axis == 1 ? point.c : point.a;
  const VF y = axis == 0 ? point.c : axis == 1 ? point.a : point.b;
  const VF z = axis == 0 ? point.a : axis == 1 ? point.b : point.c;
  return {x, y, z, point.d};
}
// Points in the lanes' sheared frames: ShearedFrame's operator().
HWY_INLINE ShearedLanes Shear(const FourFloats& point, int axis, const LaneState& state) {
  const DF d;
  const ShearedLanes p = Turned(point, axis);
  return {
      hn::Sub(hn::Sub(p.x, hn::Load(d, state.offset_x)), hn::Mul(hn::Load(d, state.slope_x), p.z)),
      hn::Sub(hn::Sub(p.y, hn::Load(d, state.offset_y)), hn::Mul(hn::Load(d, state.slope_y), p.z)),
      p.z, p.s};
}

// x * y - z * w without the cancellation that single precision would suffer: the error is below two
// units in the last place of the result where a fused multiply-add is at hand.
// Source: Jeannerod, Louvet, Muller, "Further analysis of Kahan's algorithm for the accurate
// computation of 2x2 determinants" (Math. Comp. 82, 2013).
HWY_INLINE VF DifferenceOfProducts(VF x, VF y, VF z, VF w) {
  const VF zw = hn::Mul(z, w);
  const VF error = hn::NegMulAdd(z, w, zw);
  return hn::Add(hn::MulSub(x, y, zw), error);
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
//     ends_at(packet, z), where there is one, before it: where those segments end;
//     end(packet, lane, start, z, cells): z is where the ray was last, cells how many it met.
// Without Consumer::kMeasure there is no visit(), and z means nothing.
//
// A consumer with kByParts has visit_part() too, which may leave parts of segments for later. Where
// steps are cheap (Steps::kMayWait) such lanes wait: their packet's next turn takes no step in
// them, and shows the consumer what was left. So a turn takes no longer because one of its segments
// does.
//
// With kPrefetch, what a packet needs next is asked for as soon as it is known, which is when all
// others have had their turns.
//
// `Steps` is what the cells are:
//     Start; State, derived from LaneState; Packet<kMeasure>, derived from SegmentStart: what
//     changes with every step, with Load(state) and Store(state);
//     Put(state, lane, start); PutNothing(state, lane): a place from which a lane without a ray may
//     go on and on, not looked at;
//     Cells(state, packet): the numbers of the cells that the lanes are in;
//     Step(state, packet): to the next cell; Prefetch(state, packet);
//     kMayWait: whether there is StepUnless(waits, state, packet), by which lanes whose bit is set
//     stay where they are, and where they crossed the last face.
template <class Steps, std::size_t kCount, bool kPrefetch, class Consumer>
class PacketWalk {
 public:
  using Start = typename Steps::Start;
  using State = typename Steps::State;
  using Packet = typename Steps::template Packet<Consumer::kMeasure>;
  static constexpr bool kWaits = requires { requires Steps::kMayWait && Consumer::kByParts; };

  PacketWalk(const Steps& steps, Consumer& consumer, PacketFeeder& feeder)
      : steps_(steps), consumer_(consumer), feeder_(feeder) {}

  void run() {
    for (std::size_t packet = 0; packet < kCount; ++packet)
      for (std::size_t lane = 0; lane < hn::Lanes(DF()); ++lane) give_ray(packet, lane);
    Packet packets[kCount];
    for (std::size_t place = 0; place < kCount; ++place) packets[place].Load(states_[place]);
    while (rays_ > 0)
      for (std::size_t place = 0; place < kCount; ++place)
        turn(place, packets[place], packets[(place + 1) % kCount]);
  }

 private:
  HWY_INLINE void turn(std::size_t place, Packet& packet, Packet& next) {
    const DF d;
    const DU du;
    State& state = states_[place];
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
    const VU cells = steps_.Cells(state, packet);
    VF waits;
    StepResult step;
    if constexpr (kWaits) {
      waits = hn::Load(d, state.waits);
      step = steps_.StepUnless(waits, state, packet);
    } else {
      step = steps_.Step(state, packet);
    }
    if constexpr (kPrefetch) steps_.Prefetch(state, packet);
    MF ended = step.left;
    if constexpr (Consumer::kMeasure) {
      // Where cells overlap a ray would have to go back; it waits instead.
      const VF along = hn::Mul(hn::Sub(step.z, packet.z_in), hn::Load(d, state.t_per_z));
      const MF onwards = hn::Gt(along, hn::Zero(d));
      const VF length = hn::IfThenElseZero(onwards, along);
      packet.z_in = hn::IfThenElse(onwards, step.z, packet.z_in);
      if constexpr (requires { consumer_.ends_at(place, packet.z_in); })
        consumer_.ends_at(place, packet.z_in);
      const MF active = hn::RebindMask(d, hn::Ne(hn::Load(du, state.active), hn::Zero(du)));
      if constexpr (kWaits) {
        const VF left = Choose(waits, hn::Load(d, state.left), hn::VecFromMask(d, step.left));
        const VF to_do = Choose(waits, hn::Load(d, state.remain), length);
        const VisitedPart visited =
            consumer_.visit_part(place, active, to_do, packet.s_in, step.s, cells);
        packet.s_in = hn::IfThenElse(visited.waits, visited.begin, step.s);
        const VF wait_on = hn::VecFromMask(d, visited.waits);
        ended = hn::Or(visited.enough, MaskOfBits(hn::AndNot(wait_on, left)));
        // A turn without a step counts no cell.
        const VU no_step = hn::ShiftRight<31>(hn::BitCast(du, waits));
        hn::Store(hn::Add(hn::Load(du, state.begun), no_step), du, state.begun);
        hn::Store(left, d, state.left);
        hn::Store(visited.length, d, state.remain);
        hn::Store(wait_on, d, state.waits);
      } else {
        ended = hn::Or(ended, consumer_.visit(place, active, length, packet.s_in, step.s, cells));
        packet.s_in = step.s;
      }
    }
    state.ended = BitsOf(ended) & state.live;
  }

  HWY_NOINLINE void refill(std::size_t place) {
    State& state = states_[place];
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
    State& state = states_[place];
    const PacketStart* const start = feeder_.next(starts_[place][lane]);
    starts_[place][lane] = start;
    if (start == nullptr) {
      steps_.PutNothing(state, lane);
      state.active[lane] = 0;
      state.live &= ~(1u << lane);
      return;
    }
    steps_.Put(state, lane, static_cast<const Start&>(*start));
    state.active[lane] = ~std::uint32_t{0};
    state.live |= 1u << lane;
    consumer_.begin(place, lane, *start);
    ++rays_;
  }

  const Steps steps_;
  Consumer& consumer_;
  PacketFeeder& feeder_;
  State states_[kCount];
  const PacketStart* starts_[kCount][kMaxLanes] = {};
  std::size_t rays_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
