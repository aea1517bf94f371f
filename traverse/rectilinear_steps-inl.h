// Steps through the cells of a rectilinear grid. Compiled once for each instruction set: to be
// included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_RECTILINEAR_STEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_RECTILINEAR_STEPS_INL_H_
#undef PLUME_TRAVERSE_RECTILINEAR_STEPS_INL_H_
#else
#define PLUME_TRAVERSE_RECTILINEAR_STEPS_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hwy/highway.h"
#include "plume/mesh/walkable_rectilinear.h"
#include "plume/traverse/axis_lanes-inl.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"
#include "plume/traverse/rectilinear_start.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// RectilinearWalker's find_exit() and advance(), a ray a lane (see PacketWalk). Where a ray crosses
// a plane is computed in double by the walker's operations in their order, so cells and places are
// the same, bit for bit. Scalars are measured in single precision, from differences in double.
//
// Axes are the lanes' own: in the order in which the ray crosses their planes at a vertex.
//
// With kAhead, for grids larger than the caches, points of the next cell are asked for.
template <bool kAhead>
class RectilinearSteps {
 public:
  using Start = RectilinearStart;

  struct State : LaneState {
    HWY_ALIGN double t_next[3][kMaxLanes];          // where the ray crosses the plane ahead
    HWY_ALIGN double t_behind[3][kMaxLanes];        // and where it has crossed the one behind
    HWY_ALIGN std::int64_t plane[3][kMaxLanes];     // the one ahead: bytes from the first of all
    HWY_ALIGN std::int64_t to_plane[3][kMaxLanes];  // from it to the one after it
    HWY_ALIGN double origin[3][kMaxLanes];
    HWY_ALIGN double per_direction[3][kMaxLanes];
    HWY_ALIGN double t_entry[kMaxLanes];
    HWY_ALIGN double t_end[kMaxLanes];
    HWY_ALIGN float rate[3][kMaxLanes];  // weight per t, and the weight of an axis across the ray
    HWY_ALIGN float base[3][kMaxLanes];
    HWY_ALIGN std::uint32_t to_cell[3][kMaxLanes];
    HWY_ALIGN std::uint32_t to_point[3][kMaxLanes];
    HWY_ALIGN std::uint32_t cell[kMaxLanes];
    HWY_ALIGN std::uint32_t near_corner[kMaxLanes];
    // Points that the next cell has and this one has not, by the axis along which it lies.
    HWY_ALIGN std::uint32_t to_ahead[2][3][kMaxLanes];
    HWY_ALIGN std::uint32_t ahead[2][kMaxLanes];
  };

  template <bool kMeasure>
  using Packet = SegmentStart<kMeasure>;

  explicit RectilinearSteps(const WalkableRectilinear& mesh)
      : planes_(mesh.axes[0].coordinates.data()),
        values_(mesh.point_values.empty() ? nullptr : mesh.point_values.data()),
        last_value_(static_cast<std::uint32_t>(mesh.point_values.size() - 1)) {}

  void Put(State& state, std::size_t lane, const RectilinearStart& start) const {
    state.put(lane, start);
    const RectilinearWalker& walker = *start.walker;
    for (std::size_t a = 0; a < 3; ++a) {
      const RectilinearWalker::Axis& axis = walker.axes()[a];
      state.t_next[a][lane] = axis.t_next;
      state.t_behind[a][lane] = axis.t_behind;
      state.plane[a][lane] =
          static_cast<std::int64_t>(AddressOf(walker.plane_ahead(axis)) - AddressOf(planes_));
      state.to_plane[a][lane] = axis.step * static_cast<std::int64_t>(sizeof(double));
      state.origin[a][lane] = axis.origin;
      state.per_direction[a][lane] = axis.per_direction;
      state.rate[a][lane] = static_cast<float>(
          std::min(axis.rate, static_cast<double>(std::numeric_limits<float>::max())));
      state.base[a][lane] = static_cast<float>(axis.base);
      state.to_cell[a][lane] = axis.cell_step;
      state.to_point[a][lane] = axis.point_step;
      if constexpr (kAhead) PutAhead(state, lane, walker, a);
    }
    state.t_entry[lane] = walker.t_in();
    state.t_end[lane] = walker.end();
    state.cell[lane] = walker.cell();
    state.near_corner[lane] = walker.near_corner();
  }
  // In cell 0, on the spot.
  void PutNothing(State& state, std::size_t lane) const {
    state.put(lane, PacketStart{});
    for (std::size_t a = 0; a < 3; ++a) {
      state.t_next[a][lane] = state.t_behind[a][lane] = 0;
      state.plane[a][lane] = state.to_plane[a][lane] = 0;
      state.origin[a][lane] = state.per_direction[a][lane] = 0;
      state.rate[a][lane] = state.base[a][lane] = 0;
      state.to_cell[a][lane] = state.to_point[a][lane] = 0;
      state.to_ahead[0][a][lane] = state.to_ahead[1][a][lane] = 0;
    }
    state.t_entry[lane] = 0;
    state.t_end[lane] = std::numeric_limits<double>::infinity();
    state.cell[lane] = state.near_corner[lane] = 0;
  }

