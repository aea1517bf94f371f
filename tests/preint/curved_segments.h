/// Segments along which the scalar is a polynomial, and what adaptive quadrature makes of them:
/// shared by the tests of who takes such segments. No code of preint but the transfer function as
/// data.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "plume/preint/transfer_function.h"
#include "plume/tests/reference/adaptive_quadrature.h"

namespace plume::tests {

/// Extinction and colour at a scalar, in double; at a step, the side that `inside` lies on.
inline std::array<double, 4> optics_at(const TransferFunction& function, double scalar,
                                       double inside) {
  const auto& knots = function.knots;
  const auto of = [](const Optics& o) {
    return std::array<double, 4>{o.extinction, o.color[0], o.color[1], o.color[2]};
  };
  if (inside < knots.front().scalar) return of(knots.front().optics);
  std::size_t below = 0;
  while (below + 1 < knots.size() && knots[below + 1].scalar <= inside) ++below;
  if (below + 1 == knots.size()) return of(knots.back().optics);
  const double low = knots[below].scalar, high = knots[below + 1].scalar;
  const double weight = (scalar - low) / (high - low);
  const auto a = of(knots[below].optics), b = of(knots[below + 1].optics);
  std::array<double, 4> result;
  for (std::size_t i = 0; i < 4; ++i) result[i] = a[i] + weight * (b[i] - a[i]);
  return result;
}

/// The integral along a segment whose scalar is scalar(u), u in [0, 1]: cut where it crosses a knot
/// (found by bisection between 4000 places).
template <class Scalar>
reference::Radiance oracle(const TransferFunction& function, const Scalar& scalar, double length,
                           double tolerance = 1e-11) {
  std::vector<double> cuts{0, 1};
  constexpr int places = 4000;
  for (const auto& knot : function.knots) {
    const auto above = [&](double u) { return scalar(u) >= knot.scalar; };
    for (int i = 0; i < places; ++i) {
      double low = static_cast<double>(i) / places, high = (i + 1.0) / places;
      const bool side = above(low);
      if (side == above(high)) continue;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = (low + high) / 2;
        (above(middle) == side ? low : high) = middle;
      }
      cuts.push_back(high);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  reference::Radiance sum;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double from = cuts[i], width = cuts[i + 1] - from;
    if (width < 1e-13) continue;
    const double inside = scalar(from + width / 2);
    reference::Medium part;
    part.length = width * length;
    const auto at = [&, from](double t) {
      return optics_at(function, scalar(from + t / length), inside);
    };
    part.extinction = [at](double t) { return std::max(0.0, at(t)[0]); };
    part.color = [at](double t) {
      const auto values = at(t);
      return std::array<double, 3>{values[1], values[2], values[3]};
    };
    const reference::Radiance added = reference::integrate(part, tolerance);
    for (std::size_t c = 0; c < 3; ++c) sum.rgb[c] += (1 - sum.alpha) * added.rgb[c];
    sum.alpha += (1 - sum.alpha) * added.alpha;
    sum.optical_depth += added.optical_depth;
  }
  return sum;
}

}  // namespace plume::tests
