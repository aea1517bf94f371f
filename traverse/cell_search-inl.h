// How a bundle of rays goes through a hierarchy of cells, front to back. Compiled once for each
// instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_CELL_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_CELL_SEARCH_INL_H_
#undef PLUME_TRAVERSE_CELL_SEARCH_INL_H_
#else
#define PLUME_TRAVERSE_CELL_SEARCH_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "hwy/highway.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/traverse/cell_search.h"
#include "plume/traverse/ray_bundle.h"
#include "plume/traverse/tet_passage.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// What several rays of a bundle lie in, against boxes that lie side by side.
class HullTest {
 public:
  HullTest() = default;
  HullTest(const RayBundle& bundle, const RayBundle::Hull& hull)
      : hull_(hull),
        x_(static_cast<std::size_t>((bundle.axis() + 1) % 3)),
        y_(static_cast<std::size_t>((bundle.axis() + 2) % 3)),
        z_(static_cast<std::size_t>(bundle.axis())) {}

  // Rounding moves a face against a ray, and the hull, by less than 3e-6 (see boundary.cpp).
  static constexpr float kMargin = 0x1p-17f;

  // Boxes `from` and following: false for those that no ray goes through.
  template <class D, std::size_t kBoxes>
  HWY_INLINE hn::Mask<D> Meets(D d, const float (&lows)[3][kBoxes], const float (&highs)[3][kBoxes],
                               std::size_t from) const {
    const auto z_low = hn::Load(d, lows[z_] + from), z_high = hn::Load(d, highs[z_] + from);
    auto at = [&](const RayBundle::Line& line, hn::Vec<D> z) HWY_ATTR {
      return hn::MulAdd(hn::Set(d, line.slope), z, hn::Set(d, line.offset));
    };
    auto along = [&](std::size_t axis, const RayBundle::Line& least,
                     const RayBundle::Line& greatest) HWY_ATTR {
      const auto low = hn::Sub(hn::Load(d, lows[axis] + from), hn::Set(d, kMargin));
      const auto high = hn::Add(hn::Load(d, highs[axis] + from), hn::Set(d, kMargin));
      return hn::And(hn::Le(hn::Min(at(least, z_low), at(least, z_high)), high),
                     hn::Ge(hn::Max(at(greatest, z_low), at(greatest, z_high)), low));
    };
    return hn::And(along(x_, hull_.least_x, hull_.greatest_x),
                   along(y_, hull_.least_y, hull_.greatest_y));
  }

 private:
  RayBundle::Hull hull_{};
  std::size_t x_ = 0, y_ = 0, z_ = 0;
};

template <class D>
HWY_INLINE std::uint32_t BitsOf(D d, hn::Mask<D> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

template <class D>
HWY_INLINE hn::Mask<D> MaskOf(D d, std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits),
                                 static_cast<std::uint8_t>(bits >> 8)};
  return hn::LoadMaskBits(d, bytes);
}

// Tetrahedra against a vector of rays.
class TetTest {
 public:
  explicit TetTest(const RayBundle& bundle)
      : bundle_(bundle),
        x_(static_cast<std::size_t>((bundle.axis() + 1) % 3)),
        y_(static_cast<std::size_t>((bundle.axis() + 2) % 3)),
        z_(static_cast<std::size_t>(bundle.axis())) {}

