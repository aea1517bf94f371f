/// What plume_scaling's frames have in common.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "plume/lib/plume.h"

namespace plume::bench {

/// A frame: scene, camera and settings. Refers to the scene.
struct ScalingFrame {
  const Scene* scene;
  Camera camera;
  RenderSettings settings;
};

/// Volume, whole rays, one thread; view iso, turned a little.
ScalingFrame iso_frame(const Scene& scene, int size);

/// What one frame took: seconds on the processor, and what its rays met.
struct FrameCost {
  double seconds = 0;
  double cells_per_ray = 0;  ///< of the rays that meet the mesh, as the next
  double entries_per_ray = 0;
  double rays_hit = 0;
  double ns_per_cell() const { return 1e9 * seconds / (cells_per_ray * rays_hit); }
};

/// Renders all frames in turns; medians.
std::vector<FrameCost> frame_costs(const std::vector<ScalingFrame>& frames, int rounds);

/// The unit cube in about so many cells: "tetrahedra", "hexahedra" (a curvilinear grid), "mixed
/// cells" (explicit) or "rectilinear grid".
Mesh unit_cube(const std::string& kind, double cells);

}  // namespace plume::bench
