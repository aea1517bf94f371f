/// The oracle for everything in preint: the emission-absorption integral, in double, to a
/// tolerance.
///
/// Shares no code with preint; the only thing taken from there is the transfer function as data.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "plume/preint/transfer_function.h"

namespace plume::reference {

struct Radiance {
  std::array<double, 3> rgb{0, 0, 0};
  double alpha = 0;
  double optical_depth = 0;
};

/// What a ray meets over t in [0, length]; as functions of t, so that any scalar along the ray and
/// any transfer function can be put together.
struct Medium {
  double length = 0;
  /// Per unit of t.
  std::function<double(double)> extinction;
  std::function<std::array<double, 3>(double)> color;
  /// Every t at which one of the two is not smooth, in any order.
  std::vector<double> break_points;
};

/// rgb = integral of color * extinction * exp(-optical depth so far), by adaptive Gauss-Kronrod
/// quadrature (7 and 15 nodes, QUADPACK's) between the break points. The error of rgb is within
/// `tolerance` times the largest colour, that of alpha within `tolerance`, and that of the optical
/// depth within `tolerance` times its value, as far as the difference of the two rules tells; in
/// practice it is smaller by orders of magnitude. Sensible tolerances: 1e-12 to 1e-6. Throws
/// std::runtime_error where a hundred thousand panels do not reach it, as across an undeclared
/// break point.
Radiance integrate(const Medium& medium, double tolerance);

/// The same for a transfer function and a scalar that runs linearly from s_in to s_out. Break
/// points are the knots; between two of them the optics are taken as linear in t from end to end,
/// so that scalars that differ by one unit in the last place make no noise.
Radiance integrate_linear(const TransferFunction& transfer_function, double s_in, double s_out,
                          double length, double tolerance = 1e-10);

/// integral of f from `low` to `high`, within `tolerance` absolute.
double integrate(const std::function<double(double)>& f, double low, double high, double tolerance);

}  // namespace plume::reference