  template <bool kMeasure>
  HWY_INLINE VU Cells(const State& state, const Packet<kMeasure>&) const {
    return hn::Load(DU(), state.cell);
  }

  // Near the grid's end, where rays leave, some ask for what nobody needs.
  template <bool kMeasure>
  HWY_INLINE void Prefetch(const State& state, const Packet<kMeasure>&) const {
    if (values_ == nullptr) return;
    for (const auto& points : state.ahead)
      for (std::size_t lane = 0; lane < hn::Lanes(DF()); ++lane)
        hwy::Prefetch(values_ + points[lane]);
  }

  template <bool kMeasure>
  HWY_INLINE StepResult Step(State& state, Packet<kMeasure>&) const {
    if (kMeasure && values_ != nullptr) return StepTo<kMeasure, true>(state);
    return StepTo<kMeasure, false>(state);
  }

 private:
  template <bool kMeasure, bool kValues>
  HWY_INLINE StepResult StepTo(State& state) const {
    const DF d;
    const DU du;
    const DD dd;
    const DI di;
    const DH dh;
    MD second_first[kParts], third[kParts], left[kParts];
    VH z[kParts], since_first[kParts], since_last[kParts], width[kParts];
    for (std::size_t part = 0; part < kParts; ++part) {
      const std::size_t lane = part * kDoubles;
      VD t_next[3];
      LoadAxes(dd, state.t_next, lane, t_next);
      ExitLanes<MD> exit;
      exit.second_first = hn::Lt(t_next[1], t_next[0]);
      exit.third = hn::Lt(t_next[2], hn::IfThenElse(exit.second_first, t_next[1], t_next[0]));
      const VD t_out = exit.Of(t_next);
      left[part] = hn::Ge(t_out, hn::Load(dd, state.t_end + lane));
      second_first[part] = exit.second_first;
      third[part] = exit.third;

      // Behind an axis' last plane there is none; the ray has left by then.
      VI planes[3], to_plane[3];
      LoadAxes(di, state.plane, lane, planes);
      LoadAxes(di, state.to_plane, lane, to_plane);
      const ExitLanes<hn::Mask<DI>> which{hn::RebindMask(di, exit.second_first),
                                          hn::RebindMask(di, exit.third)};
      const VI plane = hn::Add(
          which.Of(planes), hn::IfThenZeroElse(hn::RebindMask(di, left[part]), which.Of(to_plane)));
      StoreExit(di, which, planes, plane, lane, state.plane);
      VD origin[3], per_direction[3];
      LoadAxes(dd, state.origin, lane, origin);
      LoadAxes(dd, state.per_direction, lane, per_direction);
      const VD distance = hn::Sub(hn::GatherOffset(dd, planes_, plane), exit.Of(origin));
      const VD t_after = hn::Mul(distance, exit.Of(per_direction));
      StoreExit(dd, exit, t_next, t_after, lane, state.t_next);
      if constexpr (kMeasure)
        z[part] = hn::DemoteTo(dh, hn::Sub(t_out, hn::Load(dd, state.t_entry + lane)));
      if constexpr (kValues) {
        VD t_behind[3];
        LoadAxes(dd, state.t_behind, lane, t_behind);
        since_first[part] = hn::DemoteTo(dh, hn::Sub(t_out, exit.FirstBesides(t_behind)));
        since_last[part] = hn::DemoteTo(dh, hn::Sub(t_out, exit.LastBesides(t_behind)));
        width[part] = hn::DemoteTo(dh, hn::Sub(t_after, t_out));
        StoreExit(dd, exit, t_behind, t_out, lane, state.t_behind);
      }
    }

    const ExitLanes<MF> exit{Join(second_first), Join(third)};
    const ExitLanes<hn::Mask<DU>> which{hn::RebindMask(du, exit.second_first),
                                        hn::RebindMask(du, exit.third)};
    VU steps[3];
    LoadAxes(du, state.to_cell, 0, steps);
    hn::Store(hn::Add(hn::Load(du, state.cell), which.Of(steps)), du, state.cell);
    StepResult result;
    result.left = Join(left);
    if constexpr (kMeasure) {
      result.z = Join(z);
      result.s = hn::Zero(d);
    }
    if constexpr (kValues) {
      LoadAxes(du, state.to_point, 0, steps);
      const VU corner = hn::Add(hn::Load(du, state.near_corner), which.Of(steps));
      hn::Store(corner, du, state.near_corner);
      if constexpr (kAhead) {
        const VU last = hn::Set(du, last_value_);
        for (std::size_t i = 0; i < 2; ++i) {
          VU to_ahead[3];
          LoadAxes(du, state.to_ahead[i], 0, to_ahead);
          hn::Store(hn::Min(hn::Add(corner, which.Of(to_ahead)), last), du, state.ahead[i]);
        }
      }
      VF rate[3], base[3];
      LoadAxes(d, state.rate, 0, rate);
      LoadAxes(d, state.base, 0, base);
      const VF one = hn::Set(d, 1);
      const VF along_first = hn::Min(
          one, hn::MulAdd(Join(since_first), exit.FirstBesides(rate), exit.FirstBesides(base)));
      const VF along_last = hn::Min(
          one, hn::MulAdd(Join(since_last), exit.LastBesides(rate), exit.LastBesides(base)));
      result.s = FaceScalar(corner, which.FirstBesides(steps), which.LastBesides(steps),
                            along_first, along_last);
      const VF least = hn::Set(d, std::numeric_limits<float>::min());
      StoreExit(d, exit, rate, hn::Div(one, hn::Max(Join(width), least)), 0, state.rate);
    }
    return result;
  }

