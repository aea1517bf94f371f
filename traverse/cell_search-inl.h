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
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hwy/highway.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/traverse/cell_search.h"
#include "plume/traverse/ray_bundle.h"
#include "plume/traverse/tet_passage.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A bundle's hull against the boxes of a node's children.
class HullTest {
 public:
  explicit HullTest(const RayBundle& bundle)
      : hull_(bundle.hull()),
        x_(static_cast<std::size_t>((bundle.axis() + 1) % 3)),
        y_(static_cast<std::size_t>((bundle.axis() + 2) % 3)),
        z_(static_cast<std::size_t>(bundle.axis())),
        forwards_(bundle.sign() > 0) {}

  using D = HWY_CAPPED(float, CellHierarchy::kWidth);
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  // Rounding moves a face against a ray, and the hull, by less than 3e-6 (see boundary.cpp).
  static constexpr float kMargin = 0x1p-17f;

  // Children `from` and following: false for those that no ray of the bundle goes through.
  HWY_INLINE M Meets(const CellHierarchy::Node& node, std::size_t from) const {
    const D d;
    const V z_low = hn::Load(d, node.low[z_] + from), z_high = hn::Load(d, node.high[z_] + from);
    auto at = [&](const RayBundle::Line& line, V z) {
      return hn::Add(hn::Set(d, line.offset), hn::Mul(hn::Set(d, line.slope), z));
    };
    auto along = [&](std::size_t axis, const RayBundle::Line& least,
                     const RayBundle::Line& greatest) {
      const V low = hn::Sub(hn::Load(d, node.low[axis] + from), hn::Set(d, kMargin));
      const V high = hn::Add(hn::Load(d, node.high[axis] + from), hn::Set(d, kMargin));
      return hn::And(hn::Le(hn::Min(at(least, z_low), at(least, z_high)), high),
                     hn::Ge(hn::Max(at(greatest, z_low), at(greatest, z_high)), low));
    };
    return hn::And(along(x_, hull_.least_x, hull_.greatest_x),
                   along(y_, hull_.least_y, hull_.greatest_y));
  }

  // Where each begins along the rays: z * sign.
  HWY_INLINE V Begins(const CellHierarchy::Node& node, std::size_t from) const {
    const D d;
    return forwards_ ? hn::Load(d, node.low[z_] + from)
                     : hn::Neg(hn::Load(d, node.high[z_] + from));
  }
  float begins(const TetCell& cell) const {
    float least = std::numeric_limits<float>::infinity();
    for (const WalkablePoint& p : cell.points)
      least = std::min(least, forwards_ ? p.position[z_] : -p.position[z_]);
    return least;
  }

 private:
  const RayBundle::Hull hull_;
  const std::size_t x_, y_, z_;
  const bool forwards_;
};

// A tetrahedron against the rays of a bundle.
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

  // A bit for each ray whose limit is above `key` and about which some of the cell's faces wind:
  // the bits of crossing() from the numbers of ShearedFrame.
  HWY_INLINE std::uint64_t Rays(const TetCell& cell, const float* limits, float key) const {
    const D d;
    std::uint64_t rays = 0;
    for (std::size_t from = 0; from < bundle_.size(); from += hn::Lanes(d)) {
      const M wanted = hn::Lt(hn::Set(d, key), hn::Load(d, limits + from));
      if (hn::AllFalse(d, wanted)) continue;
      rays |= static_cast<std::uint64_t>(BitsOf(hn::And(wanted, Winds(cell, from)))) << from;
    }
    return rays;
  }

 private:
  struct Corner {
    V x, y;
    M up;
  };

  HWY_INLINE Corner Shear(const WalkablePoint& p, std::size_t from) const {
    const D d;
    auto sheared = [&](std::size_t axis, const float* offsets, const float* slopes) {
      return hn::Sub(hn::Sub(hn::Set(d, p.position[axis]), hn::Load(d, offsets + from)),
                     hn::Mul(hn::Load(d, slopes + from), hn::Set(d, p.position[z_])));
    };
    const V x = sheared(x_, bundle_.offsets_x(), bundle_.slopes_x());
    const V y = sheared(y_, bundle_.offsets_y(), bundle_.slopes_y());
    return {x, y, hn::Ge(y, hn::Zero(d))};
  }

  HWY_INLINE M Right(const Corner& a, const Corner& b) const {
    const V forth = hn::Mul(a.x, b.y), back = hn::Mul(b.x, a.y);
    return hn::Or(hn::And(hn::AndNot(a.up, b.up), hn::Gt(forth, back)),
                  hn::And(hn::AndNot(b.up, a.up), hn::Gt(back, forth)));
  }

  HWY_INLINE M Winds(const TetCell& cell, std::size_t from) const {
    const Corner p0 = Shear(cell.points[0], from), p1 = Shear(cell.points[1], from);
    const Corner p2 = Shear(cell.points[2], from), p3 = Shear(cell.points[3], from);
    const M r01 = Right(p0, p1), r02 = Right(p0, p2), r03 = Right(p0, p3);
    const M r12 = Right(p1, p2), r13 = Right(p1, p3), r23 = Right(p2, p3);
    auto odd = [](M a, M b, M c) { return hn::Xor(hn::Xor(a, b), c); };
    return hn::Or(hn::Or(odd(r12, r23, r13), odd(r03, r23, r02)),
                  hn::Or(odd(r01, r13, r03), odd(r02, r12, r01)));
  }

  static HWY_INLINE std::uint32_t BitsOf(M mask) {
    const D d;
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
  }

  const RayBundle& bundle_;
  const std::size_t x_, y_, z_;
};

