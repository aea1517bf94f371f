/// The transfer curve of sRGB (IEC 61966-2-1), between display values and linear light.
#pragma once

#include <cmath>

namespace plume {

/// Linear light of a display value, both 0 to 1.
inline double srgb_to_linear(double display) {
  return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

/// Display value of linear light, both 0 to 1.
inline double linear_to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace plume
