// What packets of rays through a curvilinear grid know of where they are. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_GRID_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_GRID_PACKET_INL_H_
#undef PLUME_TRAVERSE_GRID_PACKET_INL_H_
#else
#define PLUME_TRAVERSE_GRID_PACKET_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/mesh/walkable_grid.h"
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

// A direction in which nothing moves (see GridStart).
constexpr std::uint32_t kNowhere = 6;

// Written here while a lane is given a ray or has asked the scalar walker; `back_by_2` always, as
// places to load from: twice the numbers of the back's points.
struct GridState : LaneState {
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
  unsigned asks_on = 0;  // steps that ask, or may, before one is tried that does not

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
struct GridPacket : SegmentStart<kMeasure> {
  QuadLanes<kMeasure> front;
  VF right[4];  // whether the front's edges, from corner m to m + 1, cross on the right
  VU first_by_2;
  VU u, v, ahead;  // directions, numbered as in GridStart
  VU index[3];

  HWY_INLINE void Load(const GridState& state) {
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
  HWY_INLINE void Store(GridState& state) const {
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

// Directions of a grid: what going there adds to the numbers of points, and to a cell's index.
class GridDirections {
 public:
  explicit GridDirections(const WalkableGrid& mesh)
      : cells_{mesh.dimensions[0] - 1, mesh.dimensions[1] - 1} {
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

  // Twice the step from point to point.
  HWY_INLINE VU StrideBy2(VU direction) const { return LookUp(stride_by_2_, direction); }
  HWY_INLINE VU Move(std::size_t axis, VU direction) const {
    return LookUp(move_[axis], direction);
  }

  HWY_INLINE VU CellAt(const VU (&index)[3]) const {
    const DU du;
    const VU i_cells = hn::Set(du, cells_[0]);
    const VU j_cells = hn::Set(du, cells_[1]);
    return hn::Add(index[0], hn::Mul(i_cells, hn::Add(index[1], hn::Mul(j_cells, index[2]))));
  }

  template <bool kMeasure>
  HWY_INLINE void StoreBack(GridState& state, const GridPacket<kMeasure>& packet) const {
    const DU du;
    const VU u_by_2 = StrideBy2(packet.u);
    const VU v_by_2 = StrideBy2(packet.v);
    const VU corner = hn::Add(packet.first_by_2, StrideBy2(packet.ahead));
    hn::Store(corner, du, state.back_by_2[0]);
    hn::Store(hn::Add(corner, u_by_2), du, state.back_by_2[1]);
    hn::Store(hn::Add(hn::Add(corner, u_by_2), v_by_2), du, state.back_by_2[2]);
    hn::Store(hn::Add(corner, v_by_2), du, state.back_by_2[3]);
  }

  void PutPlace(GridState& state, std::size_t lane, const GridStart& start) const {
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

 private:
  const std::uint32_t cells_[2];  // along i and j
  HWY_ALIGN std::uint32_t stride_by_2_[kMaxLanes] = {};
  HWY_ALIGN std::uint32_t move_[3][kMaxLanes] = {};
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
