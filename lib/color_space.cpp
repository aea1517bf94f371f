#include "plume/lib/color_space.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "plume/lib/srgb.h"

namespace plume {
namespace {

using Color = std::array<double, 3>;
constexpr double pi = std::numbers::pi;

Color blend(const Color& a, const Color& b, double t) {
  Color out{};
  for (std::size_t c = 0; c < 3; ++c) out[c] = (1 - t) * a[c] + t * b[c];
  return out;
}

/// Hue, saturation, value, each 0 to 1 (A. R. Smith, "Color gamut transform pairs", 1978).
Color hsv_of(const Color& rgb) {
  const auto [low, high] = std::minmax({rgb[0], rgb[1], rgb[2]});
  const double range = high - low;
  if (range <= 0) return {0, 0, high};
  double sixths = 0;
  if (rgb[0] == high) {
    sixths = (rgb[1] - rgb[2]) / range;
  } else if (rgb[1] == high) {
    sixths = 2 + (rgb[2] - rgb[0]) / range;
  } else {
    sixths = 4 + (rgb[0] - rgb[1]) / range;
  }
  return {sixths < 0 ? sixths / 6 + 1 : sixths / 6, range / high, high};
}

Color rgb_of_hsv(const Color& hsv) {
  Color out{};
  for (std::size_t c = 0; c < 3; ++c) {
    // Each channel is at its height within a sixth of its own hue 0, 1/3, 2/3.
    const double away = std::fmod(hsv[0] + 1 - static_cast<double>(c) / 3, 1.0);
    const double pure = std::clamp(std::abs(6 * away - 3) - 1, 0.0, 1.0);
    out[c] = hsv[2] * (1 - hsv[1] * (1 - pure));
  }
  return out;
}

/// X, Y, Z of the white that VTK's CIELAB refers to (D65).
constexpr Color white{0.9505, 1.0, 1.089};

Color lab_of(const Color& rgb) {
  const Color l{srgb_to_linear(rgb[0]), srgb_to_linear(rgb[1]), srgb_to_linear(rgb[2])};
  // IEC 61966-2-1, to four digits.
  const Color xyz{0.4124 * l[0] + 0.3576 * l[1] + 0.1805 * l[2],
                  0.2126 * l[0] + 0.7152 * l[1] + 0.0722 * l[2],
                  0.0193 * l[0] + 0.1192 * l[1] + 0.9505 * l[2]};
  Color f{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double ratio = xyz[c] / white[c];
    f[c] = ratio > 0.008856 ? std::cbrt(ratio) : 7.787 * ratio + 16.0 / 116;
  }
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

Color rgb_of_lab(const Color& lab) {
  const double y = (lab[0] + 16) / 116;
  Color xyz{y + lab[1] / 500, y, y - lab[2] / 200};
  for (std::size_t c = 0; c < 3; ++c) {
    const double cube = xyz[c] * xyz[c] * xyz[c];
    xyz[c] = white[c] * (cube > 0.008856 ? cube : (xyz[c] - 16.0 / 116) / 7.787);
  }
  const Color linear{3.2406 * xyz[0] - 1.5372 * xyz[1] - 0.4986 * xyz[2],
                     -0.9689 * xyz[0] + 1.8758 * xyz[1] + 0.0415 * xyz[2],
                     0.0557 * xyz[0] - 0.2040 * xyz[1] + 1.0570 * xyz[2]};
  Color rgb{linear_to_srgb(linear[0]), linear_to_srgb(linear[1]), linear_to_srgb(linear[2])};
  // A colour too bright for the display keeps its hue, as in VTK.
  const double brightest = std::max({1.0, rgb[0], rgb[1], rgb[2]});
  for (double& c : rgb) c = std::max(0.0, c / brightest);
  return rgb;
}

/// Moreland's polar form of CIELAB: magnitude, saturation and hue (angles).
struct Msh {
  double m = 0, s = 0, h = 0;
};

Msh msh_of(const Color& rgb) {
  const Color lab = lab_of(rgb);
  Msh out;
  out.m = std::hypot(lab[0], lab[1], lab[2]);
  out.s = out.m > 0.001 ? std::acos(std::min(1.0, lab[0] / out.m)) : 0;
  out.h = out.s > 0.001 ? std::atan2(lab[2], lab[1]) : 0;
  return out;
}

Color rgb_of_msh(const Msh& msh) {
  const double chroma = msh.m * std::sin(msh.s);
  return rgb_of_lab({msh.m * std::cos(msh.s), chroma * std::cos(msh.h), chroma * std::sin(msh.h)});
}

double angle_between(double a, double b) {
  const double difference = std::fmod(std::abs(a - b), 2 * pi);
  return difference > pi ? 2 * pi - difference : difference;
}

/// A hue for an unsaturated colour, which has none, that makes the way from a saturated one even.
double hue_next_to(const Msh& saturated, double magnitude) {
  if (saturated.m >= magnitude - 0.1) return saturated.h;
  const double spin = saturated.s * std::sqrt(magnitude * magnitude - saturated.m * saturated.m) /
                      (saturated.m * std::sin(saturated.s));
  // Away from purple.
  return saturated.h > -0.3 * pi ? saturated.h + spin : saturated.h - spin;
}

Color interpolate_diverging(const Color& from, const Color& to, double t) {
  Msh a = msh_of(from), b = msh_of(to);
  const bool both_saturated = a.s > 0.05 && b.s > 0.05;
  if (both_saturated && angle_between(a.h, b.h) > 0.33 * pi) {
    const Msh middle{std::max({a.m, b.m, 88.0}), 0, 0};
    (t < 0.5 ? b : a) = middle;
    t = t < 0.5 ? 2 * t : 2 * t - 1;
  }
  if (a.s < 0.05 && b.s > 0.05) {
    a.h = hue_next_to(b, a.m);
  } else if (b.s < 0.05 && a.s > 0.05) {
    b.h = hue_next_to(a, b.m);
  }
  return rgb_of_msh({(1 - t) * a.m + t * b.m, (1 - t) * a.s + t * b.s, (1 - t) * a.h + t * b.h});
}

}  // namespace

std::array<double, 3> interpolate(ColorMap::Space space, const std::array<double, 3>& a,
                                  const std::array<double, 3>& b, double t) {
  Color out{};
  switch (space) {
    case ColorMap::Space::rgb:
      out = blend(a, b, t);
      break;
    case ColorMap::Space::hsv:
      out = rgb_of_hsv(blend(hsv_of(a), hsv_of(b), t));
      break;
    case ColorMap::Space::lab:
      out = rgb_of_lab(blend(lab_of(a), lab_of(b), t));
      break;
    case ColorMap::Space::diverging:
      out = interpolate_diverging(a, b, t);
      break;
    case ColorMap::Space::step:
      out = b;
      break;
  }
  for (double& c : out) c = std::clamp(c, 0.0, 1.0);
  return out;
}

}  // namespace plume