// Goes through the hierarchy and hands to the target (see isosurface_target.h) the cells that its
// rays go through and that matter, more or less front to back, and all special ones.
template <class Target>
class CellSearch {
 public:
  CellSearch(const WalkableTets& mesh, const CellHierarchy& hierarchy, const RayBundle& bundle,
             Target& target)
      : mesh_(mesh), hierarchy_(hierarchy), hull_(bundle), tet_(bundle), target_(target) {}

  void Run() {
    stack_[0] = {-std::numeric_limits<float>::infinity(),
                 static_cast<std::uint32_t>(hierarchy_.levels.size() - 1), 0};
    size_ = 1;
    limit_ = target_.limit();
    while (size_ > 0) {
      const Item item = stack_[--size_];
      if (!(item.key < limit_)) continue;
      if (item.level == 0)
        Leaf(item.index);
      else
        Open(item);
    }
  }

 private:
  // A node of that level, counted from 1; 0 is a leaf.
  struct Item {
    float key;
    std::uint32_t level, index;
  };

  // Puts the children that matter on the stack, the nearest on top.
  HWY_INLINE void Open(const Item& item) {
    using D = HullTest::D;
    const D d;
    const std::uint32_t number = hierarchy_.levels[item.level - 1] + item.index;
    const CellHierarchy::Node& node = hierarchy_.nodes[number];
    std::uint32_t bits = 0;
    alignas(64) float keys[CellHierarchy::kWidth];
    for (std::size_t from = 0; from < CellHierarchy::kWidth; from += hn::Lanes(d)) {
      const auto least = hn::Load(d, node.least + from);
      const auto greatest = hn::Load(d, node.greatest + from);
      auto matters = BitsToMask(hierarchy_.special[number] >> from);
      for (const ScalarWindow& window : target_.windows())
        matters = hn::Or(matters, hn::And(hn::Lt(least, hn::Set(d, window.below)),
                                          hn::Ge(greatest, hn::Set(d, window.from))));
      const auto key = hull_.Begins(node, from);
      hn::Store(key, d, keys + from);
      const auto wanted = hn::And(hn::And(matters, hull_.Meets(node, from)),
                                  hn::Lt(key, hn::Set(d, limit_)));
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(d, wanted, bytes);
      bits |= static_cast<std::uint32_t>(bytes[0]) << from;
    }
    const std::size_t begin = size_;
    for (; bits != 0; bits &= bits - 1) {
      const auto child = static_cast<std::uint32_t>(__builtin_ctz(bits));
      std::size_t place = size_++;
      for (; place > begin && stack_[place - 1].key < keys[child]; --place)
        stack_[place] = stack_[place - 1];
      stack_[place] = {keys[child], item.level - 1,
                       static_cast<std::uint32_t>(CellHierarchy::kWidth) * item.index + child};
    }
  }

  static HWY_INLINE HullTest::M BitsToMask(std::uint32_t bits) {
    const HullTest::D d;
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
    return hn::LoadMaskBits(d, bytes);
  }

  void Leaf(std::uint32_t leaf) {
    const auto begin = static_cast<std::uint32_t>(CellHierarchy::kLeafCells) * leaf;
    const std::uint32_t end = std::min(
        hierarchy_.cell_count, begin + static_cast<std::uint32_t>(CellHierarchy::kLeafCells));
    const bool any_special = hierarchy_.near_special(begin);
    for (std::uint32_t c = begin; c < end; ++c) {
      TetCell cell = tet_cell(mesh_, c);
      if (!Matters(cell) && !(any_special && is_special(mesh_, c))) continue;
      std::uint64_t rays = tet_.Rays(cell, target_.limits(), hull_.begins(cell));
      for (; rays != 0; rays &= rays - 1)
        target_.visit(static_cast<std::size_t>(__builtin_ctzll(rays)), cell);
    }
    limit_ = target_.limit();
  }

  bool Matters(const TetCell& cell) const {
    float least = std::numeric_limits<float>::infinity(), greatest = -least;
    for (const WalkablePoint& p : cell.points) {
      least = p.scalar < least ? p.scalar : least;
      greatest = p.scalar > greatest ? p.scalar : greatest;
    }
    // What rounding may add to the values of one cell is in the ranges of leaves; here it would
    // show in a scalar that is equal to the isovalue.
    for (const ScalarWindow& window : target_.windows())
      if (least <= window.below && greatest >= window.from) return true;
    return false;
  }

  const WalkableTets& mesh_;
  const CellHierarchy& hierarchy_;
  const HullTest hull_;
  const TetTest tet_;
  Target& target_;
  float limit_ = 0;
  // Of each level at most all children but the one that is being opened.
  Item stack_[12 * CellHierarchy::kWidth];
  std::size_t size_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
