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
#include <cstring>
#include <span>

#include "hwy/highway.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/traverse/lane_loads-inl.h"
#include "plume/traverse/loop_crossings.h"
#include "plume/traverse/packet_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
template <class D>
HWY_INLINE std::uint32_t XorOfLanes(D /*d*/, hn::Vec<D> v) {
  return hn::GetLane(v);
}
#else
template <class D>
HWY_INLINE std::uint32_t XorOfLanes(D /*d*/, hn::Vec<D> v) {
  if constexpr (hn::MaxLanes(D()) > 4) {
    const hn::Half<D> half;
    return XorOfLanes(half, hn::Xor(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
  } else {
    v = hn::Xor(v, hn::Shuffle1032(v));
    return hn::GetLane(hn::Xor(v, hn::Shuffle2301(v)));
  }
}
#endif

// A bit for each lane, moved up to where the lanes are.
HWY_INLINE std::uint32_t BitsFrom(MF mask, std::size_t at) {
#if HWY_TARGET <= HWY_AVX3
  return static_cast<std::uint32_t>(mask.raw) << at;
#else
  return static_cast<std::uint32_t>(BitsOf(mask)) << at;
#endif
}

// A ray in a cell.
struct EdgeRay {
  // x, y, 0, 0 of what ShearedFrame subtracts, so that a point's z and scalar stay as they are.
  HWY_ALIGN float offset[4];
  HWY_ALIGN float slope[4];
  const ShearedFrame* frame;

  void put(const ShearedFrame& of) {
    const ShearedFrame::Line line = of.line();
    offset[0] = line.offset_x;
    offset[1] = line.offset_y;
    slope[0] = line.slope_x;
    slope[1] = line.slope_y;
    offset[2] = offset[3] = slope[2] = slope[3] = 0;
    frame = &of;
  }
};

// The sheared corners of a cell, to be looked up by their numbers.
struct CornerTable {
  HWY_ALIGN float x[kMostEdgeCellCorners];
  HWY_ALIGN float y[kMostEdgeCellCorners];

  // Those of several numbers, of which no more than the lowest five bits count.
  HWY_INLINE void Get(VU numbers, VF& at_x, VF& at_y) const {
    const DF d;
#if HWY_TARGET <= HWY_AVX3
    at_x = VF{_mm512_permutex2var_ps(hn::Load(d, x).raw, numbers.raw, hn::Load(d, x + 16).raw)};
    at_y = VF{_mm512_permutex2var_ps(hn::Load(d, y).raw, numbers.raw, hn::Load(d, y + 16).raw)};
#else
    const auto at = hn::BitCast(hn::RebindToSigned<DF>(), hn::And(numbers, hn::Set(DU(), 31)));
    at_x = hn::GatherIndex(d, x, at);
    at_y = hn::GatherIndex(d, y, at);
#endif
  }
};

// The floats at base + 2 * pairs[i], i below `count`, a multiple of four; something in the lanes
// beyond. The fourth ones are left out.
HWY_INLINE FourFloats LoadCorners(const float* HWY_RESTRICT base, const std::uint32_t* pairs,
                                  std::size_t count) {
#if HWY_TARGET <= HWY_AVX3
  const std::uint32_t* const second = count > 4 ? pairs + 4 : pairs;
  const std::uint32_t* const third = count > 8 ? pairs + 8 : pairs;
  const std::uint32_t* const fourth = count > 12 ? pairs + 12 : pairs;
  auto row = [&](std::size_t i) {
    auto load = [&](const std::uint32_t* from) {
      return _mm_loadu_ps(base + 2 * static_cast<std::size_t>(from[i]));
    };
    __m512 lanes = _mm512_castps128_ps512(load(pairs));
    lanes = _mm512_mask_broadcast_f32x4(lanes, 0x00F0, load(second));
    lanes = _mm512_mask_broadcast_f32x4(lanes, 0x0F00, load(third));
    return VF{_mm512_mask_broadcast_f32x4(lanes, 0xF000, load(fourth))};
  };
  const DF d;
  const hn::Repartition<std::uint64_t, DF> d64;
  const VF p0 = row(0), p1 = row(1), p2 = row(2), p3 = row(3);
  const auto ab01 = hn::BitCast(d64, hn::InterleaveLower(d, p0, p1));
  const auto ab23 = hn::BitCast(d64, hn::InterleaveLower(d, p2, p3));
  const auto cd01 = hn::BitCast(d64, hn::InterleaveUpper(d, p0, p1));
  const auto cd23 = hn::BitCast(d64, hn::InterleaveUpper(d, p2, p3));
  return {hn::BitCast(d, hn::InterleaveLower(d64, ab01, ab23)),
          hn::BitCast(d, hn::InterleaveUpper(d64, ab01, ab23)),
          hn::BitCast(d, hn::InterleaveLower(d64, cd01, cd23)), hn::Zero(d)};
#else
  const DU du;
  HWY_ALIGN std::uint32_t used[kMaxLanes];
  hn::Store(hn::IfThenElseZero(hn::FirstN(du, count), hn::LoadU(du, pairs)), du, used);
  return LoadFour(base, used);
#endif
}

// Where edges cross y = 0 on the ray's right, whichever way they go: crossing() is not 0.
HWY_INLINE MF CrossesRight(VF ax, VF ay, VF bx, VF by) {
  const VF zero = hn::Zero(DF());
  const VF forth = hn::Mul(ax, by), back = hn::Mul(bx, ay);
#if HWY_TARGET <= HWY_AVX3
  // Each comparison takes the one before as its mask.
  __mmask16 rises = _mm512_cmp_ps_mask(ay.raw, zero.raw, _CMP_LT_OQ);
  __mmask16 falls = _mm512_cmp_ps_mask(by.raw, zero.raw, _CMP_LT_OQ);
  rises = _mm512_mask_cmp_ps_mask(rises, by.raw, zero.raw, _CMP_GE_OQ);
  falls = _mm512_mask_cmp_ps_mask(falls, ay.raw, zero.raw, _CMP_GE_OQ);
  rises = _mm512_mask_cmp_ps_mask(rises, forth.raw, back.raw, _CMP_GT_OQ);
  falls = _mm512_mask_cmp_ps_mask(falls, back.raw, forth.raw, _CMP_GT_OQ);
  return MF{static_cast<__mmask16>(rises | falls)};
#else
  const MF a_up = hn::Ge(ay, zero), b_up = hn::Ge(by, zero);
  return hn::Or(hn::And(hn::AndNot(a_up, b_up), hn::Gt(forth, back)),
                hn::And(hn::AndNot(b_up, a_up), hn::Gt(back, forth)));
#endif
}

// The two faces at an edge, a bit each.
HWY_INLINE VU FacesOf(VU edge) {
#if HWY_TARGET <= HWY_AVX3
  // A rotation takes no more than the lowest five bits of a number.
  // (With an all-true mask, as in lane_loads-inl.h.)
  const __m512i one = _mm512_set1_epi32(1);
  const __m512i face = hn::ShiftRight<16>(edge).raw, other = hn::ShiftRight<24>(edge).raw;
  return hn::Xor(VU{_mm512_maskz_rolv_epi32(0xFFFF, one, face)},
                 VU{_mm512_maskz_rolv_epi32(0xFFFF, one, other)});
#else
  const VU one = hn::Set(DU(), 1);
  const VU face = hn::And(hn::ShiftRight<16>(edge), hn::Set(DU(), 31));
  return hn::Xor(hn::Shl(one, face), hn::Shl(one, hn::ShiftRight<24>(edge)));
#endif
}

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
      if (!Fan<kMeasure>(rays[lane], mesh_.loop(exits.face[lane]), exits.rank[lane],
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

  // Of a polygon's fan the triangle that the ray crosses: its rank and its corners. False where
  // there are several.
  template <bool kMeasure>
  HWY_INLINE bool Fan(const EdgeRay& ray, std::span<const std::uint32_t> loop, std::uint32_t& rank,
                      float* corners) const {
    HWY_ALIGN float fan[kMostEdgeCellCorners][4];
    const std::size_t size = loop.size();
    for (std::size_t i = 0; i < size; ++i) Shear(ray, loop[i], fan[i]);
    HWY_ALIGN float center[4];
    CenterOf(fan, size, center);
    const std::uint32_t crossed = size <= hn::MaxLanes(DF()) ? CrossedTogether(fan, size, center)
                                                             : CrossedInTurn(fan, size, center);
    if (HWY_UNLIKELY((crossed & (crossed - 1)) != 0)) return false;
    rank = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(crossed));
    if constexpr (kMeasure) {
      Copy(center, corners);
      Copy(fan[rank == 0 ? size - 1 : rank - 1], corners + 4);
      Copy(fan[rank], corners + 8);
      Copy(fan[rank], corners + 12);
    }
    return true;
  }

  static HWY_INLINE void Copy(const float* from, float* to) { std::memcpy(to, from, 16); }

  // fan_center()
  static HWY_INLINE void CenterOf(const float (*fan)[4], std::size_t size, float* center) {
    const float count = static_cast<float>(size);
#if HWY_TARGET == HWY_SCALAR
    for (std::size_t a = 0; a < 4; ++a) {
      center[a] = 0;
      for (std::size_t i = 0; i < size; ++i) center[a] += fan[i][a];
      center[a] /= count;
    }
#else
    const hn::FixedTag<float, 4> d4;
    auto sum = hn::Zero(d4);
    for (std::size_t i = 0; i < size; ++i) sum = hn::Add(sum, hn::Load(d4, fan[i]));
    hn::Store(hn::Div(sum, hn::Set(d4, count)), d4, center);
#endif
  }

  // The triangles of a fan that wind about the ray: three edges of which one or three cross on its
  // right.
  static HWY_INLINE std::uint32_t CrossedTogether(const float (*fan)[4], std::size_t size,
                                                  const float* center) {
    const DF d;
    const DU du;
    HWY_ALIGN std::uint32_t pairs[kMaxLanes];
    const auto used = hn::FirstN(du, size);
    const VU number = hn::IfThenElseZero(used, hn::Iota(du, 0));
    hn::Store(hn::ShiftLeft<1>(number), du, pairs);
    const FourFloats to = LoadFour(fan[0], pairs);
    const VU before = hn::IfThenElse(hn::Eq(number, hn::Zero(du)),
                                     hn::Set(du, static_cast<std::uint32_t>(size - 1)),
                                     hn::Sub(number, hn::Set(du, 1)));
    const auto indices = hn::IndicesFromVec(d, before);
    const VF from_x = hn::TableLookupLanes(to.a, indices);
    const VF from_y = hn::TableLookupLanes(to.b, indices);
    const std::uint32_t rim = BitsFrom(CrossesRight(from_x, from_y, to.a, to.b), 0);
    const std::uint32_t spokes =
        BitsFrom(CrossesRight(hn::Set(d, center[0]), hn::Set(d, center[1]), to.a, to.b), 0);
    const std::uint32_t spokes_before = spokes << 1 | (spokes >> (size - 1) & 1);
    return (rim ^ spokes ^ spokes_before) & ((1u << size) - 1);
  }

  static HWY_NOINLINE std::uint32_t CrossedInTurn(const float (*fan)[4], std::size_t size,
                                                  const float* center) {
    auto point = [](const float* p) { return ShearedPoint{p[0], p[1], p[2], p[3]}; };
    const ShearedPoint middle = point(center);
    ShearedPoint from = point(fan[size - 1]);
    int from_spoke = crossing(middle, from);
    std::uint32_t crossed = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const ShearedPoint to = point(fan[i]);
      const int to_spoke = crossing(middle, to);
      if (from_spoke + crossing(from, to) - to_spoke != 0) crossed |= 1u << i;
      from = to;
      from_spoke = to_spoke;
    }
    return crossed;
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
