/// Clip planes: what of a ray is kept.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "plume/mesh/local_frame.h"
#include "plume/traverse/ray.h"

namespace plume {

/// Keeps the side that the normal points to. World coordinates.
struct ClipPlane {
  std::array<double, 3> point{0, 0, 0};   ///< any of the plane
  std::array<double, 3> normal{0, 0, 1};  ///< of any length but zero

  /// The same in every number.
  bool operator==(const ClipPlane&) const = default;
};

/// The planes between which lies a box: only what is inside is kept.
std::vector<ClipPlane> planes_of_box(const Bounds& box);

/// What is wrong, in one line that names the values; nothing where all is well.
std::optional<std::string> problem_of(const ClipPlane& plane);

/// Shortens a ray to what all planes keep. That is one piece, as half-spaces are convex: t_min and
/// t_max say all, and whoever follows the ray cuts its segments there, exactly where the scalar is
/// linear. A ray that is cut begins inside of the intervals that lie there, and shows them whole
/// (see IntervalState), so that a cut face looks even. In a plane itself a ray is kept. False where
/// nothing is left. Requires planes without problem.
bool clip(Ray& ray, const std::vector<ClipPlane>& planes);

}  // namespace plume
