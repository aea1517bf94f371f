#include "plume/traverse/cell_search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/cell_search.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/cell_search-inl.h"
#include "plume/traverse/extreme_target.h"
#include "plume/traverse/isosurface_target.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void SearchIsosurfaces(LeafCache& leaves, const RayBundle& bundle, IsosurfaceTarget& target) {
  using Search = CellSearch<IsosurfaceTarget>;
  Search search(leaves, bundle, target);
  search.Run(Search::Pass::all);
  search.RunBoundary();
}

template <class Target>
void SearchExtremes(LeafCache& leaves, const RayBundle& bundle, Target& target) {
  using Search = CellSearch<Target>;
  Search search(leaves, bundle, target);
  search.RunBoundary();
  search.Run(Search::Pass::thin);
  target.boundary_done();
  search.Run(Search::Pass::inside);
}
void SearchGreatest(LeafCache& leaves, const RayBundle& bundle, ExtremeTarget<true>& target) {
  SearchExtremes(leaves, bundle, target);
}
void SearchLeast(LeafCache& leaves, const RayBundle& bundle, ExtremeTarget<false>& target) {
  SearchExtremes(leaves, bundle, target);
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(SearchIsosurfaces);
HWY_EXPORT(SearchGreatest);
HWY_EXPORT(SearchLeast);

void find_isosurfaces(LeafCache& leaves, std::span<const SoughtIsovalue> isovalues,
                      double connected, RayBundle& bundle, std::span<SearchedRay> found) {
  if (bundle.size() == 0) return;
  bundle.fill();
  IsosurfaceTarget target(leaves.mesh(), leaves.hierarchy(), isovalues, bundle, found);
  HWY_DYNAMIC_DISPATCH(SearchIsosurfaces)(leaves, bundle, target);
  // World length of what rounding may make of a place.
  target.finish({connected, IsosurfaceTarget::kRounding / leaves.mesh().frame.scale});
}

void find_greatest(LeafCache& leaves, RayBundle& bundle, std::span<SearchedRay> found,
                   std::span<float> values) {
  if (bundle.size() == 0) return;
  bundle.fill();
  ExtremeTarget<true> target(leaves.mesh(), bundle, found);
  HWY_DYNAMIC_DISPATCH(SearchGreatest)(leaves, bundle, target);
  for (std::size_t ray = 0; ray < bundle.size(); ++ray) values[ray] = target.value(ray);
}

void find_least(LeafCache& leaves, RayBundle& bundle, std::span<SearchedRay> found,
                std::span<float> values) {
  if (bundle.size() == 0) return;
  bundle.fill();
  ExtremeTarget<false> target(leaves.mesh(), bundle, found);
  HWY_DYNAMIC_DISPATCH(SearchLeast)(leaves, bundle, target);
  for (std::size_t ray = 0; ray < bundle.size(); ++ray) values[ray] = target.value(ray);
}

}  // namespace plume
#endif  // HWY_ONCE