  using D = HWY_CAPPED(float, 16);
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  // The rays `from` and following that the target has to see of a cell.
  struct Rays {
    M through;   // they go through, and a scalar that matters may be on the way
    M boundary;  // they go through a face at the boundary
  };
  // Bits are those of crossing(), from the numbers of ShearedFrame. `open_faces` are at the
  // boundary. Of a cell that is not `whole`, none go through; of one that is `thin`, all do.
  HWY_INLINE Rays Test(const LeafCells& cells, std::size_t cell, std::size_t from, bool whole,
                       bool thin, std::span<const ScalarWindow> windows) const {
    const Corner p0 = Shear(cells, 0, cell, from), p1 = Shear(cells, 1, cell, from);
    const Corner p2 = Shear(cells, 2, cell, from), p3 = Shear(cells, 3, cell, from);
    const Edge e01(p0, p1), e02(p0, p2), e03(p0, p3), e12(p1, p2), e13(p1, p3), e23(p2, p3);
    const M winds[4] = {hn::Xor(hn::Xor(e12.right, e23.right), e13.right),
                        hn::Xor(hn::Xor(e03.right, e23.right), e02.right),
                        hn::Xor(hn::Xor(e01.right, e13.right), e03.right),
                        hn::Xor(hn::Xor(e02.right, e12.right), e01.right)};
    const D d;
    const M none = hn::MaskFromVec(hn::Zero(d));
    Rays rays{none, none};
    for (std::size_t face = 0; face < 4; ++face)
      if ((cells.open_faces[cell] >> face & 1) != 0)
        rays.boundary = hn::Or(rays.boundary, winds[face]);
    if (!whole) return rays;
    if (thin) {
      for (const M& face : winds) rays.through = hn::Or(rays.through, face);
      return rays;
    }
    // Products of the sheared numbers, of which areas and so scalars are made, are off by at most
    // 2^-22 of the product of the largest x and y; with three values weighted, 2^-19 is enough.
    auto largest = [&](V Corner::*of) HWY_ATTR {
      return hn::Max(hn::Max(hn::Abs(p0.*of), hn::Abs(p1.*of)),
                     hn::Max(hn::Abs(p2.*of), hn::Abs(p3.*of)));
    };
    const V rounding =
        hn::Mul(hn::Mul(largest(&Corner::x), largest(&Corner::y)), hn::Set(d, 0x1p-19f));
    for (const ScalarWindow& window : windows) {
      // A scalar is equal to the value where rounding to single precision makes it so.
      float above[4], most = 0.5f * std::abs(window.from);
      for (std::size_t i = 0; i < 4; ++i) {
        above[i] = cells.scalar[i][cell] - window.from;
        most = std::max(most, std::abs(above[i]));
      }
      const V margin = hn::Mul(rounding, hn::Set(d, most)), minus = hn::Neg(margin);
      M all_above = hn::Not(none), all_below = all_above;
      // Twice a face's area times how far the scalar on it is above the value.
      auto add = [&](std::size_t face, const Edge& ab, std::size_t c, const Edge& bc, std::size_t a,
                     const Edge& ca, std::size_t b) HWY_ATTR {
        const V sum = hn::MulAdd(
            ab.area, hn::Set(d, above[c]),
            hn::MulAdd(bc.area, hn::Set(d, above[a]), hn::Mul(ca.area, hn::Set(d, above[b]))));
        all_above = hn::And(all_above, hn::Or(hn::Not(winds[face]), hn::Gt(sum, margin)));
        all_below = hn::And(all_below, hn::Or(hn::Not(winds[face]), hn::Lt(sum, minus)));
      };
      add(0, e12, 3, e23, 1, e13, 2);
      add(1, e02, 3, e23, 0, e03, 2);
      add(2, e01, 3, e13, 0, e03, 1);
      add(3, e01, 2, e12, 0, e02, 1);
      rays.through = hn::Or(rays.through, hn::Not(hn::Or(all_above, all_below)));
    }
    return rays;
  }

 private:
  struct Corner {
    V x, y;
    M up;
  };
  struct Edge {
    M right;
    V area;  // of the triangle with the ray, twice
    HWY_INLINE Edge(const Corner& a, const Corner& b) {
      const V forth = hn::Mul(a.x, b.y), back = hn::Mul(b.x, a.y);
      right = hn::Or(hn::And(hn::AndNot(a.up, b.up), hn::Gt(forth, back)),
                     hn::And(hn::AndNot(b.up, a.up), hn::Gt(back, forth)));
      area = hn::Abs(hn::Sub(forth, back));
    }
  };

  HWY_INLINE Corner Shear(const LeafCells& cells, std::size_t corner, std::size_t cell,
                          std::size_t from) const {
    const D d;
    auto sheared = [&](std::size_t axis, const float* offsets, const float* slopes) HWY_ATTR {
      return hn::Sub(
          hn::Sub(hn::Set(d, cells.position[axis][corner][cell]), hn::Load(d, offsets + from)),
          hn::Mul(hn::Load(d, slopes + from), hn::Set(d, cells.position[z_][corner][cell])));
    };
    const V x = sheared(x_, bundle_.offsets_x(), bundle_.slopes_x());
    const V y = sheared(y_, bundle_.offsets_y(), bundle_.slopes_y());
    return {x, y, hn::Ge(y, hn::Zero(d))};
  }

  const RayBundle& bundle_;
  const std::size_t x_, y_, z_;
};

// Goes through the hierarchy and hands to the target (see isosurface_target.h) the cells that its
// rays go through and that matter, more or less front to back, all thin ones, and all that they go
// into or out of at the boundary.
template <class Target>
class CellSearch {
 public:
  CellSearch(LeafCache& leaves, const RayBundle& bundle, Target& target)
      : leaves_(leaves),
        hierarchy_(leaves.hierarchy()),
        bundle_(bundle),
        hull_(bundle, bundle.hull()),
        tet_(bundle),
        z_(static_cast<std::size_t>(bundle.axis())),
        forwards_(bundle.sign() > 0),
        target_(target) {
    for (std::size_t group = 0; group * Lanes() < bundle.size(); ++group)
      hulls_[group] = HullTest(
          bundle, bundle.hull(group * Lanes(), std::min(bundle.size(), (group + 1) * Lanes())));
  }

