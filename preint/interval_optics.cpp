#include "plume/preint/interval_optics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plume {

SegmentColor IntervalOptics::integrate(float w_from, float w_to) const {
  if (form_ == IntervalForm::linear) return integrate_linear(w_from, w_to);
  return profile_.integrate(w_from, w_to, std::abs(w_to - w_from));
}

float IntervalOptics::optical_depth(float w_from, float w_to) const {
  return depth_(w_from, w_to, std::abs(w_to - w_from));
}

SegmentColor IntervalOptics::integrate_linear(float w_from, float w_to) const {
  const double width = std::abs(static_cast<double>(w_to) - w_from);
  if (!(width > 0)) return {};
  const float w_begin = w_to > w_from ? 0.0f : 1.0f;
  const double before =
      depth_.mean_extinction(w_begin, w_from) * std::abs(static_cast<double>(w_from) - w_begin);
  const double left = 1 - before;
  if (!(left > 0)) return {};
  double opacity = 0;
  std::array<double, 3> radiance{0, 0, 0};
  depth_.pieces().walk(
      w_from, w_to, [&](const PreciseOptics& front, const PreciseOptics& back, double fraction) {
        const double part = fraction * width;
        // Where opacity reaches what is left, the rest of the part is not seen: a root of
        // front u + slope u^2 / 2 = room, over u in [0, part].
        const double room = left - opacity;
        const double slope = part > 0 ? (back.extinction - front.extinction) / part : 0;
        const bool full = 0.5 * (front.extinction + back.extinction) * part >= room;
        const double seen =
            !full
                ? part
                : std::min(part, 2 * room /
                                     (front.extinction +
                                      std::sqrt(std::max(0.0, front.extinction * front.extinction +
                                                                  2 * slope * room))));
        const double end = seen < part ? front.extinction + slope * seen : back.extinction;
        for (std::size_t c = 0; c < 3; ++c) {
          const double end_color =
              seen < part ? front.color[c] + (back.color[c] - front.color[c]) * (seen / part)
                          : back.color[c];
          // The product of two linear functions, by Simpson's rule, exact.
          const double middle = 0.25 * (front.extinction + end) * (front.color[c] + end_color);
          radiance[c] +=
              seen / 6 * (front.extinction * front.color[c] + 4 * middle + end * end_color);
        }
        opacity += full ? room : 0.5 * (front.extinction + back.extinction) * part;
        return !full;
      });
  return {saturated_float(radiance[0] / left), saturated_float(radiance[1] / left),
          saturated_float(radiance[2] / left), static_cast<float>(std::min(1.0, opacity / left))};
}

}  // namespace plume
