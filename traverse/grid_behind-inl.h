// What packets of rays through a curvilinear grid see of a cell behind the face by which they came.
// Compiled once for each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_GRID_BEHIND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_GRID_BEHIND_INL_H_
#undef PLUME_TRAVERSE_GRID_BEHIND_INL_H_
#else
#define PLUME_TRAVERSE_GRID_BEHIND_INL_H_
#endif
// clang-format on

#include <cstddef>

#include "hwy/highway.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/traverse/grid_grazes-inl.h"
#include "plume/traverse/grid_packet-inl.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/packet_walk-inl.h"
#include "plume/traverse/patch_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Lanes whose cell's index along one axis is within the box.
HWY_INLINE auto IsWithin(const CellBox& box, const VU (&index)[3], std::size_t axis) {
  const DU du;
  return hn::Lt(hn::Sub(index[axis], hn::Set(du, box.first[axis])), hn::Set(du, box.size[axis]));
}

// What lies behind the front, edge by edge and face by face.
template <bool kMeasure>
struct Behind {
  QuadLanes<kMeasure> q;  // the back
  // Whether edges between front and back, and of the back, cross y = 0, and on the right.
  VF across[4], along[4], right_across[4], right_along[4];
  VF side[4];  // whether side m winds an odd number of times
  VF odd;      // the front
  // A face has, or may have, two crossings.
  VF doubtful;
  // Lanes in which it is not clear by which face the ray leaves: the front winds an even number
  // of times, or several sides wind, or a face is doubtful.
  VF strange;
};

// `kTwisted`: all faces are looked at for grazes, by sizes as well where `kExact`; else lanes in
// the box of cells with twisted faces are doubtful (WalkableGrid::twisted).
template <bool kTwisted, bool kExact, bool kMeasure>
HWY_INLINE void LookBehind(const WalkableGrid& mesh, const float* points, int axis,
                           const GridState& state, const GridPacket<kMeasure>& packet,
                           Behind<kMeasure>& behind) {
  const DF d;
  const QuadLanes<kMeasure>& p = packet.front;
  QuadLanes<kMeasure>& q = behind.q;
  VF flipped_x[4], flipped_y[4];
  HWY_UNROLL(4)
  for (std::size_t m = 0; m < 4; ++m) {
    const ShearedLanes at = Shear(LoadFour(points, state.back_by_2[m]), axis, state);
    q.x[m] = at.x;
    q.y[m] = at.y;
    if constexpr (kMeasure) {
      q.z[m] = at.z;
      q.s[m] = at.s;
    }
    flipped_y[m] = hn::Abs(at.y);
    flipped_x[m] = hn::Xor(at.x, hn::And(at.y, hn::SignBit(d)));
  }
  // As TetSteps::Step.
  auto side_of = [&](std::size_t m, VF x, VF y) HWY_ATTR {
    return hn::Sub(hn::MulAdd(flipped_x[m], y, hn::Zero(d)), hn::Mul(x, flipped_y[m]));
  };
  FrontAndBack<kMeasure> cell{p, q, {}, {}, {}, {}};
  VF* const across = behind.across;
  VF* const along = behind.along;
  VF* const right_across = behind.right_across;
  VF* const right_along = behind.right_along;
  HWY_UNROLL(4)
  for (std::size_t m = 0; m < 4; ++m) {
    const std::size_t n = (m + 1) % 4;
    const VF with_front = side_of(m, p.x[m], p.y[m]), with_next = side_of(m, q.x[n], q.y[n]);
    if constexpr (kTwisted && kExact) {
      const VF down = hn::And(q.y[m], hn::SignBit(d));
      cell.along[m] = hn::Xor(with_next, down);
      cell.across[m] = hn::Neg(hn::Xor(with_front, down));
    } else if constexpr (kTwisted) {
      cell.along[m] = GrazeTest::Product(q.x[m], q.y[m], q.x[n], q.y[n]);
      cell.across[m] = GrazeTest::Product(p.x[m], p.y[m], q.x[m], q.y[m]);
    }
    across[m] = hn::Xor(p.y[m], q.y[m]);
    along[m] = hn::Xor(q.y[n], q.y[m]);
    right_across[m] = hn::And(with_front, across[m]);
    right_along[m] = hn::And(with_next, along[m]);
  }
  const VF* const right = packet.right;
  VF* const side = behind.side;
  HWY_UNROLL(4)
  for (std::size_t m = 0; m < 4; ++m)
    side[m] = Xor3(right[m], right_across[m], hn::Xor(right_across[(m + 1) % 4], right_along[m]));

  VF several = hn::And(side[0], side[1]);
  several = hn::Or(several, hn::And(hn::Or(side[0], side[1]), side[2]));
  several = hn::Or(several, hn::And(hn::Or(hn::Or(side[0], side[1]), side[2]), side[3]));
  behind.odd = Xor3(right[0], right[1], hn::Xor(right[2], right[3]));
  VF before[4];  // the front's edges: do they cross y = 0?
  HWY_UNROLL(4)
  for (std::size_t m = 0; m < 4; ++m) before[m] = hn::Xor(p.y[m], p.y[(m + 1) % 4]);
  VF doubtful = WindsTwice(along[0], along[1], along[2], right_along[0], right_along[1],
                           right_along[2], right_along[3]);
  HWY_UNROLL(4)
  for (std::size_t m = 0; m < 4; ++m) {
    const std::size_t n = (m + 1) % 4;
    doubtful = hn::Or(doubtful, WindsTwice(before[m], across[n], along[m], right[m],
                                           right_across[n], right_along[m], right_across[m]));
  }
  if constexpr (kTwisted) {
    auto settled = [&](VF odd, VF crosses0, VF crosses1, VF crosses2)
                       HWY_ATTR { return hn::Or(odd, hn::Not(Or3(crosses0, crosses1, crosses2))); };
    const VF back_odd = Xor3(behind.odd, hn::Xor(side[0], side[1]), hn::Xor(side[2], side[3]));
    cell.back_settled = settled(back_odd, along[0], along[1], along[2]);
    HWY_UNROLL(4)
    for (std::size_t m = 0; m < 4; ++m)
      cell.side_settled[m] = settled(side[m], before[m], across[(m + 1) % 4], along[m]);
    doubtful = hn::Or(doubtful, kExact ? cell.IsGrazed() : cell.MayBeGrazed());
  } else if (mesh.twisted.size[0] != 0) {
    const auto inside = hn::And(
        IsWithin(mesh.twisted, packet.index, 0),
        hn::And(IsWithin(mesh.twisted, packet.index, 1), IsWithin(mesh.twisted, packet.index, 2)));
    doubtful = hn::Or(doubtful, hn::VecFromMask(d, hn::RebindMask(d, inside)));
  }
  behind.doubtful = doubtful;
  behind.strange = Or3(several, hn::Not(behind.odd), doubtful);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
