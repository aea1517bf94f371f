/// How far one picture is from another.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "plume/lib/image.h"

namespace plume {

/// Over all channels of linear, premultiplied RGBA.
struct PictureError {
  double largest = 0;
  double rms = 0;
  /// Pixels with a channel that is not a number, left out of the rest.
  std::size_t not_numbers = 0;
};

/// Requires pictures of the same size, and a reference all of numbers.
inline PictureError picture_error(const Image& picture, const Image& reference) {
  PictureError error;
  double squares = 0;
  std::size_t pixels = 0;
  for (std::size_t at = 0; at < reference.rgba.size(); at += 4) {
    double largest = 0, sum = 0;
    for (std::size_t c = at; c < at + 4; ++c) {
      const double off = static_cast<double>(picture.rgba[c]) - reference.rgba[c];
      largest = std::isnan(off) ? off : std::max(largest, std::abs(off));
      if (std::isnan(off)) break;
      sum += off * off;
    }
    if (std::isnan(largest)) {
      ++error.not_numbers;
      continue;
    }
    ++pixels;
    error.largest = std::max(error.largest, largest);
    squares += sum;
  }
  if (pixels > 0) error.rms = std::sqrt(squares / (4 * static_cast<double>(pixels)));
  return error;
}

}  // namespace plume
