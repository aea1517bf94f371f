/// What every integrator of segments offers.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

#include "plume/preint/scalar_polynomial.h"

namespace plume {

/// What one segment adds to a picture, in front of black.
struct SegmentColor {
  /// Radiance that leaves the segment's front: the integral of color * extinction * exp(-optical
  /// depth so far) over the segment. Linear RGB, premultiplied (by its nature, not by alpha), >= 0.
  float r = 0;
  float g = 0;  ///< see r
  float b = 0;  ///< see r
  /// Opacity, 1 - exp(-optical depth), in [0, 1].
  float alpha = 0;
};

/// Integrates the emission-absorption model over one segment on which the scalar runs linearly from
/// `s_in` (towards the eye) to `s_out`. `length` is in world units, finite and >= 0.
///
/// A segment of zero length, or with a NaN or infinite scalar at either end, is transparent:
/// {0, 0, 0, 0} and an optical depth of 0. `optical_depth` has no unit; it is the largest float
/// where it would exceed it. Both functions are const and safe to call from many threads.
template <class T>
concept SegmentIntegrator = requires(const T& integrator, float s_in, float s_out, float length) {
  { integrator.integrate(s_in, s_out, length) } -> std::same_as<SegmentColor>;
  { integrator.optical_depth(s_in, s_out, length) } -> std::same_as<float>;
};

/// Takes segments along which the scalar is a polynomial as a whole, up to a degree of 2 or 3;
/// others are to be given such parts of one (ScalarPolynomial::for_each_linear_piece and
/// for_each_quadratic_piece). A polynomial with a NaN or infinite value is transparent.
template <class T>
concept CurvedSegmentIntegrator = SegmentIntegrator<T> &&
    requires(const T& integrator, const ScalarPolynomial& scalar, float length) {
  { T::highest_degree } -> std::convertible_to<int>;
  { integrator.integrate(scalar, length) } -> std::same_as<SegmentColor>;
  { integrator.optical_depth(scalar, length) } -> std::same_as<float>;
};

/// True where a segment is transparent whatever the transfer function.
inline bool is_empty_segment(float s_in, float s_out, float length) {
  return !(length > 0) || !std::isfinite(s_in) || !std::isfinite(s_out);
}

/// `value` >= 0 as a float: never more than the largest one.
inline float saturated_float(double value) {
  return static_cast<float>(std::min<double>(value, std::numeric_limits<float>::max()));
}

}  // namespace plume
