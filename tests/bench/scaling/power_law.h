/// Exponents: least squares in log-log.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace plume::bench {

/// y = factor * x^exponent, fitted to points by least squares of log y over log x.
struct PowerLaw {
  double exponent = 0;
  double factor = 0;  ///< y where x is 1
  /// Standard error of the exponent from the residuals; nothing for two points.
  std::optional<double> error;
  /// The least and the greatest exponent from one point to the next.
  double least = 0, most = 0;
};

/// Of values > 0, the x ascending. Nothing where there are fewer than two points, or some are <= 0.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

}  // namespace plume::bench