  // Bilinear in the face's four values, as RectilinearWalker's face_value().
  HWY_INLINE VF FaceScalar(VU corner, VU u, VU v, VF along_u, VF along_v) const {
    const DF d;
    auto value = [&](VU point) {
      return hn::GatherIndex(d, values_, hn::BitCast(hn::RebindToSigned<DU>(), point));
    };
    const VU across = hn::Add(corner, v);
    const VF s00 = value(corner), s10 = value(hn::Add(corner, u));
    const VF s01 = value(across), s11 = value(hn::Add(across, u));
    const VF s0 = hn::MulAdd(along_u, hn::Sub(s10, s00), s00);
    const VF s1 = hn::MulAdd(along_u, hn::Sub(s11, s01), s01);
    return hn::MulAdd(along_v, hn::Sub(s1, s0), s0);
  }

  // Values lie in rows along x, and a line of the cache has 16 of them. Along another axis the next
  // cell has two rows that this one has not; along x two of its four are asked for, half a line on.
  static HWY_INLINE void PutAhead(State& state, std::size_t lane, const RectilinearWalker& walker,
                                  std::size_t a) {
    const RectilinearWalker::Axis& axis = walker.axes()[a];
    std::uint32_t step = axis.point_step, across = 0;
    for (const RectilinearWalker::Axis& other : walker.axes())
      if (other.number != 0 && other.number != axis.number) across = other.point_step;
    if (axis.number == 0) step *= 8;
    state.to_ahead[0][a][lane] = step;
    state.to_ahead[1][a][lane] = step + across;
  }

  static std::uintptr_t AddressOf(const double* plane) {
    return reinterpret_cast<std::uintptr_t>(plane);
  }

  const double* planes_;  // the first axis'; offsets lead from it to those of all axes
  const float* values_;   // of points, or null
  std::uint32_t last_value_;
};

// Walks all rays of `feeder`. Requires walked_by_packets(mesh).
//
// Asking ahead costs an eighth of the rate where a core's own cache holds the values (AVX-512, 65
// points along an edge), and gives 1.8 times that rate with 193 and rays at random. Counting reads
// no values.
template <class Consumer>
void Walk(const WalkableRectilinear& mesh, Consumer& consumer, PacketFeeder& feeder) {
  constexpr std::size_t kLargeMesh = 500000;  // values
  auto walk = [&]<bool kAhead>() {
    const RectilinearSteps<kAhead> steps(mesh);
    PacketWalk<RectilinearSteps<kAhead>, kAhead ? kAheadPackets : kPackets, kAhead, Consumer>(
        steps, consumer, feeder)
        .run();
  };
  if constexpr (Consumer::kMeasure)
    if (mesh.point_values.size() >= kLargeMesh) return walk.template operator()<true>();
  walk.template operator()<false>();
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
