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

/// What a loop's corners, taken one after the other, say of its crossings: enough for most.
class LoopSides {
 public:
  void add_edge(const ShearedPoint& from, const ShearedPoint& to) {
    winding_ += crossing(from, to);
    up_ += to.up() ? 1 : 0;
    right_ += to.x > 0 ? 1 : 0;
    ++size_;
  }

  int winding() const { return winding_; }
  /// The ray passes beside the corners' convex hull: no surface within is crossed. (Not so where
  /// the edges say otherwise, as products that underflow may.)
  bool beside() const {
    return winding_ == 0 && (up_ == 0 || up_ == size_ || right_ == 0 || right_ == size_);
  }

 private:
  int winding_ = 0;
  std::size_t up_ = 0, right_ = 0, size_ = 0;
};

/// Calls visit(const LoopCrossing&) for each crossing of a loop of `size` >= 3 corners: a triangle
/// is plane, a quadrilateral a bilinear patch, a polygon a fan of triangles around its centre, each
/// of which is crossed where it winds about the ray; what its spokes add cancels. `corners()` gives
/// the loop's std::span of ShearedPoint, and is called where `sides` do not suffice.
template <class Corners, class Visit>
void for_each_crossing(const LoopSides& sides, std::size_t size, const Corners& corners,
                       const Visit& visit) {
  const int w = sides.winding();
  if (sides.beside()) return;
  if (size <= 4) {
    QuadCrossings crossings = planar_crossings(w);
    if (w == 0 && size == 4) {
      const std::span<const ShearedPoint> p = corners();
      crossings = patch_crossings({p[0], p[1], p[2], p[3]}, w);
    }
    for (std::uint32_t rank = 0; rank < 2; ++rank)
      if (crossings.direction[rank] != 0)
        visit(LoopCrossing{crossings.direction[rank], rank, crossings.grazed()});
    return;
  }
  const std::span<const ShearedPoint> p = corners();
  const ShearedPoint center = fan_center(p);
  const ShearedPoint* from = &p.back();
  int from_spoke = crossing(center, *from);
  for (std::size_t i = 0; i < size; ++i) {
    const int to_spoke = crossing(center, p[i]);
    const int of_triangle = from_spoke + crossing(*from, p[i]) - to_spoke;
    if (of_triangle != 0) visit(LoopCrossing{of_triangle, static_cast<std::uint32_t>(i), false});
    from_spoke = to_spoke;
    from = &p[i];
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
