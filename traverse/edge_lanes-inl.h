// The ways out of cells of any number of corners, a cell's corners and edges side by side in
// vectors. Compiled once for each instruction set: to be included after hwy/foreach_target.h alone.

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
#include "plume/traverse/edge_primitives-inl.h"
#include "plume/traverse/fan_lanes-inl.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/loop_crossings.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

// Where the lanes' rays go.
struct EdgeExits {
  std::uint32_t face[kMaxLanes];  // a number in face_sides
  std::uint32_t rank[kMaxLanes];  // of the crossing
  HWY_ALIGN float corners[kMaxLanes]
                         [16];  // x, y, z and the scalar of what the way out is measured by
};

// CellWalker's leave() for several lanes, each in a cell of its own. A lane after the other goes
// through each of a few short loops, rather than through all of it: so a processor has several
// lanes on their way, and what it cannot guess costs it little.
class EdgeLanes {
 public:
  EdgeLanes(const WalkableCells& mesh, int axis)
      : mesh_(mesh),
        begin_(mesh.edge_cells.begin.data()),
        words_(mesh.edge_cells.words.data()),
        points_(mesh.points.data()->position),
        axis_(axis) {
    for (std::size_t i = 0; i < 4; ++i)
      order_[i] =
          static_cast<std::int32_t>(i == 3 ? 3 : (static_cast<std::size_t>(axis) + 1 + i) % 3);
  }

  // For the lanes, a bit each, whose rays came into these cells by the faces `entry`. Returned are
  // the lanes that it tells nothing of: whose cells have no record, or where the ray may cross its
  // cell's faces more than twice, or where `entry` is none of the two.
  template <bool kMeasure>
  HWY_INLINE unsigned Leave(const EdgeRay* rays, const std::uint32_t* cell,
                            const std::uint32_t* entry, unsigned lanes, EdgeExits& exits) const {
    Work work[kMaxLanes];
    unsigned unknown = 0;
    ForEach(lanes, [&](std::size_t lane) HWY_ATTR {
      const std::uint32_t begin = begin_[cell[lane]];
      const std::uint32_t none = begin == kNone ? 1 : 0;
      unknown |= none << lane;
      ShearCell(rays[lane], words_ + (begin & (none - 1)), work[lane]);
    });
    ForEach(lanes, [&](std::size_t lane) HWY_ATTR { DecideCell(work[lane]); });
    unsigned doubtful = 0, polygons = 0;
    ForEach(lanes, [&](std::size_t lane) HWY_ATTR {
      const std::uint32_t odd = work[lane].odd, others = odd & (odd - 1);
      // Two bits, no more; which of them is the way out nobody could guess: no branches.
      std::uint32_t bad = static_cast<std::uint32_t>(others == 0) |
                          static_cast<std::uint32_t>((others & (others - 1)) != 0) |
                          (unknown >> lane & 1);
      const std::uint32_t any = 1;
      const std::uint32_t* const faces = mesh_.cell_faces.data() + mesh_.cell_begin[cell[lane]];
      const std::uint32_t first = faces[hwy::Num0BitsBelowLS1Bit_Nonzero32(bad != 0 ? any : odd)];
      const std::uint32_t second =
          faces[hwy::Num0BitsBelowLS1Bit_Nonzero32(bad != 0 ? any : others)];
      std::uint32_t exit = first ^ second ^ entry[lane];
      bad |= static_cast<std::uint32_t>(exit != first) & static_cast<std::uint32_t>(exit != second);
      exit = bad != 0 ? first : exit;
      unknown |= bad << lane;
      exits.face[lane] = exit;
      exits.rank[lane] = 0;
      doubtful |= static_cast<unsigned>(work[lane].doubtful != 0) << lane;
      polygons |= static_cast<unsigned>(mesh_.face_begin[exit + 1] - mesh_.face_begin[exit] > 4)
                  << lane;
    });
    for (unsigned bits = doubtful & ~unknown; bits != 0; bits &= bits - 1) {
      const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
      const std::uint32_t* const faces = mesh_.cell_faces.data() + mesh_.cell_begin[cell[lane]];
      for (std::uint32_t of = work[lane].doubtful; of != 0; of &= of - 1)
        if (const std::size_t face = hwy::Num0BitsBelowLS1Bit_Nonzero32(of);
            !IsBeside(work[lane], face) && Crossings(*rays[lane].frame, faces[face]) != 0)
          unknown |= 1u << lane;
    }
    ForEach(polygons & ~unknown, [&](std::size_t lane) HWY_ATTR {
      if (!LeaveByFan<kMeasure>(rays[lane], mesh_.loop(exits.face[lane]), exits.rank[lane],
                                exits.corners[lane]))
        unknown |= 1u << lane;
    });
    if constexpr (kMeasure) {
      ForEach(lanes & ~polygons, [&](std::size_t lane) HWY_ATTR {
        const auto loop = mesh_.loop(exits.face[lane]);
        for (std::size_t i = 0; i < 3; ++i) Shear(rays[lane], loop[i], exits.corners[lane] + 4 * i);
        Shear(rays[lane], loop.back(), exits.corners[lane] + 12);
      });
    }
    return unknown;
  }