  // All that matters and all that is special; or the special cells alone, of which only faces at
  // the boundary and thin cells count, or the others alone.
  enum class Pass { all, special, inside };

  void Run(Pass pass) {
    pass_ = pass;
    stack_[0] = {-std::numeric_limits<float>::infinity(),
                 static_cast<std::uint32_t>(hierarchy_.levels.size() - 1), 0, true};
    size_ = 1;
    limit_ = target_.limit();
    while (size_ > 0) {
      const Item item = stack_[--size_];
      if (!(item.key < limit_)) continue;
      if (item.level == 0)
        Leaf(item.index, item.matters);
      else
        Open(item);
    }
  }

 private:
  // A node of that level, counted from 1; 0 is a leaf. Where its range does not matter, its special
  // cells do.
  struct Item {
    float key;
    std::uint32_t level, index;
    bool matters;
  };

  static std::size_t Lanes() { return hn::Lanes(TetTest::D()); }

  // Whether the scalars between these matter.
  template <class D>
  HWY_INLINE hn::Mask<D> Matters(D d, const float* least, const float* greatest) const {
    if constexpr (Target::kKey != CellKey::place)
      return hn::Le(hn::Load(d, least), hn::Load(d, greatest));
    auto matters = hn::MaskFromVec(hn::Zero(d));
    for (const ScalarWindow& window : target_.windows())
      matters = hn::Or(matters, hn::And(hn::Lt(hn::Load(d, least), hn::Set(d, window.below)),
                                        hn::Ge(hn::Load(d, greatest), hn::Set(d, window.from))));
    return matters;
  }

  // Of boxes and ranges: see Target.
  template <class D>
  HWY_INLINE hn::Vec<D> Keys(D d, const float* low, const float* high, const float* least,
                             const float* greatest) const {
    if constexpr (Target::kKey == CellKey::place)
      return forwards_ ? hn::Load(d, low) : hn::Neg(hn::Load(d, high));
    else if (pass_ == Pass::special)
      return hn::Set(d, -std::numeric_limits<float>::infinity());
    else
      return Target::kKey == CellKey::least ? hn::Load(d, least) : hn::Neg(hn::Load(d, greatest));
  }

  // Puts the children that matter on the stack, that with the least key on top.
  HWY_INLINE void Open(const Item& item) {
    const HWY_CAPPED(float, CellHierarchy::kWidth) d;
    const std::uint32_t number = hierarchy_.levels[item.level - 1] + item.index;
    const CellHierarchy::Node& node = hierarchy_.nodes[number];
    std::uint32_t matters = 0, open = 0;
    HWY_ALIGN float keys[CellHierarchy::kWidth];
    for (std::size_t from = 0; from < CellHierarchy::kWidth; from += hn::Lanes(d)) {
      const auto key = Keys(d, node.low[z_] + from, node.high[z_] + from, node.least + from,
                            node.greatest + from);
      hn::Store(key, d, keys + from);
      matters |= BitsOf(d, Matters(d, node.least + from, node.greatest + from)) << from;
      open |= BitsOf(d, hn::And(hull_.Meets(d, node.low, node.high, from),
                                hn::Lt(key, hn::Set(d, limit_))))
              << from;
    }
    open &= pass_ == Pass::special  ? hierarchy_.special[number]
            : pass_ == Pass::inside ? matters
                                    : matters | hierarchy_.special[number];
    const std::size_t begin = size_;
    for (; open != 0; open &= open - 1) {
      const auto child = static_cast<std::uint32_t>(__builtin_ctz(open));
      std::size_t place = size_++;
      for (; place > begin && stack_[place - 1].key < keys[child]; --place)
        stack_[place] = stack_[place - 1];
      stack_[place] = {keys[child], item.level - 1,
                       static_cast<std::uint32_t>(CellHierarchy::kWidth) * item.index + child,
                       (matters >> child & 1) != 0};
      if (item.level == 1)
        leaves_.ask_for(stack_[place].index);
      else
        AskFor(item.level - 1, stack_[place].index);
    }
  }

  void AskFor(std::uint32_t level, std::uint32_t index) const {
    const auto* const node =
        reinterpret_cast<const char*>(&hierarchy_.nodes[hierarchy_.levels[level - 1] + index]);
    for (std::size_t line = 0; line < sizeof(CellHierarchy::Node); line += 64)
      __builtin_prefetch(node + line);
  }

