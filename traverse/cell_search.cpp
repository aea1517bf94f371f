#include "plume/traverse/cell_search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/traverse/cell_search.cpp"
#include "hwy/foreach_target.h"
#include "plume/traverse/cell_search-inl.h"
#include "plume/traverse/isosurface_target.h"

HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

void SearchIsosurfaces(const WalkableTets& mesh, const CellHierarchy& hierarchy,
                       const RayBundle& bundle, IsosurfaceTarget& target) {
  CellSearch<IsosurfaceTarget>(mesh, hierarchy, bundle, target).Run();
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(SearchIsosurfaces);

void find_isosurfaces(const WalkableTets& mesh, const CellHierarchy& hierarchy,
                      std::span<const SoughtIsovalue> isovalues, double connected,
                      RayBundle& bundle, std::span<SearchedRay> found) {
  if (bundle.size() == 0) return;
  bundle.fill();
  IsosurfaceTarget target(mesh, hierarchy, isovalues, bundle, found);
  HWY_DYNAMIC_DISPATCH(SearchIsosurfaces)(mesh, hierarchy, bundle, target);
  // World length of what rounding may make of a place.
  target.finish({connected, IsosurfaceTarget::kRounding / mesh.frame.scale});
}

}  // namespace plume
#endif  // HWY_ONCE
