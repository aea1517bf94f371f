/// What whole frames are pictures of: cameras and a transfer function.
#pragma once

#include <string>
#include <vector>

#include "plume/lib/plume.h"

namespace plume::bench {

/// Seven knots from the 1st to the 99th percentile of the scene's values, as one draws them by
/// hand: VTK looks knots up one by one, so that more of them would slow it down and hardly slow us.
TransferFunction seven_knots(const Scene& scene);

struct NamedCamera {
  std::string name;
  Camera camera;
};

/// The benchmarks' four views (bench_views.h), and one without perspective (VtkFrames says why).
std::vector<NamedCamera> frame_cameras(const Bounds& bounds);

}  // namespace plume::bench
