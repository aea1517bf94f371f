/// How far the rays of a picture see, and what they see there.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "plume/lib/render.h"

namespace plume {

class Frame;

/// Of each pixel: where its ray ends at something opaque, and the colour there.
struct OpaquePixels {
  /// Distance along the ray, infinite where nothing is; empty where there is nothing opaque at all.
  std::vector<double> limits;
  /// Linear RGB of the scene's surfaces where one is the nearest, else negative; empty without
  /// surfaces.
  std::vector<std::array<float, 3>> colors;

  bool any() const { return !limits.empty(); }
  bool has_color(std::size_t pixel) const { return !colors.empty() && colors[pixel][0] >= 0; }
};

/// Looks along all rays of a frame, in parallel: the scene's surfaces, lit as the settings say or
/// by a headlight, and RenderSettings::depth_limit.
OpaquePixels find_opaque_pixels(const Frame& frame);

}  // namespace plume
