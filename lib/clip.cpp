#include "plume/lib/clip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plume {

std::vector<ClipPlane> planes_of_box(const Bounds& box) {
  std::vector<ClipPlane> planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, 3> normal{0, 0, 0};
    normal[axis] = 1;
    planes.push_back({box.low, normal});
    normal[axis] = -1;
    planes.push_back({box.high, normal});
  }
  return planes;
}

std::optional<std::string> problem_of(const ClipPlane& plane) {
  const auto& [p, n] = plane;
  const bool finite = std::isfinite(p[0] + p[1] + p[2]) && std::isfinite(n[0] + n[1] + n[2]);
  if (finite && (n[0] != 0 || n[1] != 0 || n[2] != 0)) return std::nullopt;
  return fmt::format(
      "a clip plane through {:g},{:g},{:g} with the normal {:g},{:g},{:g}; give it finite numbers "
      "and a normal of any length > 0",
      p[0], p[1], p[2], n[0], n[1], n[2]);
}

bool clip(Ray& ray, const std::vector<ClipPlane>& planes) {
  for (const auto& [point, normal] : planes) {
    double height = 0, slope = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      height += normal[a] * (ray.origin[a] - point[a]);
      slope += normal[a] * ray.direction[a];
    }
    // Kept where height + t slope >= 0.
    if (slope > 0)
      ray.t_min = std::max(ray.t_min, -height / slope);
    else if (slope < 0)
      ray.t_max = std::min(ray.t_max, -height / slope);
    else if (height < 0)
      return false;
  }
  return ray.t_min <= ray.t_max;
}

}  // namespace plume
