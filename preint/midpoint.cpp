#include "plume/preint/midpoint.h"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace plume {

namespace {

/// The scalar in the middle of part i of n.
double middle(float s_in, float s_out, int i, int n) {
  const double along = (i + 0.5) / n;
  return s_in * (1 - along) + s_out * along;
}

}  // namespace

MidpointIntegrator::MidpointIntegrator(const TransferFunction& transfer_function, int samples)
    : pieces_(transfer_function), samples_(samples) {
  assert(samples >= 1);
}

SegmentColor MidpointIntegrator::integrate(float s_in, float s_out, float length) const {
  if (is_empty_segment(s_in, s_out, length)) return {};
  const double part_length = static_cast<double>(length) / samples_;
  std::array<double, 3> radiance{0, 0, 0};
  double opacity = 0;
  double transparency = 1;
  for (int i = 0; i < samples_; ++i) {
    const PreciseOptics optics = pieces_.at(middle(s_in, s_out, i, samples_));
    const double absorbed = -std::expm1(-optics.extinction * part_length);
    const double weight = transparency * absorbed;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      radiance[channel] += weight * optics.color[channel];
    }
    opacity += weight;
    transparency *= 1 - absorbed;
  }
  return {saturated_float(radiance[0]), saturated_float(radiance[1]), saturated_float(radiance[2]),
          saturated_float(opacity)};
}

float MidpointIntegrator::optical_depth(float s_in, float s_out, float length) const {
  if (is_empty_segment(s_in, s_out, length)) return 0;
  double extinction = 0;
  for (int i = 0; i < samples_; ++i) {
    extinction += pieces_.at(middle(s_in, s_out, i, samples_)).extinction;
  }
  return saturated_float(extinction * length / samples_);
}

}  // namespace plume
