/// "Edges decide": the frame in which a ray is the z axis, and the bits that follow from it.
///
/// Axes are permuted so that the direction's largest component is z, and space is sheared so that
/// the ray runs along z through x = y = 0. Each vertex is transformed once, always by the same
/// operations in the same order, so that all cells around it see the same numbers. A vertex has one
/// bit, an edge one bit, a face the winding number that follows from its edges. Every edge of a
/// closed cell is walked twice, in opposite directions; so the windings of a cell's faces sum to
/// zero, whatever the rounding, and a ray that comes in goes out.
///
/// The bits also have a meaning in exact arithmetic: they are those of a ray moved by an
/// infinitesimal amount in +x and a smaller one in -y, which meets no vertex and no edge.
#pragma once

#include <array>
#include <cmath>

#include "plume/mesh/local_frame.h"
#include "plume/traverse/ray.h"

namespace plume {

/// A vertex in the sheared frame. z and scalar are as in the mesh. y is never -0: the difference of
/// two numbers is that only if the first one is, and no coordinate of a mesh is.
struct ShearedPoint {
  float x, y, z, scalar;
  bool up() const { return y >= 0; }
};

/// 1 if the edge crosses y = 0 on the positive side of x, for vertices with !low.up() and
/// high.up(). Comparing the products, rather than subtracting them, leaves no room for a fused
/// multiply-add that would be rounded differently elsewhere.
inline int right_of_ray(const ShearedPoint& low, const ShearedPoint& high) {
  return low.x * high.y > high.x * low.y ? 1 : 0;
}

/// What the directed edge a -> b adds to the winding number about the ray: -1, 0 or 1.
inline int crossing(const ShearedPoint& a, const ShearedPoint& b) {
  if (a.up() == b.up()) return 0;
  return b.up() ? right_of_ray(a, b) : -right_of_ray(b, a);
}

/// The same number without branches, for where a processor cannot guess which edges cross y = 0.
inline int crossing_unbranched(const ShearedPoint& a, const ShearedPoint& b) {
  const float forth = a.x * b.y, back = b.x * a.y;
  const unsigned a_up = a.up(), b_up = b.up();
  return static_cast<int>((b_up & ~a_up) & static_cast<unsigned>(forth > back)) -
         static_cast<int>((a_up & ~b_up) & static_cast<unsigned>(back > forth));
}

/// The axis along which a direction's component is largest, the first of several: the z of its
/// rays' frames.
inline int longest_axis(const std::array<double, 3>& direction) {
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(direction[static_cast<std::size_t>(axis)]) >
        std::abs(direction[static_cast<std::size_t>(longest)]))
      longest = axis;
  return longest;
}

class ShearedFrame {
 public:
  /// False where the direction is zero (or has no component above 1e-308) or not finite: such a ray
  /// meets nothing.
  bool set(const Ray& ray, const LocalFrame& local) {
    const auto& d = ray.direction;
    const int major = longest_axis(d);
    if (!(std::abs(d[index(major)]) > 0)) return false;
    set_axis(major, d[index(major)] > 0 ? 1 : -1);
    // Zero times what is not finite is no number.
    const auto& o = ray.origin;
    if (!(0 * d[0] + 0 * d[1] + 0 * d[2] + 0 * o[0] + 0 * o[1] + 0 * o[2] == 0)) return false;
    const double per_z = 1 / d[z_];
    if (!std::isfinite(per_z)) return false;
    line_.slope_x = static_cast<float>(d[x_] * per_z);
    line_.slope_y = static_cast<float>(d[y_] * per_z);

    // The ray's point nearest to the centre of the mesh stands for its origin, so that a camera
    // far away costs no precision.
    const double length2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    double along = 0;
    for (std::size_t a = 0; a < 3; ++a) along += (local.center[a] - ray.origin[a]) * d[a];
    along /= length2;
    std::array<double, 3> anchor;
    for (std::size_t a = 0; a < 3; ++a)
      anchor[a] = ((ray.origin[a] - local.center[a]) + along * d[a]) * local.scale;
    auto offset = [&](double place, float slope) {
      return static_cast<float>(place - static_cast<double>(slope) * anchor[z_]);
    };
    line_.offset_x = offset(anchor[x_], line_.slope_x);
    line_.offset_y = offset(anchor[y_], line_.slope_y);
    t_per_z_ = per_z / local.scale;  // a power of two
    t_offset_ = along - anchor[z_] * t_per_z_;
    return true;
  }

  ShearedPoint operator()(const WalkablePoint& p) const {
    const float z = p.position[z_];
    return {(p.position[x_] - line_.offset_x) - line_.slope_x * z,
            (p.position[y_] - line_.offset_y) - line_.slope_y * z, z, p.scalar};
  }

  /// Distance along the ray, in world units, of a place at this z.
  double t(double z) const { return z * t_per_z_ + t_offset_; }

  /// The ray's place at this z, in local coordinates: where the shear has x = y = 0.
  std::array<double, 3> local(double z) const {
    std::array<double, 3> p;
    p[x_] = line_.offset_x + static_cast<double>(line_.slope_x) * z;
    p[y_] = line_.offset_y + static_cast<double>(line_.slope_y) * z;
    p[z_] = z;
    return p;
  }

  /// 1 where z grows along the ray, -1 where it falls: a face of winding w about the ray, seen from
  /// outside, is left through where w * sign() > 0 and entered where w * sign() < 0.
  int sign() const { return sign_; }

  /// The axis that is z, 0 to 2.
  int axis() const { return static_cast<int>(z_); }
  /// World length per unit of z along the ray; negative where z falls.
  double t_per_z() const { return t_per_z_; }
  /// What the shear does to x and y: x - offset_x - slope_x * z.
  struct Line {
    float slope_x = 0, slope_y = 0, offset_x = 0, offset_y = 0;
  };
  const Line& line() const { return line_; }

  /// The ray's line for a ray tracer, in local coordinates: a point outside of the mesh, from
  /// which the direction (of length one along z) leads through all of it.
  static constexpr float kStart = 4;
  std::array<float, 3> start() const {
    const float z = -kStart * static_cast<float>(sign_);
    return place(line_.offset_x + line_.slope_x * z, line_.offset_y + line_.slope_y * z, z);
  }
  std::array<float, 3> step() const {
    const float s = static_cast<float>(sign_);
    return place(line_.slope_x * s, line_.slope_y * s, s);
  }
  /// That ray's parameter at this z.
  float parameter(double z) const { return parameter(z, sign_); }
  static float parameter(double z, int sign) { return static_cast<float>(z * sign) + kStart; }

 private:
  friend class FrameLanes;  // sets sixteen at once

  void set_axis(int major, int sign) {
    // A cyclic permutation keeps the handedness.
    x_ = index((major + 1) % 3);
    y_ = index((major + 2) % 3);
    z_ = index(major);
    sign_ = sign;
  }
  static std::size_t index(int axis) { return static_cast<std::size_t>(axis); }
  std::array<float, 3> place(float x, float y, float z) const {
    std::array<float, 3> p;
    p[x_] = x;
    p[y_] = y;
    p[z_] = z;
    return p;
  }

  std::size_t x_ = 0, y_ = 1, z_ = 2;
  int sign_ = 1;
  Line line_;
  double t_per_z_ = 1, t_offset_ = 0;
};

}  // namespace plume
