/// What render() returns.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace plume {

/// A further channel of an image, one float per pixel.
struct Channel {
  std::string name;           ///< see Image::channels
  std::vector<float> values;  ///< the first row is the top
};

/// Linear RGBA, premultiplied by alpha, 32-bit float; the first row is the top of the picture.
struct Image {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  /// 4 * width * height values, interleaved.
  std::vector<float> rgba;
  /// What was asked for besides: "depth" (distance along the ray to the first contribution,
  /// +infinity where there is none), "optical_depth", "cell_id" (the first cell that contributes,
  /// -1 where there is none), "cell_count", "isovalue", "normal.x", ... each of width * height
  /// values; see RenderSettings::channels.
  std::vector<Channel> channels;

  /// The four numbers of a pixel; (0, 0) is at the top left. Requires 0 <= x < width, likewise y.
  const float* pixel(int x, int y) const {
    return &rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x))];
  }
  /// The channel of that name, or null.
  const Channel* channel(const std::string& name) const;
};

}  // namespace plume
