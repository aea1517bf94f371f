#include "plume/traverse/cell_search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/cell_search.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/cell_search-inl.h"
#include "plume/traverse/cluster_search-inl.h"
#include "plume/traverse/search_targets.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

template <class Search, class Target>
void Run(Search search, Target& target) {
  if constexpr (Target::kKey == CellKey::place) {
    search.Run(SearchPass::all);
    // What lies behind what was found does not matter.
    search.RunBoundary();
  } else {
    // Rays that miss the mesh, or are to be walked, look for nothing inside.
    search.RunBoundary();
    search.Run(SearchPass::special);
    target.boundary_done();
    search.Run(SearchPass::inside);
  }
}

void SearchTets(LeafCache& leaves, const RayBundle& bundle, SearchTarget<TetCells> target) {
  std::visit(
      [&](auto* of) { Run(CellSearch<std::decay_t<decltype(*of)>>(leaves, bundle, *of), *of); },
      target);
}

template <class Walker>
void SearchClusters(ClusterCache<Walker>& leaves, const RayBundle& bundle,
                    SearchTarget<AnyCells<Walker>> target) {
  std::visit(
      [&](auto* of) {
        using Search = ClusterSearch<ClusterCache<Walker>, std::decay_t<decltype(*of)>>;
        Run(Search(leaves, bundle, *of), *of);
      },
      target);
}
void SearchGrid(ClusterCache<GridWalker>& leaves, const RayBundle& bundle,
                SearchTarget<AnyCells<GridWalker>> target) {
  SearchClusters(leaves, bundle, target);
}
void SearchMixed(ClusterCache<CellWalker>& leaves, const RayBundle& bundle,
                 SearchTarget<AnyCells<CellWalker>> target) {
  SearchClusters(leaves, bundle, target);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(SearchTets);
HWY_EXPORT(SearchGrid);
HWY_EXPORT(SearchMixed);

namespace {

TetCells cells_of(const LeafCache& leaves) { return {leaves.mesh(), leaves.hierarchy()}; }
template <class Walker>
AnyCells<Walker> cells_of(const ClusterCache<Walker>& leaves) {
  return AnyCells<Walker>(leaves.mesh());
}

void search(LeafCache& leaves, const RayBundle& bundle, SearchTarget<TetCells> target) {
  HWY_DYNAMIC_DISPATCH(SearchTets)(leaves, bundle, target);
}
void search(ClusterCache<GridWalker>& leaves, const RayBundle& bundle,
            SearchTarget<AnyCells<GridWalker>> target) {
  HWY_DYNAMIC_DISPATCH(SearchGrid)(leaves, bundle, target);
}
void search(ClusterCache<CellWalker>& leaves, const RayBundle& bundle,
            SearchTarget<AnyCells<CellWalker>> target) {
  HWY_DYNAMIC_DISPATCH(SearchMixed)(leaves, bundle, target);
}

template <bool kGreatest, class Cache>
void find_extreme(Cache& leaves, RayBundle& bundle, std::span<SearchedRay> found,
                  std::span<float> values) {
  if (bundle.size() == 0) return;
  bundle.fill();
  const auto cells = cells_of(leaves);
  ExtremeTarget<std::decay_t<decltype(cells)>, kGreatest> target(cells, bundle, found);
  search(leaves, bundle, &target);
  for (std::size_t ray = 0; ray < bundle.size(); ++ray) values[ray] = target.value(ray);
}

}  // namespace

template <class Cache>
void find_segments(Cache& leaves, const SoughtSegments& sought, RayBundle& bundle,
                   std::span<SearchedRay> found) {
  if (bundle.size() == 0) return;
  bundle.fill();
  const auto cells = cells_of(leaves);
  SegmentTarget<std::decay_t<decltype(cells)>> target(cells, sought, bundle, found);
  search(leaves, bundle, &target);
  // World length of what rounding may make of a place.
  target.finish({sought.connected, kSearchRounding / leaves.mesh().frame.scale});
}

template <class Cache>
void find_greatest(Cache& leaves, RayBundle& bundle, std::span<SearchedRay> found,
                   std::span<float> values) {
  find_extreme<true>(leaves, bundle, found, values);
}

template <class Cache>
void find_least(Cache& leaves, RayBundle& bundle, std::span<SearchedRay> found,
                std::span<float> values) {
  find_extreme<false>(leaves, bundle, found, values);
}

template void find_segments(LeafCache&, const SoughtSegments&, RayBundle&, std::span<SearchedRay>);
template void find_segments(ClusterCache<GridWalker>&, const SoughtSegments&, RayBundle&,
                            std::span<SearchedRay>);
template void find_segments(ClusterCache<CellWalker>&, const SoughtSegments&, RayBundle&,
                            std::span<SearchedRay>);
template void find_greatest(LeafCache&, RayBundle&, std::span<SearchedRay>, std::span<float>);
template void find_greatest(ClusterCache<GridWalker>&, RayBundle&, std::span<SearchedRay>,
                            std::span<float>);
template void find_greatest(ClusterCache<CellWalker>&, RayBundle&, std::span<SearchedRay>,
                            std::span<float>);
template void find_least(LeafCache&, RayBundle&, std::span<SearchedRay>, std::span<float>);
template void find_least(ClusterCache<GridWalker>&, RayBundle&, std::span<SearchedRay>,
                         std::span<float>);
template void find_least(ClusterCache<CellWalker>&, RayBundle&, std::span<SearchedRay>,
                         std::span<float>);

}  // namespace plume
#endif  // HWY_ONCE
