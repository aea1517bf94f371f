#include "plume/preint/closed_form.h"

#include <cstddef>

#include "plume/preint/psi.h"

namespace plume {

namespace {

/// Whatever lies behind a part of this transparency changes no float between 0 and 1.
constexpr double invisible = 1e-12;

}  // namespace

PreciseColor integrate_linear(const PreciseOptics& front, const PreciseOptics& back,
                              double length) {
  const double a = front.extinction * length;
  const double b = back.extinction * length;
  if (a + b == 0) return {};
  // One colour throughout needs no chi, and is then exact.
  if (front.color == back.color) {
    const double alpha = absorbed((a + b) / 2);
    return {{alpha * front.color[0], alpha * front.color[1], alpha * front.color[2]}, alpha};
  }
  const Absorption part = absorption(a, b);
  PreciseColor color{{}, part.absorbed};
  for (std::size_t channel = 0; channel < 3; ++channel)
    color.rgb[channel] = front.color[channel] * part.absorbed +
                         (back.color[channel] - front.color[channel]) * part.chi;
  return color;
}

PreciseColor integrate_linear(const Pieces& pieces, double s_in, double s_out, double length) {
  PreciseColor color;
  pieces.walk(s_in, s_out,
              [&](const PreciseOptics& front, const PreciseOptics& back, double fraction) {
                color.add_behind(integrate_linear(front, back, fraction * length));
                return color.alpha < 1 - invisible;
              });
  return color;
}

SegmentColor ClosedForm::integrate(float s_in, float s_out, float length) const {
  if (is_empty_segment(s_in, s_out, length)) return {};
  return integrate_linear(depth_.pieces(), s_in, s_out, length).rounded();
}

}  // namespace plume