  void Leaf(std::uint32_t number, bool matters) {
    const HWY_CAPPED(float, 16) d;
    const std::uint32_t first = number * static_cast<std::uint32_t>(kLeafCells);
    const std::uint32_t size =
        std::min(hierarchy_.cell_count - first, static_cast<std::uint32_t>(kLeafCells));
    const unsigned all = (1u << size) - 1;
    const unsigned special = pass_ == Pass::inside ? 0 : hierarchy_.leaves[number].special;
    // Cells to go through; of the other special ones, only faces at the boundary.
    const unsigned thin = hierarchy_.leaves[number].thin;
    const bool look_inside = matters && pass_ != Pass::special;
    const unsigned through = (look_inside ? thin | MayMatter(number) : thin) & all;
    const unsigned wanted = through | (special & all);
    if (wanted == 0) return;
    const ReadLeaf& leaf = leaves_.read(number, wanted);
    HWY_ALIGN float keys[kLeafCells];
    for (std::size_t from = 0; from < kLeafCells; from += hn::Lanes(d))
      hn::Store(Keys(d, leaf.low[z_] + from, leaf.high[z_] + from, leaf.least + from,
                     leaf.greatest + from),
                d, keys + from);
    for (std::size_t group = 0; group * Lanes() < bundle_.size(); ++group) {
      const std::size_t first_ray = group * Lanes();
      const float* const limits = target_.limits() + first_ray;
      const float limit = hn::GetLane(hn::MaxOfLanes(d, hn::Load(d, limits)));
      unsigned cells = 0;
      for (std::size_t from = 0; from < kLeafCells; from += hn::Lanes(d))
        cells |= BitsOf(d, hn::And(hulls_[group].Meets(d, leaf.low, leaf.high, from),
                                   hn::Lt(hn::Load(d, keys + from), hn::Set(d, limit))))
                 << from;
      for (cells &= wanted; cells != 0; cells &= cells - 1) {
        const auto place = static_cast<std::uint32_t>(__builtin_ctz(cells));
        const auto near = hn::Lt(hn::Set(d, keys[place]), hn::Load(d, limits));
        const bool whole = (through >> place & 1) != 0, is_thin = (thin >> place & 1) != 0;
        const TetTest::Rays found =
            tet_.Test(leaf.cells, place, first_ray, whole,
                      is_thin || Target::kKey != CellKey::place, target_.windows());
        unsigned rays = BitsOf(d, hn::And(near, found.through));
        unsigned boundary = BitsOf(d, hn::And(near, found.boundary));
        if (Target::kKey == CellKey::place) boundary &= ~rays;  // going through, it crosses that
        if (pass_ == Pass::inside) boundary = 0;
        if ((rays | boundary) == 0) continue;
        const TetCell cell = CellOf(leaf, first + place, place);
        auto ray_of = [&](unsigned bits) {
          return first_ray + static_cast<std::size_t>(__builtin_ctz(bits));
        };
        for (; rays != 0; rays &= rays - 1) target_.go_through(ray_of(rays), cell);
        for (; boundary != 0; boundary &= boundary - 1)
          target_.cross_boundary(ray_of(boundary), cell);
      }
    }
    limit_ = target_.limit();
  }

  // A bit for each cell of a leaf whose values may matter.
  unsigned MayMatter(std::uint32_t leaf) const {
    if constexpr (Target::kKey != CellKey::place) return 0xFFFF;
    const CellHierarchy::Node& node = hierarchy_.nodes[leaf / CellHierarchy::kWidth];
    const std::size_t child = leaf % CellHierarchy::kWidth;
    const CellHierarchy::Sixteenths sixteenths(node.least[child], node.greatest[child]);
    const auto& ranges = hierarchy_.leaves[leaf].ranges;
    unsigned cells = 0;
    for (const ScalarWindow& window : target_.windows()) {
      const int from = sixteenths.of(window.from);
      const int below = sixteenths.of(window.below);
      for (unsigned i = 0; i < kLeafCells; ++i)
        cells |= static_cast<unsigned>((ranges[i] & 15) <= below && ranges[i] >> 4 >= from) << i;
    }
    return cells;
  }

  static TetCell CellOf(const ReadLeaf& leaf, std::uint32_t number, std::size_t place) {
    TetCell cell;
    cell.cell = number;
    cell.odd = (leaf.cells.odd >> place & 1) != 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t a = 0; a < 3; ++a)
        cell.points[i].position[a] = leaf.cells.position[a][i][place];
      cell.points[i].scalar = leaf.cells.scalar[i][place];
    }
    return cell;
  }

  LeafCache& leaves_;
  const CellHierarchy& hierarchy_;
  const RayBundle& bundle_;
  const HullTest hull_;
  const TetTest tet_;
  const std::size_t z_;
  const bool forwards_;
  Target& target_;
  HullTest hulls_[RayBundle::kRays];  // of as many rays as a vector has lanes
  Pass pass_ = Pass::all;
  float limit_ = 0;
  // Of each level at most all children but the one that is being opened.
  Item stack_[12 * CellHierarchy::kWidth];
  std::size_t size_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
