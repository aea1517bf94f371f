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
    sign_[ray] = frame.sign();
    if (rays_ == 0) axis_ = frame.axis();
    one_axis_ = one_axis_ && frame.axis() == axis_;
    ++rays_;
  }

  /// A bit for each ray that may come in through the loop of these corners, seen from outside: not
  /// those that pass beside the hull of the corners, nor, for triangles and quadrilaterals, those
  /// about which it winds as at a way out. Takes the same bits from the same numbers as the walkers
  /// do. All bits where the rays' longest axes differ.
  unsigned may_enter(std::span<const WalkablePoint* const> corners) const {
    if (!one_axis_) return 0xFFFFu;
    const std::size_t n = corners.size();
    Loop loop;
    Corner first, last, next;
    shear(*corners[0], first);
    last = first;
    if (n > 3) add_corner(first, loop);
    for (std::size_t c = 1; c < n; ++c) {
      shear(*corners[c], next);
      if (n > 3) add_corner(next, loop);
      add_edge(last, next, loop);
      last = next;
    }
    add_edge(last, first, loop);
    alignas(64) std::array<std::uint32_t, kRays> enters;
    for (std::size_t i = 0; i < kRays; ++i) {
      const int way = loop.winding[i] * sign_[i];
      const std::uint32_t in = (way < 0), none = (way == 0), several = (n > 4);
      const std::uint32_t beside =
          (1u ^ (loop.above[i] & loop.below[i])) |
          ((1u ^ (loop.not_right[i] & loop.not_left[i])) & (1u ^ loop.tiny[i]));
      // A triangle without a winding is not crossed.
      const std::uint32_t folded = (n > 3 ? none : 0u) | several;
      enters[i] = in | (folded & (1u ^ beside));
    }
    unsigned bits = 0;
    for (std::size_t i = 0; i < kRays; ++i) bits |= (enters[i] & 1u) << i;
    return bits;
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

  // What its corners and edges, one after the other, say of a loop.
  struct Loop {
    alignas(64) std::array<std::uint32_t, kRays> above{}, below{}, not_right{}, not_left{}, tiny{};
    alignas(64) std::array<int, kRays> winding{};
  };

  // Corners all to the right or all to the left are passed by, unless products of what is so small
  // that it underflows say otherwise.
  static void add_corner(const Corner& c, Loop& loop) {
    constexpr float kBeside = 1e-12f, kTiny = 1e-25f;
    for (std::size_t i = 0; i < kRays; ++i) {
      const std::uint32_t up = c.y[i] >= 0, right = c.x[i] > kBeside, left = c.x[i] < -kBeside;
      const std::uint32_t high = c.y[i] > kTiny, low = c.y[i] < -kTiny;
      loop.above[i] |= up;
      loop.below[i] |= 1u ^ up;
      loop.not_right[i] |= 1u ^ right;
      loop.not_left[i] |= 1u ^ left;
      loop.tiny[i] |= 1u ^ (high | low);
    }
  }

  // crossing() of sheared_frame.h.
  static void add_edge(const Corner& a, const Corner& b, Loop& loop) {
    for (std::size_t i = 0; i < kRays; ++i) {
      const int a_up = a.y[i] >= 0, b_up = b.y[i] >= 0;
      const float forth = a.x[i] * b.y[i], back = b.x[i] * a.y[i];
      const int rising = forth > back, falling = back > forth;
      loop.winding[i] += (b_up & (1 ^ a_up) & rising) - (a_up & (1 ^ b_up) & falling);
    }
  }

  alignas(64) std::array<float, kRays> slope_x_{}, slope_y_{}, offset_x_{}, offset_y_{};
  alignas(64) std::array<int, kRays> sign_{};
  std::size_t rays_ = 0;
  int axis_ = 0;
  bool one_axis_ = true;
};

}  // namespace plume
