/// Neighbouring rays that look for cells together.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "plume/traverse/ray.h"
#include "plume/traverse/sheared_frame.h"

namespace plume {

/// Up to 64 rays of one longest axis that run the same way along it, laid out for vectors. Rays and
/// frames must stay where they are.
///
/// In the frame of that axis a ray's x and y are linear in z, so all the bundle lies between the
/// lines through the least and the greatest of them at z = -1 and z = 1: the mesh's extent.
class RayBundle {
 public:
  static constexpr std::size_t kRays = 64;

  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  bool full() const { return size_ == kRays; }
  /// Whether a ray of that frame may be added.
  bool takes(const ShearedFrame& frame) const {
    return size_ == 0 || (!full() && frame.axis() == axis_ && frame.sign() == sign_);
  }
  /// Requires takes(frame), and a frame that is set.
  void add(const Ray& ray, const ShearedFrame& frame) {
    if (size_ == 0) {
      axis_ = frame.axis();
      sign_ = frame.sign();
    }
    const ShearedFrame::Line line = frame.line();
    slope_x_[size_] = line.slope_x;
    slope_y_[size_] = line.slope_y;
    offset_x_[size_] = line.offset_x;
    offset_y_[size_] = line.offset_y;
    rays_[size_] = &ray;
    frames_[size_] = &frame;
    ++size_;
  }

  int axis() const { return axis_; }
  int sign() const { return sign_; }
  const Ray& ray(std::size_t index) const { return *rays_[index]; }
  const ShearedFrame& frame(std::size_t index) const { return *frames_[index]; }

  /// For vectors: what shears space, ray by ray; beyond size() the last ray again after fill().
  const float* slopes_x() const { return slope_x_.data(); }
  const float* slopes_y() const { return slope_y_.data(); }
  const float* offsets_x() const { return offset_x_.data(); }
  const float* offsets_y() const { return offset_y_.data(); }
  void fill() {
    for (std::array<float, kRays>* values : {&slope_x_, &slope_y_, &offset_x_, &offset_y_})
      std::fill(values->begin() + static_cast<std::ptrdiff_t>(size_), values->end(),
                (*values)[size_ - 1]);
  }

  /// offset + slope * z.
  struct Line {
    float offset, slope;
  };
  /// No ray is beyond these between z = -1 and z = 1, but for rounding.
  struct Hull {
    Line least_x, greatest_x, least_y, greatest_y;
  };
  Hull hull() const { return hull(0, size_); }
  /// Of some of the rays; there must be one.
  Hull hull(std::size_t begin, std::size_t end) const {
    return {bound(offset_x_, slope_x_, false, begin, end),
            bound(offset_x_, slope_x_, true, begin, end),
            bound(offset_y_, slope_y_, false, begin, end),
            bound(offset_y_, slope_y_, true, begin, end)};
  }

 private:
  // The least of linear functions is concave, so it is nowhere below its own chord.
  Line bound(const std::array<float, kRays>& offsets, const std::array<float, kRays>& slopes,
             bool greatest, std::size_t begin, std::size_t end) const {
    float behind = offsets[begin] - slopes[begin], ahead = offsets[begin] + slopes[begin];
    for (std::size_t i = begin + 1; i < end; ++i) {
      const float b = offsets[i] - slopes[i], a = offsets[i] + slopes[i];
      behind = greatest ? std::max(behind, b) : std::min(behind, b);
      ahead = greatest ? std::max(ahead, a) : std::min(ahead, a);
    }
    return {0.5f * (behind + ahead), 0.5f * (ahead - behind)};
  }

  std::size_t size_ = 0;
  int axis_ = 0, sign_ = 1;
  alignas(64) std::array<float, kRays> slope_x_, slope_y_, offset_x_, offset_y_;
  std::array<const Ray*, kRays> rays_;
  std::array<const ShearedFrame*, kRays> frames_;
};

}  // namespace plume
