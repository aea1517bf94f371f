/// Sixteen rays against one boundary face, before each is looked at by itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "plume/traverse/sheared_frame.h"

namespace plume {

/// What shears space for each of sixteen rays, laid out for compilers to use vectors.
class LinePacket {
 public:
  static constexpr std::size_t kRays = 16;

  /// Rays that are not set meet nothing.
  void set(std::size_t ray, const ShearedFrame& frame) {
    const ShearedFrame::Line line = frame.line();
    slope_x_[ray] = line.slope_x;
    slope_y_[ray] = line.slope_y;
    offset_x_[ray] = line.offset_x;
    offset_y_[ray] = line.offset_y;
    if (rays_ == 0) axis_ = frame.axis();
    one_axis_ = one_axis_ && frame.axis() == axis_;
    ++rays_;
  }

  /// A bit for each ray that may cross the loop of these corners: that has corners above and below
  /// y = 0, and if it is a triangle, that it winds about. Takes the same bits from the same numbers
  /// as the walkers do. All bits where the rays' longest axes differ.
  unsigned may_cross(std::span<const WalkablePoint* const> corners) const {
    if (!one_axis_) return 0xFFFFu;
    return corners.size() == 3 ? wound_by_triangle(corners) : straddled(corners);
  }

 private:
  struct Corner {
    alignas(64) std::array<float, kRays> x, y;
  };

  void shear(const WalkablePoint& p, Corner& corner) const {
    const auto axis = static_cast<std::size_t>(axis_);
    const float px = p.position[(axis + 1) % 3], py = p.position[(axis + 2) % 3];
    const float pz = p.position[axis];
    for (std::size_t i = 0; i < kRays; ++i) {
      corner.x[i] = (px - offset_x_[i]) - slope_x_[i] * pz;
      corner.y[i] = (py - offset_y_[i]) - slope_y_[i] * pz;
    }
  }

  static unsigned bits_of(const std::array<std::uint32_t, kRays>& flags) {
    unsigned bits = 0;
    for (std::size_t i = 0; i < kRays; ++i) bits |= (flags[i] & 1u) << i;
    return bits;
  }

  // A triangle winds about a ray if an odd number of its edges crosses on the ray's right.
  unsigned wound_by_triangle(std::span<const WalkablePoint* const> corners) const {
    std::array<Corner, 3> c;
    for (std::size_t k = 0; k < 3; ++k) shear(*corners[k], c[k]);
    alignas(64) std::array<std::uint32_t, kRays> odd{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner &a = c[k], &b = c[(k + 1) % 3];
      for (std::size_t i = 0; i < kRays; ++i) {
        const std::uint32_t a_up = a.y[i] >= 0, b_up = b.y[i] >= 0;
        const float forth = a.x[i] * b.y[i], back = b.x[i] * a.y[i];
        const std::uint32_t rising = forth > back, falling = back > forth;
        odd[i] ^= ((b_up & ~a_up) & rising) | ((a_up & ~b_up) & falling);
      }
    }
    return bits_of(odd);
  }

  unsigned straddled(std::span<const WalkablePoint* const> corners) const {
    alignas(64) std::array<std::uint32_t, kRays> above{}, below{};
    Corner c;
    for (const WalkablePoint* const corner : corners) {
      shear(*corner, c);
      for (std::size_t i = 0; i < kRays; ++i) {
        const std::uint32_t up = c.y[i] >= 0;
        above[i] |= up;
        below[i] |= 1u ^ up;
      }
    }
    for (std::size_t i = 0; i < kRays; ++i) above[i] &= below[i];
    return bits_of(above);
  }

  alignas(64) std::array<float, kRays> slope_x_{}, slope_y_{}, offset_x_{}, offset_y_{};
  std::size_t rays_ = 0;
  int axis_ = 0;
  bool one_axis_ = true;
};

}  // namespace plume
