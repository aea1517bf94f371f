#include "plume/traverse/cell_search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/cell_search.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/cell_search-inl.h"
#include "plume/traverse/isosurface_target.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void SearchIsosurfaces(LeafCache& leaves, const RayBundle& bundle, IsosurfaceTarget& target) {
  CellSearch<IsosurfaceTarget>(leaves, bundle, target).Run();
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(SearchIsosurfaces);

void find_isosurfaces(LeafCache& leaves, std::span<const SoughtIsovalue> isovalues,
                      double connected, RayBundle& bundle, std::span<SearchedRay> found) {
  if (bundle.size() == 0) return;
  bundle.fill();
  IsosurfaceTarget target(leaves.mesh(), leaves.hierarchy(), isovalues, bundle, found);
  HWY_DYNAMIC_DISPATCH(SearchIsosurfaces)(leaves, bundle, target);
  // World length of what rounding may make of a place.
  target.finish({connected, IsosurfaceTarget::kRounding / leaves.mesh().frame.scale});
}

}  // namespace plume
#endif  // HWY_ONCE
