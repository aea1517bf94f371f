/// Sixteen rays side by side, and their frames.
#pragma once

#include <array>
#include <cstddef>

#include "plume/mesh/local_frame.h"
#include "plume/traverse/ray.h"
#include "plume/traverse/sheared_frame.h"

namespace plume {

/// Up to sixteen rays that see from their origin to infinity, laid out for vectors.
struct RayLanes {
  static constexpr std::size_t kRays = 16;

  alignas(64) double origin[3][kRays] = {};
  alignas(64) double direction[3][kRays] = {};
  std::size_t size = 0;

  void add(const Ray& ray) {
    for (std::size_t a = 0; a < 3; ++a) {
      origin[a][size] = ray.origin[a];
      direction[a][size] = ray.direction[a];
    }
    ++size;
  }
  Ray ray(std::size_t i) const {
    return {{origin[0][i], origin[1][i], origin[2][i]},
            {direction[0][i], direction[1][i], direction[2][i]}};
  }
};

/// What ShearedFrame::set() makes of each of them, to the bit.
class FrameLanes {
 public:
  static constexpr std::size_t kRays = RayLanes::kRays;

  void set(const RayLanes& rays, const LocalFrame& local);

  std::size_t size() const { return size_; }
  /// False for what is no ray, as ShearedFrame::set() says.
  bool is_valid(std::size_t ray) const { return (valid_ >> ray & 1) != 0; }
  /// Sets `frame` where it is: a copy of what was just written would wait for it. Requires
  /// is_valid().
  void put(std::size_t ray, ShearedFrame& frame) const;
  int sign(std::size_t ray) const { return arrays_.sign[ray] > 0 ? 1 : -1; }
  int axis(std::size_t ray) const {
    return (axis_is_2_ >> ray & 1) != 0 ? 2 : (axis_is_1_ >> ray & 1) != 0 ? 1 : 0;
  }

  /// ShearedFrame::start() and step() of all rays, by coordinate.
  void lines(std::array<float*, 3> start, std::array<float*, 3> step) const;

  /// Whether the rays' longest axes are the same.
  bool has_one_axis() const { return one_axis_; }

  /// As arrays, for the code that is compiled for each instruction set.
  struct Arrays {
    alignas(64) float slope_x[kRays], slope_y[kRays], offset_x[kRays], offset_y[kRays];
    alignas(64) float sign[kRays];
    alignas(64) double t_per_z[kRays], t_offset[kRays];
  };
  const Arrays& arrays() const { return arrays_; }
  struct Bits {
    unsigned valid = 0, axis_is_1 = 0, axis_is_2 = 0;
  };

 private:
  Arrays arrays_;  // those of the first size_ are set
  std::size_t size_ = 0;
  unsigned valid_ = 0, axis_is_1_ = 0, axis_is_2_ = 0;
  bool one_axis_ = true;
};

}  // namespace plume
