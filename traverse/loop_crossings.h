/// Which crossings a ray has with a face of any number of corners, and where. As for quadrilaterals
/// (quad_crossings.h) a function of the loop and the ray alone, whose directions sum to the loop's
/// winding number: both cells at a face agree, and the crossings of a closed cell balance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "plume/traverse/measure_quad.h"

namespace plume {

/// One crossing, decided but not measured.
struct LoopCrossing {
  int direction = 0;       ///< 1 where the loop winds about the ray positively, -1 negatively
  std::uint32_t rank = 0;  ///< tells the crossings of a face apart
  bool grazed = false;     ///< of a twisted quadrilateral (measure_patch())
};

/// The centre of a polygon's fan: the mean of its corners and of their scalars.
inline ShearedPoint fan_center(std::span<const ShearedPoint> loop) {
  ShearedPoint center{0, 0, 0, 0};
  for (const ShearedPoint& p : loop) {
    center.x += p.x;
    center.y += p.y;
    center.z += p.z;
    center.scalar += p.scalar;
  }
  const float count = static_cast<float>(loop.size());
  return {center.x / count, center.y / count, center.z / count, center.scalar / count};
}

/// Calls visit(const LoopCrossing&) for each crossing of a loop of three corners or more: a
/// triangle is plane, a quadrilateral a bilinear patch, a polygon a fan of triangles around its
/// centre, each of which is crossed where it winds about the ray; what its spokes add cancels.
template <class Visit>
void for_each_crossing(std::span<const ShearedPoint> loop, const Visit& visit) {
  const bool up = loop[0].up();
  std::size_t alike = 1;
  while (alike < loop.size() && loop[alike].up() == up) ++alike;
  if (alike == loop.size()) return;  // no edge and no spoke crosses y = 0, or only by rounding
  if (loop.size() == 3) {
    const int w =
        crossing(loop[0], loop[1]) + crossing(loop[1], loop[2]) + crossing(loop[2], loop[0]);
    if (w != 0) visit(LoopCrossing{w, 0, false});
    return;
  }
  if (loop.size() == 4) {
    const Quad quad{loop[0], loop[1], loop[2], loop[3]};
    const QuadCrossings crossings = patch_crossings(quad, winding(quad));
    for (std::uint32_t rank = 0; rank < 2; ++rank)
      if (crossings.direction[rank] != 0)
        visit(LoopCrossing{crossings.direction[rank], rank, crossings.grazed()});
    return;
  }
  const ShearedPoint center = fan_center(loop);
  int from_spoke = crossing(center, loop.back());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const int to_spoke = crossing(center, loop[i]);
    const int w = from_spoke + crossing(loop[i == 0 ? loop.size() - 1 : i - 1], loop[i]) - to_spoke;
    if (w != 0) visit(LoopCrossing{w, static_cast<std::uint32_t>(i), false});
    from_spoke = to_spoke;
  }
}

/// Where one of them is. A polygon's error is that of its triangles, and some 1e-7 of its size for
/// the rounding of its centre.
inline Crossing measure(std::span<const ShearedPoint> loop, const LoopCrossing& crossing) {
  if (loop.size() == 3) return measure_triangle(loop[0], loop[1], loop[2]);
  if (loop.size() == 4)
    return measure_patch({loop[0], loop[1], loop[2], loop[3]}, crossing.direction, crossing.grazed);
  const std::size_t to = crossing.rank;
  return measure_triangle(fan_center(loop), loop[to == 0 ? loop.size() - 1 : to - 1], loop[to]);
}

}  // namespace plume
