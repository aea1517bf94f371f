#include "plume/preint/closed_form.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "plume/preint/psi.h"

namespace plume {

namespace {

/// Whatever lies behind a part of this transparency changes no float between 0 and 1.
constexpr double invisible = 1e-12;

}  // namespace

SegmentColor ClosedForm::integrate(float s_in, float s_out, float length) const {
  if (is_empty_segment(s_in, s_out, length)) return {};
  std::array<double, 3> radiance{0, 0, 0};
  double opacity = 0;
  double transparency = 1;
  depth_.pieces().walk(
      s_in, s_out, [&](const PreciseOptics& front, const PreciseOptics& back, double fraction) {
        const double part_length = fraction * length;
        const double a = front.extinction * part_length;
        const double b = back.extinction * part_length;
        if (a + b == 0) return true;
        const double absorbed = -std::expm1(-(a + b) / 2);
        radiance[0] += transparency * front.color[0] * absorbed;
        radiance[1] += transparency * front.color[1] * absorbed;
        radiance[2] += transparency * front.color[2] * absorbed;
        // One colour throughout needs no more, and is then exact.
        if (front.color != back.color) {
          const double weight = transparency * chi(a, b);
          for (std::size_t channel = 0; channel < 3; ++channel) {
            radiance[channel] += weight * (back.color[channel] - front.color[channel]);
          }
        }
        opacity += transparency * absorbed;
        transparency *= 1 - absorbed;
        return transparency > invisible;
      });
  return {saturated_float(radiance[0]), saturated_float(radiance[1]), saturated_float(radiance[2]),
          saturated_float(opacity)};
}

}  // namespace plume
