// How a bundle of rays goes through clusters of cells that are not tetrahedra. Compiled once for
// each instruction set: to be included after hwy/foreach_target.h alone.

// clang-format off
#if defined(PLUME_TRAVERSE_CLUSTER_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef PLUME_TRAVERSE_CLUSTER_SEARCH_INL_H_
#undef PLUME_TRAVERSE_CLUSTER_SEARCH_INL_H_
#else
#define PLUME_TRAVERSE_CLUSTER_SEARCH_INL_H_
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "plume/mesh/cell_clusters.h"
#include "plume/traverse/cell_search.h"
#include "plume/traverse/cluster_cache.h"
#include "plume/traverse/face_search-inl.h"
#include "plume/traverse/hexahedron_lanes-inl.h"
#include "plume/traverse/ray_bundle.h"
#include "plume/traverse/search_order-inl.h"
#include "plume/traverse/tree_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// As CellSearch: hands to the target the cells whose boxes its rays meet and that matter, and all
// crooked ones.
template <class Cache, class Target>
class ClusterSearch : public SearchOrder<Target> {
 public:
  ClusterSearch(Cache& leaves, const RayBundle& bundle, Target& target)
      : SearchOrder<Target>(bundle, target), leaves_(leaves) {}

  void Run(SearchPass pass) {
    pass_ = pass;
    TreeSearch<ClusterSearch>(leaves_.clusters().cells, hull_, *this).Run();
  }
  void RunBoundary() {
    using Faces = FaceBoxCache<typename Cache::Mesh>;
    FaceSearch<Faces, Target>(leaves_.faces(), bundle_, hull_, target_).Run();
  }
  void AskFor(std::uint32_t /*leaf*/) const {}

  void Leaf(std::uint32_t number, bool matters) {
    const HWY_CAPPED(float, 16) d;
    const ShearedLanes::D rays_of;
    const unsigned crooked = pass_ == SearchPass::inside ? 0 : leaves_.clusters().crooked[number];
    const bool look_inside = matters && pass_ != SearchPass::special;
    if (!look_inside && crooked == 0) return;
    const ReadCluster& leaf = leaves_.read(number);
    std::uint32_t wanted = crooked;
    for (std::size_t from = 0; look_inside && from < kClusterSize; from += hn::Lanes(d))
      wanted |= BitsOf(d, this->Matters(d, leaf.least + from, leaf.greatest + from)) << from;
    wanted &= (1u << leaf.size) - 1;
    if (wanted == 0) return;
    this->ForEachNear(
        leaf, wanted,
        [&](std::uint32_t place, std::size_t first_ray, const ShearedLanes& lanes,
            ShearedLanes::M near) HWY_ATTR {
          const bool all = (crooked >> place & 1) != 0;
          const float* const limits = target_.limits() + first_ray;
          std::uint32_t rays =
              BitsOf(rays_of, hn::And(near, (leaf.has_corners >> place & 1) != 0
                                                ? MayGoThrough(lanes, leaf, place, all, limits)
                                                : lanes.Meets(leaf.low, leaf.high, place)));
          for (; rays != 0; rays &= rays - 1)
            target_.go_through(first_ray + static_cast<std::size_t>(__builtin_ctz(rays)),
                               leaf.number[place]);
        });
  }

 private:
  // Of a cell with eight corners: rays that may cross its faces, and of these, where not `all` are
  // asked for, those on whose way a scalar may be that matters.
  HWY_INLINE ShearedLanes::M MayGoThrough(const ShearedLanes& lanes, const ReadCluster& leaf,
                                          std::size_t place, bool all, const float* limits) const {
    const ShearedLanes::D d;
    const HexahedronLanes cell(lanes, leaf.position, place);
    const auto none = hn::MaskFromVec(hn::Zero(d));
    if (Target::kKey != CellKey::place || all) {
      auto through = none;
      for (std::size_t face = 0; face < 6; ++face) {
        const float key = Target::kKey == CellKey::least ? leaf.face_least[face][place]
                                                         : -leaf.face_greatest[face][place];
        const auto crossed = cell.MayCross(face);
        // All that a crooked cell has to say is wanted; else faces with a better value.
        through =
            hn::Or(through,
                   all ? crossed : hn::And(crossed, hn::Lt(hn::Set(d, key), hn::Load(d, limits))));
      }
      return through;
    }
    auto matters = none;
    ShearedLanes::M crossed[6] = {cell.MayCross(0), cell.MayCross(1), cell.MayCross(2),
                                  cell.MayCross(3), cell.MayCross(4), cell.MayCross(5)};
    for (const ScalarWindow& window : target_.windows()) {
      // Between faces all of which are above a value, or below, nothing of it is on the way.
      auto not_above = none, not_below = none;
      for (std::size_t face = 0; face < 6; ++face) {
        if (!(leaf.face_least[face][place] >= window.below))
          not_above = hn::Or(not_above, crossed[face]);
        if (!(leaf.face_greatest[face][place] < window.from))
          not_below = hn::Or(not_below, crossed[face]);
      }
      matters = hn::Or(matters, hn::And(not_above, not_below));
    }
    return matters;
  }

  using SearchOrder<Target>::bundle_;
  using SearchOrder<Target>::hull_;
  using SearchOrder<Target>::pass_;
  using SearchOrder<Target>::target_;

  Cache& leaves_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
