// The way out of a cell of any number of corners for one ray, the cell's corners and edges side by
// side in vectors. Compiled once for each instruction set: to be included after
// hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_EDGE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_EDGE_LANES_INL_H_
#undef PLUME_TRAVERSE_EDGE_LANES_INL_H_
#else
#define PLUME_TRAVERSE_EDGE_LANES_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>
#include <span>

#include "hwy/highway.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/loop_crossings.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

template <class D>
HWY_INLINE std::uint32_t XorOfLanes(D /*d*/, hn::Vec<D> v) {
  if constexpr (hn::MaxLanes(D()) > 4) {
    const hn::Half<D> half;
    return XorOfLanes(half, hn::Xor(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
  } else if constexpr (hn::MaxLanes(D()) == 4) {
    v = hn::Xor(v, hn::Shuffle1032(v));
    return hn::GetLane(hn::Xor(v, hn::Shuffle2301(v)));
  } else {
    return hn::GetLane(v);
  }
}

// The sheared corners of a cell, to be looked up by their numbers.
class CornerTable {
 public:
#if HWY_TARGET <= HWY_AVX3
  // Two vectors of x and two of y.
  HWY_INLINE void Put(std::size_t at, VF x, VF y) {
    x_[at / kMaxLanes] = x;
    y_[at / kMaxLanes] = y;
  }
  // Of the numbers no more than the lowest five bits count.
  HWY_INLINE void Get(VU numbers, VF& x, VF& y) const {
    x = VF{_mm512_permutex2var_ps(x_[0].raw, numbers.raw, x_[1].raw)};
    y = VF{_mm512_permutex2var_ps(y_[0].raw, numbers.raw, y_[1].raw)};
  }

 private:
  VF x_[2] = {hn::Zero(DF()), hn::Zero(DF())};
  VF y_[2] = {hn::Zero(DF()), hn::Zero(DF())};
#else
  HWY_INLINE void Put(std::size_t at, VF x, VF y) {
    hn::Store(x, DF(), x_ + at);
    hn::Store(y, DF(), y_ + at);
  }
  HWY_INLINE void Get(VU numbers, VF& x, VF& y) const {
    const auto at = hn::BitCast(hn::RebindToSigned<DF>(), hn::And(numbers, hn::Set(DU(), 31)));
    x = hn::GatherIndex(DF(), x_, at);
    y = hn::GatherIndex(DF(), y_, at);
  }

 private:
  HWY_ALIGN float x_[kMostEdgeCellCorners];
  HWY_ALIGN float y_[kMostEdgeCellCorners];
#endif
};

// Where edges cross y = 0 on the ray's right, whichever way they go: crossing() is not 0.
HWY_INLINE MF CrossesRight(VF ax, VF ay, VF bx, VF by) {
  const VF zero = hn::Zero(DF());
  const MF a_up = hn::Ge(ay, zero), b_up = hn::Ge(by, zero);
  const VF forth = hn::Mul(ax, by), back = hn::Mul(bx, ay);
  return hn::Or(hn::And(hn::AndNot(a_up, b_up), hn::Gt(forth, back)),
                hn::And(hn::AndNot(b_up, a_up), hn::Gt(back, forth)));
}

// A ray's exit from a cell: a number of a face in face_sides, and the rank of its crossing.
struct EdgeExit {
  std::uint32_t face, rank;
};

class EdgeLanes {
 public:
  EdgeLanes(const WalkableCells& mesh, int axis)
      : mesh_(mesh),
        begin_(mesh.edge_cells.begin.data()),
        words_(mesh.edge_cells.words.data()),
        points_(mesh.points.data()->position),
        axis_(axis) {}

  // CellWalker's leave(), where the cell has a record, the ray crosses its faces twice, and `entry`
  // is one of these two; false where that may not be so. The corners of what the way out is measured by are
  // written to `corners`, x, y, z and the scalar of each of four.
  template <bool kMeasure>
  HWY_INLINE bool Leave(const LaneState& state, std::size_t lane, const ShearedFrame& frame,
                        std::uint32_t cell, std::uint32_t entry, EdgeExit& exit,
                        float* corners) const {
    const std::uint32_t begin = begin_[cell];
    if (HWY_UNLIKELY(begin == kNone)) return false;
    std::uint32_t odd, doubtful;
    Decide(state, lane, words_ + begin, odd, doubtful);
    const std::uint32_t* const faces = mesh_.cell_faces.data() + mesh_.cell_begin[cell];
    const std::uint32_t others = odd & (odd - 1);
    // Two bits, no more.
    if (HWY_UNLIKELY(others == 0 || (others & (others - 1)) != 0)) return false;
    const std::uint32_t first = faces[hwy::Num0BitsBelowLS1Bit_Nonzero32(odd)];
    const std::uint32_t second = faces[hwy::Num0BitsBelowLS1Bit_Nonzero32(others)];
    if (HWY_UNLIKELY(first != entry && second != entry)) return false;
    exit.face = first == entry ? second : first;
    exit.rank = 0;
    for (; doubtful != 0; doubtful &= doubtful - 1)
      if (HWY_UNLIKELY(crossings(
              frame, faces[hwy::Num0BitsBelowLS1Bit_Nonzero32(doubtful)]) != 0))
        return false;
    const auto loop = mesh_.loop(exit.face);
    if (loop.size() > 4) return Fan<kMeasure>(frame, loop, exit.rank, corners);
    if constexpr (kMeasure) {
      for (std::size_t i = 0; i < 4; ++i)
        put(frame(mesh_.points[loop[i < loop.size() ? i : loop.size() - 1]]), corners + 4 * i);
    }
    return true;
  }

  // How many crossings the face has.
  HWY_NOINLINE std::size_t crossings(const ShearedFrame& frame, std::uint32_t face) const {
    const auto loop = mesh_.loop(face);
    ShearedPoint corners[kMostEdgeCellCorners];
    LoopSides sides;
    for (std::size_t i = 0; i < loop.size(); ++i) corners[i] = frame(mesh_.points[loop[i]]);
    for (std::size_t i = 0; i < loop.size(); ++i)
      sides.add_edge(corners[i == 0 ? loop.size() - 1 : i - 1], corners[i]);
    std::size_t count = 0;
    for_each_crossing(
        sides, loop.size(), [&] { return std::span<const ShearedPoint>(corners, loop.size()); },
        [&](const LoopCrossing&) { ++count; });
    return count;
  }

 private:
  static void put(const ShearedPoint& p, float* to) {
    to[0] = p.x;
    to[1] = p.y;
    to[2] = p.z;
    to[3] = p.scalar;
  }

  // A bit for each face that winds an odd number of times, and one for each that does not, but may
  // be crossed all the same.
  HWY_INLINE void Decide(const LaneState& state, std::size_t lane, const std::uint32_t* record,
                         std::uint32_t& odd, std::uint32_t& doubtful) const {
    const DF d;
    const DU du;
    constexpr std::size_t kLanes = hn::MaxLanes(DF());
    const VF offset_x = hn::Set(d, state.offset_x[lane]);
    const VF offset_y = hn::Set(d, state.offset_y[lane]);
    const VF slope_x = hn::Set(d, state.slope_x[lane]);
    const VF slope_y = hn::Set(d, state.slope_y[lane]);
    const std::uint32_t sizes = *record;
    const std::size_t corners = sizes & 255, edges = sizes >> 8 & 255, faces = sizes >> 16;
    const std::uint32_t* const points = record + 1;
    const std::uint32_t* const edge_words = points + corners;
    const std::uint32_t* const masks = edge_words + edges;

    CornerTable table;
    std::uint32_t up = 0, right = 0, beyond[4] = {0, 0, 0, 0};
    for (std::size_t c = 0; c < corners; c += kLanes) {
      HWY_ALIGN std::uint32_t ids[kMaxLanes];
      const auto used = hn::FirstN(du, corners - c);
      hn::Store(hn::IfThenElseZero(used, hn::LoadU(du, points + c)), du, ids);
      const FourFloats p = LoadFour(points_, ids);
      const VF px = axis_ == 0 ? p.b : axis_ == 1 ? p.c : p.a;
      const VF py = axis_ == 0 ? p.c : axis_ == 1 ? p.a : p.b;
      const VF pz = axis_ == 0 ? p.a : axis_ == 1 ? p.b : p.c;
      const VF x = hn::Sub(hn::Sub(px, offset_x), hn::Mul(slope_x, pz));
      const VF y = hn::Sub(hn::Sub(py, offset_y), hn::Mul(slope_y, pz));
      table.Put(c, x, y);
      auto bits = [c](MF mask) { return static_cast<std::uint32_t>(BitsOf(mask)) << c; };
      up |= bits(hn::Ge(y, hn::Zero(d)));
      right |= bits(hn::Gt(x, hn::Zero(d)));
      const VF margin = hn::Set(d, kMargin);
      const VF sum = hn::Add(x, y), difference = hn::Sub(x, y);
      beyond[0] |= bits(hn::Ge(sum, margin));
      beyond[1] |= bits(hn::Le(sum, hn::Neg(margin)));
      beyond[2] |= bits(hn::Ge(difference, margin));
      beyond[3] |= bits(hn::Le(difference, hn::Neg(margin)));
    }

    VU of_faces = hn::Zero(du);
    const VU one = hn::Set(du, 1);
    for (std::size_t e = 0; e < edges; e += kLanes) {
      const VU edge = hn::LoadU(du, edge_words + e);
      VF ax, ay, bx, by;
      table.Get(edge, ax, ay);
      table.Get(hn::ShiftRight<8>(edge), bx, by);
      const VU face = hn::And(hn::ShiftRight<16>(edge), hn::Set(du, 31));
      const VU other = hn::ShiftRight<24>(edge);
      const VU both = hn::Xor(hn::Shl(one, face), hn::Shl(one, other));
      const auto crosses = hn::And(hn::RebindMask(du, CrossesRight(ax, ay, bx, by)),
                                   hn::FirstN(du, edges - e));
      of_faces = hn::Xor(of_faces, hn::IfThenElseZero(crosses, both));
    }
    odd = XorOfLanes(du, of_faces);

    doubtful = 0;
    for (std::size_t f = 0; f < faces; f += kLanes) {
      const VU mask = hn::IfThenElseZero(hn::FirstN(du, faces - f), hn::LoadU(du, masks + f));
      auto none = [&](std::uint32_t corner_bits) {
        return hn::Eq(hn::And(mask, hn::Set(du, corner_bits)), hn::Zero(du));
      };
      auto all_or_none = [&](std::uint32_t corner_bits) {
        return hn::Or(none(corner_bits), none(~corner_bits));
      };
      auto beside = hn::Or(all_or_none(up), all_or_none(right));
      for (const std::uint32_t corner_bits : beyond) beside = hn::Or(beside, none(~corner_bits));
      doubtful |= static_cast<std::uint32_t>(BitsOf(hn::RebindMask(d, hn::Not(beside)))) << f;
    }
    doubtful &= ~odd;
  }

  // Of a polygon's fan the triangle that the ray crosses: its rank and its corners. False where
  // there are several.
  template <bool kMeasure>
  HWY_INLINE bool Fan(const ShearedFrame& frame, std::span<const std::uint32_t> loop,
                      std::uint32_t& rank, float* corners) const {
    ShearedPoint fan[kMostEdgeCellCorners];
    for (std::size_t i = 0; i < loop.size(); ++i) fan[i] = frame(mesh_.points[loop[i]]);
    const std::span<const ShearedPoint> p(fan, loop.size());
    const ShearedPoint center = fan_center(p);
    const ShearedPoint* from = &p.back();
    int from_spoke = crossing_unbranched(center, *from);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const int to_spoke = crossing_unbranched(center, p[i]);
      const int of_triangle = from_spoke + crossing_unbranched(*from, p[i]) - to_spoke;
      if (of_triangle != 0) {
        ++count;
        rank = static_cast<std::uint32_t>(i);
      }
      from_spoke = to_spoke;
      from = &p[i];
    }
    if (count != 1) return false;
    if constexpr (kMeasure) {
      put(center, corners);
      put(p[rank == 0 ? p.size() - 1 : rank - 1], corners + 4);
      put(p[rank], corners + 8);
      put(p[rank], corners + 12);
    }
    return true;
  }

  static constexpr float kMargin = 0x1p-18f;

  const WalkableCells& mesh_;
  const std::uint32_t* begin_;
  const std::uint32_t* words_;
  const float* points_;
  const int axis_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
