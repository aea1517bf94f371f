#include "plume/preint/pieces.h"

#include <algorithm>

namespace plume {

namespace {

/// Beyond every float, and near enough that a double still holds 1 / (end - float).
constexpr double far_away = 0x1p200;

PreciseOptics in_double(const Optics& optics) {
  return {optics.extinction, {optics.color[0], optics.color[1], optics.color[2]}};
}

}  // namespace

Pieces::Pieces(const TransferFunction& transfer_function) {
  assert(!transfer_function.problem());
  const auto& knots = transfer_function.knots;
  scalars_.reserve(knots.size() + 2);
  optics_.reserve(knots.size() + 2);
  const auto add = [this](double scalar, const Optics& optics) {
    scalars_.push_back(scalar);
    optics_.push_back(in_double(optics));
  };
  add(-far_away, knots.front().optics);
  for (const auto& knot : knots) add(knot.scalar, knot.optics);
  add(far_away, knots.back().optics);
  for (std::size_t i = 0; i + 1 < scalars_.size(); ++i) {
    const double width = scalars_[i + 1] - scalars_[i];
    inverse_widths_.push_back(width > 0 ? 1 / width : 0);
  }
}

std::size_t Pieces::piece_above(double scalar) const {
  const auto above = std::upper_bound(scalars_.begin(), scalars_.end(), scalar);
  return static_cast<std::size_t>(above - scalars_.begin()) - 1;
}

std::size_t Pieces::piece_below(double scalar) const {
  const auto not_below = std::lower_bound(scalars_.begin(), scalars_.end(), scalar);
  return static_cast<std::size_t>(not_below - scalars_.begin()) - 1;
}

PreciseOptics Pieces::slope(std::size_t piece) const {
  const PreciseOptics& below = optics_[piece];
  const PreciseOptics& above = optics_[piece + 1];
  PreciseOptics result;
  result.extinction = (above.extinction - below.extinction) * inverse_widths_[piece];
  for (std::size_t channel = 0; channel < 3; ++channel)
    result.color[channel] = (above.color[channel] - below.color[channel]) * inverse_widths_[piece];
  return result;
}

PreciseOptics Pieces::at(std::size_t piece, double scalar) const {
  const double weight_below = (scalars_[piece + 1] - scalar) * inverse_widths_[piece];
  const double weight_above = (scalar - scalars_[piece]) * inverse_widths_[piece];
  const PreciseOptics& below = optics_[piece];
  const PreciseOptics& above = optics_[piece + 1];
  PreciseOptics result;
  result.extinction = weight_below * below.extinction + weight_above * above.extinction;
  // This form leaves a colour that does not vary exactly as it is.
  const double weight = std::min(weight_above, 1.0);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    result.color[channel] =
        below.color[channel] + weight * (above.color[channel] - below.color[channel]);
  }
  return result;
}

}  // namespace plume
