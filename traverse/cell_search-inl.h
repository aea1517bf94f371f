// How a bundle of rays goes through a hierarchy of tetrahedra. Compiled once for each instruction
// set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_CELL_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_CELL_SEARCH_INL_H_
#undef PLUME_TRAVERSE_CELL_SEARCH_INL_H_
#else
#define PLUME_TRAVERSE_CELL_SEARCH_INL_H_
#endif
// clang-format on

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hwy/highway.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/traverse/cell_search.h"
#include "plume/traverse/face_search-inl.h"
#include "plume/traverse/ray_bundle.h"
#include "plume/traverse/search_order-inl.h"
#include "plume/traverse/tet_lanes-inl.h"
#include "plume/traverse/tet_passage.h"
#include "plume/traverse/tree_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Goes through the hierarchy and hands to the target (see segment_target.h) the cells that its
// rays go through and that matter, more or less front to back, and all thin ones.
template <class Target>
class CellSearch : public SearchOrder<Target> {
 public:
  CellSearch(LeafCache& leaves, const RayBundle& bundle, Target& target)
      : SearchOrder<Target>(bundle, target), leaves_(leaves), hierarchy_(leaves.hierarchy()) {}

  void Run(SearchPass pass) {
    pass_ = pass;
    TreeSearch<CellSearch>(hierarchy_.cells, hull_, *this).Run();
  }
  // All faces at the boundary.
  void RunBoundary() {
    FaceSearch<FaceCache, Target>(leaves_.faces(), bundle_, hull_, target_).Run();
  }

  void AskFor(std::uint32_t leaf) const { leaves_.ask_for(leaf); }

  void Leaf(std::uint32_t number, bool matters) {
    const std::uint32_t first = number * static_cast<std::uint32_t>(kLeafCells);
    const std::uint32_t size =
        std::min(hierarchy_.cell_count - first, static_cast<std::uint32_t>(kLeafCells));
    const unsigned thin = pass_ == SearchPass::inside ? 0 : hierarchy_.leaves[number].thin;
    const bool look_inside = matters && pass_ != SearchPass::special;
    const unsigned wanted = (look_inside ? thin | MayMatter(number) : thin) & ((1u << size) - 1);
    if (wanted == 0) return;
    const ReadLeaf& leaf = leaves_.read(number, wanted);
    this->ForEachNear(
        leaf, wanted,
        [&](std::uint32_t place, std::size_t first_ray, const ShearedLanes& lanes,
            ShearedLanes::M near) HWY_ATTR {
          const bool all = (thin >> place & 1) != 0 || Target::kKey != CellKey::place;
          unsigned rays =
              BitsOf(ShearedLanes::D(),
                     hn::And(near, GoThrough(lanes, leaf.cells, place, all, target_.windows())));
          if (rays == 0) return;
          const TetCell cell = CellOf(leaf, first + place, place);
          for (; rays != 0; rays &= rays - 1)
            target_.go_through(first_ray + static_cast<std::size_t>(__builtin_ctz(rays)), cell);
        });
  }

 private:
  // A bit for each cell of a leaf whose values may matter.
  unsigned MayMatter(std::uint32_t leaf) const {
    if constexpr (Target::kKey != CellKey::place) return 0xFFFF;
    const ClusterTree::Node& node = hierarchy_.cells.nodes[leaf / ClusterTree::kWidth];
    const std::size_t child = leaf % ClusterTree::kWidth;
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

  using SearchOrder<Target>::bundle_;
  using SearchOrder<Target>::hull_;
  using SearchOrder<Target>::pass_;
  using SearchOrder<Target>::target_;

  LeafCache& leaves_;
  const CellHierarchy& hierarchy_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
