/// What the integrators are off by, and what they cost: on segments with a linear scalar.
#pragma once

#include <cstdint>
#include <string>

namespace plume::bench {

struct IntegratorBenchOptions {
  int segments = 2800;  ///< for each transfer function, spread over seven decades of length
  int rounds = 15;      ///< of timing, in turns; medians are reported
  std::uint64_t seed = 1;
  bool quick = false;  ///< without the larger tables, which take long to build
};

/// Markdown: the largest and the RMS error of each integrator on six transfer functions, the closed
/// form's by decade of length, and the time a segment takes.
std::string integrator_errors(const IntegratorBenchOptions& options);

/// Markdown: a segment's time by the closed form and by the table for 8 knots, one by one and by
/// vectors, and what a new transfer function takes.
std::string integrator_costs(const IntegratorBenchOptions& options);

/// Markdown: tables of first and second order on rays through a trilinear field, by step, and on
/// single quadratic segments, by size.
std::string second_order_errors(const IntegratorBenchOptions& options);

}  // namespace plume::bench
