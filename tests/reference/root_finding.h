/// Where a cubic along a ray first has a value: the five ways of Marmitt, "Interactive Volume Ray
/// Tracing" (2008), section 4.3.3, as they are written there, to compare with.
///
/// All take the cubic by its coefficients over [0, 1], less the value that is looked for: a root.
/// They return nothing where they find none, which is not to say that there is none. Real is float,
/// as in the thesis, or double.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace plume::reference {

template <class Real>
struct CubicAlongRay {
  std::array<Real, 4> c;  ///< of u^0 to u^3
  Real operator()(Real u) const { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); }
};

/// Half way, in any cell that has corners on both sides: "only mentioned as a reference".
template <class Real>
std::optional<Real> midpoint_root(const CubicAlongRay<Real>& f) {
  if (f(0) * f(1) > 0) return std::nullopt;
  return Real(0.5);
}

/// Algorithm 6, for values that rise or fall.
template <class Real>
std::optional<Real> linear_root(const CubicAlongRay<Real>& f) {
  const Real in = f(0), out = f(1);
  if (in * out > 0 || in == out) return std::nullopt;
  return -in / (out - in);
}

/// Algorithm 7 (Neubauer et al. 2002) between two places, with `steps` of two to three.
template <class Real>
std::optional<Real> repeated_linear_root(const CubicAlongRay<Real>& f, int steps, Real u_in = 0,
                                         Real u_out = 1) {
  Real in = f(u_in), out = f(u_out);
  if (in * out > 0 || in == out) return std::nullopt;
  auto place = [&] { return u_in + (u_out - u_in) * (-in / (out - in)); };
  for (int i = 0; i < steps && in != out; ++i) {
    const Real u = place(), value = f(u);
    if (value * in > 0) {
      u_in = u;
      in = value;
    } else {
      u_out = u;
      out = value;
    }
  }
  return in == out ? u_in : place();
}

/// All roots in closed form (Schwarze, "Cubic and quartic roots", Graphics Gems I, 1990), of which
/// the first in [0, 1]; small leading coefficients are left out.
template <class Real>
std::optional<Real> analytic_root(const CubicAlongRay<Real>& f) {
  constexpr Real kSmall = sizeof(Real) == 4 ? Real(1e-5) : Real(1e-9);
  auto is_small = [&](Real x) { return std::abs(x) < kSmall; };
  std::array<Real, 3> roots{};
  std::size_t size = 0;
  if (!is_small(f.c[3])) {
    // u^3 + a u^2 + b u + c, without its square: x^3 + 3 p x + 2 q.
    const Real a = f.c[2] / f.c[3], b = f.c[1] / f.c[3], c = f.c[0] / f.c[3];
    const Real p = (b - a * a / 3) / 3;
    const Real q = (Real(2) / 27 * a * a * a - a * b / 3 + c) / 2;
    const Real discriminant = q * q + p * p * p;
    if (is_small(discriminant)) {
      const Real u = std::cbrt(-q);
      roots = {2 * u, -u, 0};
      size = is_small(q) ? 1 : 2;
    } else if (discriminant < 0) {
      const Real phi = std::acos(-q / std::sqrt(-p * p * p)) / 3, t = 2 * std::sqrt(-p);
      constexpr Real kThird = std::numbers::pi_v<Real> / 3;
      roots = {t * std::cos(phi), -t * std::cos(phi + kThird), -t * std::cos(phi - kThird)};
      size = 3;
    } else {
      const Real root = std::sqrt(discriminant);
      roots[0] = std::cbrt(root - q) - std::cbrt(root + q);
      size = 1;
    }
    for (std::size_t i = 0; i < size; ++i) roots[i] -= a / 3;
  } else if (!is_small(f.c[2])) {
    const Real p = f.c[1] / (2 * f.c[2]), q = f.c[0] / f.c[2], discriminant = p * p - q;
    if (discriminant >= 0) {
      roots = {-p - std::sqrt(discriminant), -p + std::sqrt(discriminant), 0};
      size = 2;
    }
  } else if (!is_small(f.c[1])) {
    roots[0] = -f.c[0] / f.c[1];
    size = 1;
  }
  std::optional<Real> first;
  for (std::size_t i = 0; i < size; ++i)
    if (roots[i] >= 0 && roots[i] <= 1 && (!first || roots[i] < *first)) first = roots[i];
  return first;
}

/// Algorithm 8: the extrema isolate the roots, repeated linear interpolation finds the first one,
/// in a fixed number of steps.
template <class Real>
std::optional<Real> isolated_root(const CubicAlongRay<Real>& f, int steps) {
  std::array<Real, 4> ends{0, 1, 1, 1};
  std::size_t size = 1;
  const Real a = 3 * f.c[3], b = 2 * f.c[2], c = f.c[1];
  const Real discriminant = b * b - 4 * a * c;
  if (discriminant > 0) {
    const Real root = std::sqrt(discriminant);
    std::array<Real, 2> extrema{(-b - root) / (2 * a), (-b + root) / (2 * a)};
    std::sort(extrema.begin(), extrema.end());
    for (const Real u : extrema)
      if (u > 0 && u < 1) ends[size++] = u;
  }
  ends[size++] = 1;
  for (std::size_t i = 0; i + 1 < size; ++i)
    if (f(ends[i]) * f(ends[i + 1]) <= 0)
      return repeated_linear_root(f, steps, ends[i], ends[i + 1]);
  return std::nullopt;
}

/// The first root to the last bit of a double, by bisection between the extrema in long double: the
/// truth.
inline std::optional<double> first_root(const CubicAlongRay<double>& f) {
  auto at = [&](long double u) { return f.c[0] + u * (f.c[1] + u * (f.c[2] + u * f.c[3])); };
  std::array<long double, 4> ends{0};
  std::size_t size = 1;
  const long double a = 3.0L * f.c[3], b = f.c[2], c = f.c[1];
  const long double discriminant = b * b - a * c;
  if (discriminant > 0) {
    const long double q = -(b + std::copysign(std::sqrt(discriminant), b));
    std::array<long double, 2> extrema{q / a, c / q};
    std::sort(extrema.begin(), extrema.end());
    for (const long double u : extrema)
      if (u > 0 && u < 1) ends[size++] = u;
  }
  ends[size++] = 1;
  for (std::size_t i = 0; i + 1 < size; ++i) {
    long double low = ends[i], high = ends[i + 1];
    const bool below = at(low) < 0;
    if (at(low) == 0) return static_cast<double>(low);
    if (below == (at(high) < 0)) continue;
    for (int step = 0; step < 200 && low < high; ++step) {
      const long double middle = (low + high) / 2;
      ((at(middle) < 0) == below ? low : high) = middle;
    }
    return static_cast<double>(low);
  }
  return std::nullopt;
}

}  // namespace plume::reference
