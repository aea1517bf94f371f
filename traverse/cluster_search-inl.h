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
    const std::size_t z = hull_.axis();
    HWY_ALIGN float keys[kClusterSize];
    std::uint32_t wanted = 0;
    for (std::size_t from = 0; from < kClusterSize; from += hn::Lanes(d)) {
      hn::Store(this->Keys(d, leaf.low[z] + from, leaf.high[z] + from, leaf.least + from,
                           leaf.greatest + from),
                d, keys + from);
      if (look_inside)
        wanted |= BitsOf(d, this->Matters(d, leaf.least + from, leaf.greatest + from)) << from;
    }
    wanted = (wanted | crooked) & ((1u << leaf.size) - 1);
    if (wanted == 0) return;
    for (std::size_t group = 0; group * ShearedLanes::Lanes() < bundle_.size(); ++group) {
      const std::size_t first_ray = group * ShearedLanes::Lanes();
      const float* const limits = target_.limits() + first_ray;
      const float limit = hn::GetLane(hn::MaxOfLanes(rays_of, hn::Load(rays_of, limits)));
      std::uint32_t cells = 0;
      for (std::size_t from = 0; from < kClusterSize; from += hn::Lanes(d))
        cells |= BitsOf(d, hn::And(hulls_[group].Meets(d, leaf.low, leaf.high, from),
                                   hn::Lt(hn::Load(d, keys + from), hn::Set(d, limit))))
                 << from;
      cells &= wanted;
      if (cells == 0) continue;
      const ShearedLanes lanes(bundle_, first_ray);
      for (; cells != 0; cells &= cells - 1) {
        const auto place = static_cast<std::uint32_t>(__builtin_ctz(cells));
        std::uint32_t rays = BitsOf(
            rays_of, hn::And(hn::Lt(hn::Set(rays_of, keys[place]), hn::Load(rays_of, limits)),
                             lanes.Meets(leaf.low, leaf.high, place)));
        for (; rays != 0; rays &= rays - 1)
          target_.go_through(first_ray + static_cast<std::size_t>(__builtin_ctz(rays)),
                             leaf.number[place]);
      }
    }
  }

 private:
  using SearchOrder<Target>::bundle_;
  using SearchOrder<Target>::hull_;
  using SearchOrder<Target>::hulls_;
  using SearchOrder<Target>::pass_;
  using SearchOrder<Target>::target_;

  Cache& leaves_;
};

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#endif  // include guard
