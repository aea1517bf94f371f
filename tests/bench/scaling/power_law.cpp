#include "plume/tests/bench/scaling/power_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plume::bench {

std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y) {
  const std::size_t n = x.size();
  if (n < 2) return std::nullopt;
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(x[i] > 0) || !(y[i] > 0)) return std::nullopt;
    mean_x += std::log(x[i]) / static_cast<double>(n);
    mean_y += std::log(y[i]) / static_cast<double>(n);
  }
  double xx = 0, xy = 0;
  PowerLaw law;
  law.least = std::numeric_limits<double>::infinity();
  law.most = -law.least;
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = std::log(x[i]) - mean_x;
    xx += dx * dx;
    xy += dx * (std::log(y[i]) - mean_y);
    if (i == 0) continue;
    const double step = std::log(y[i] / y[i - 1]) / std::log(x[i] / x[i - 1]);
    law.least = std::min(law.least, step);
    law.most = std::max(law.most, step);
  }
  law.exponent = xy / xx;
  law.factor = std::exp(mean_y - law.exponent * mean_x);
  if (n > 2) {
    double squares = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double off = std::log(y[i]) - mean_y - law.exponent * (std::log(x[i]) - mean_x);
      squares += off * off;
    }
    law.error = std::sqrt(squares / static_cast<double>(n - 2) / xx);
  }
  return law;
}

}  // namespace plume::bench