  // How many crossings a face has.
  HWY_NOINLINE std::size_t Crossings(const ShearedFrame& frame, std::uint32_t face) const {
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
  // ShearedFrame's operator(), to four floats.
  HWY_INLINE void Shear(const EdgeRay& ray, std::uint32_t point, float* to) const {
#if HWY_TARGET == HWY_SCALAR
    const ShearedPoint p = (*ray.frame)(mesh_.points[point]);
    to[0] = p.x;
    to[1] = p.y;
    to[2] = p.z;
    to[3] = p.scalar;
#else
    const hn::FixedTag<float, 4> d4;
    const auto p =
        hn::TableLookupLanes(hn::LoadU(d4, points_ + 4 * static_cast<std::size_t>(point)),
                             hn::SetTableIndices(d4, order_));
    const auto sheared = hn::Sub(hn::Sub(p, hn::Load(d4, ray.offset)),
                                 hn::Mul(hn::Load(d4, ray.slope), hn::Broadcast<2>(p)));
    hn::StoreU(sheared, d4, to);
#endif
  }

  // Of a cell's corners, a bit each: those below y = 0, those on the ray's right, and those that
  // are not well beyond each of four lines through the ray.
  struct CornerBits {
    std::uint32_t below = 0, right = 0, just = 0, within0 = 0, within1 = 0, within2 = 0,
                  within3 = 0;
    HWY_INLINE void operator|=(const CornerBits& other) {
      below |= other.below;
      right |= other.right;
      just |= other.just;
      within0 |= other.within0;
      within1 |= other.within1;
      within2 |= other.within2;
      within3 |= other.within3;
    }
  };

  // A lane's cell.
  struct Work {
    CornerTable table;
    CornerBits bits;
    const std::uint32_t* edges;
    std::uint32_t sizes;
    // A bit for each face that winds an odd number of times, and one for each that does not, but
    // may be crossed all the same.
    std::uint32_t odd, doubtful;
  };

  template <class Body>
  static HWY_INLINE void ForEach(unsigned lanes, const Body& body) {
    for (; lanes != 0; lanes &= lanes - 1) body(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
  }

  HWY_INLINE void ShearCell(const EdgeRay& ray, const std::uint32_t* record, Work& work) const {
    constexpr std::size_t kLanes = hn::MaxLanes(DF());
    const std::size_t corners = *record & 255;
    work.sizes = *record;
    work.edges = record + 1 + corners;
    CornerBits bits = ShearCorners(ray, record + 1, 0, corners, work.table);
    for (std::size_t c = kLanes; c < corners; c += kLanes)
      bits |= ShearCorners(ray, record + 1, c, corners, work.table);
    work.bits = bits;
  }

  HWY_INLINE void DecideCell(Work& work) const {
    const DU du;
    constexpr std::size_t kLanes = hn::MaxLanes(DF());
    const std::size_t edges = work.sizes >> 8 & 255, faces = work.sizes >> 16;
    VU of_faces = Odd(work.edges, 0, edges, work.table);
    for (std::size_t e = kLanes; e < edges; e += kLanes)
      of_faces = hn::Xor(of_faces, Odd(work.edges, e, edges, work.table));
    const std::uint32_t odd = XorOfLanes(du, of_faces);
    std::uint32_t doubtful = Doubtful(work.edges + edges, 0, faces, work.bits);
    for (std::size_t f = kLanes; f < faces; f += kLanes)
      doubtful |= Doubtful(work.edges + edges, f, faces, work.bits);
    work.odd = odd;
    work.doubtful = doubtful & ~odd;
  }

  // Puts as many corners as there are lanes, from the `at`-th, into the table.
  HWY_INLINE CornerBits ShearCorners(const EdgeRay& ray, const std::uint32_t* points,
                                     std::size_t at, std::size_t count, CornerTable& table) const {
    const DF d;
    const FourFloats p = LoadCorners(points_, points + at, count - at);
    const VF px = axis_ == 0 ? p.b : axis_ == 1 ? p.c : p.a;
    const VF py = axis_ == 0 ? p.c : axis_ == 1 ? p.a : p.b;
    const VF pz = axis_ == 0 ? p.a : axis_ == 1 ? p.b : p.c;
    const VF x =
        hn::Sub(hn::Sub(px, hn::Set(d, ray.offset[0])), hn::Mul(hn::Set(d, ray.slope[0]), pz));
    const VF y =
        hn::Sub(hn::Sub(py, hn::Set(d, ray.offset[1])), hn::Mul(hn::Set(d, ray.slope[1]), pz));
    hn::Store(x, d, table.x + at);
    hn::Store(y, d, table.y + at);
    const VF zero = hn::Zero(d), margin = hn::Set(d, kMargin), minus_margin = hn::Set(d, -kMargin);
    const VF sum = hn::Add(x, y), difference = hn::Sub(x, y);
    CornerBits bits;
    bits.below = BitsFrom(hn::Lt(y, zero), at);
    bits.right = BitsFrom(hn::Gt(x, zero), at);
    // So close to y = 0 that products may underflow.
    bits.just = bits.below & BitsFrom(hn::Gt(y, hn::Set(d, -0x1p-100f)), at);
    bits.within0 = bits.just | BitsFrom(hn::Lt(sum, margin), at);
    bits.within1 = BitsFrom(hn::Gt(sum, minus_margin), at);
    bits.within2 = bits.just | BitsFrom(hn::Lt(difference, margin), at);
    bits.within3 = BitsFrom(hn::Gt(difference, minus_margin), at);
    return bits;
  }

  // A word whose bits are the faces at a lane's edge if that crosses y = 0 on the ray's right.
  static HWY_INLINE VU Odd(const std::uint32_t* edges, std::size_t at, std::size_t count,
                           const CornerTable& table) {
    const DU du;
    // An edge from corner 0 to itself, as what is beyond the last is then, does not cross.
    const VU edge = hn::IfThenElseZero(hn::FirstN(du, count - at), hn::LoadU(du, edges + at));
    VF ax, ay, bx, by;
    table.Get(edge, ax, ay);
    table.Get(hn::ShiftRight<8>(edge), bx, by);
    const MF right = CrossesRight(ax, ay, bx, by);
    return hn::IfThenElseZero(hn::RebindMask(du, right), FacesOf(edge));
  }

  // Faces of which the corners do not say at once that the ray passes beside them.
  static HWY_INLINE std::uint32_t Doubtful(const std::uint32_t* faces, std::size_t at,
                                           std::size_t count, const CornerBits& bits) {
    const DU du;
    const VU mask = hn::IfThenElseZero(hn::FirstN(du, count - at), hn::LoadU(du, faces + at));
    auto none = [&](std::uint32_t corners)
                    HWY_ATTR { return hn::Eq(hn::And(mask, hn::Set(du, corners)), hn::Zero(du)); };
    const auto beside = hn::Or(hn::Or(none(bits.below), none(~bits.below)),
                               hn::Or(none(bits.right), none(~bits.right)));
    const auto far = hn::Or(hn::Or(none(bits.within0), none(bits.within1)),
                            hn::Or(none(bits.within2), none(bits.within3)));
    return BitsFrom(hn::RebindMask(DF(), hn::Not(hn::Or(beside, far))), at);
  }

  // Whether the corners of a face are well beyond one of some more lines through the ray.
  static HWY_INLINE bool IsBeside(const Work& work, std::size_t face) {
    const DF d;
    constexpr std::size_t kLanes = hn::MaxLanes(DF());
    const std::size_t corners = work.sizes & 255, edges = work.sizes >> 8 & 255;
    const std::uint32_t mask = work.edges[edges + face];
    std::uint32_t below[kLines] = {}, above[kLines] = {};
    for (std::size_t c = 0; c < corners; c += kLanes) {
      const VF x = hn::Load(d, work.table.x + c), y = hn::Load(d, work.table.y + c);
      for (std::size_t i = 0; i < kLines; ++i) {
        const VF along =
            hn::Add(hn::Mul(x, hn::Set(d, kLine[i][0])), hn::Mul(y, hn::Set(d, kLine[i][1])));
        below[i] |= BitsFrom(hn::Lt(along, hn::Set(d, kMargin)), c);
        above[i] |= BitsFrom(hn::Gt(along, hn::Set(d, -kMargin)), c);
      }
    }
    unsigned beside = 0;
    for (std::size_t i = 0; i < kLines; ++i)
      beside |= static_cast<unsigned>((mask & (below[i] | work.bits.just)) == 0) |
                static_cast<unsigned>((mask & above[i]) == 0);
    return beside != 0;
  }

  // The triangle by which the ray leaves through a polygon, and its corners. False where there are
  // several.
  template <bool kMeasure>
  HWY_INLINE bool LeaveByFan(const EdgeRay& ray, std::span<const std::uint32_t> loop,
                             std::uint32_t& rank, float* corners) const {
    HWY_ALIGN float fan[kMostEdgeCellCorners][4];
    for (std::size_t i = 0; i < loop.size(); ++i) Shear(ray, loop[i], fan[i]);
    return CrossFan<kMeasure>(fan, loop.size(), rank, corners);
  }

  // A face whose corners are all that far beyond a line through the ray is not crossed, and the
  // scalar walker says so, too. Coordinates are below 8 (those of the mesh below 1, a ray that
  // meets it within 2 of its centre), so that rounding moves a corner's distance from the line, or
  // that of a fan's centre, by less than 2^-20. With the line to the left of them, edges and spokes
  // cross y = 0 at x >= 2^-19 if they do: the products that right_of_ray() compares differ by that
  // times the edge's extent in y, which is more than their rounding, 2^-21 of it at the most; they
  // are not both rounded to 0, as no corner is just below y = 0. So all of these bits are 1, and
  // around every triangle they add up to 0. With the line to the right all are 0, as rounding turns
  // no order around. Of quadrilaterals the same bits and products in double precision decide
  // (is_grazed()). Their signs are exact, so what they say could be wrong only where the patch's
  // quadratics nearly have a double root, whose place is then within 2^-24 of the ray, rather than
  // 2^-19.
  static constexpr float kMargin = 0x1p-18f;
  static constexpr std::size_t kLines = 8;
  static constexpr float kLine[kLines][2] = {{1, 0.25f},  {1, 0.6f},  {0.6f, 1},  {0.25f, 1},
                                             {1, -0.25f}, {1, -0.6f}, {0.6f, -1}, {0.25f, -1}};

  const WalkableCells& mesh_;
  const std::uint32_t* begin_;
  const std::uint32_t* words_;
  const float* points_;
  const int axis_;
  HWY_ALIGN std::int32_t order_[4];
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
