/// A scalar that is a polynomial along a segment, for integrators that want it linear.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace plume {

/// A polynomial of degree 2 or 3 over the share u in [0, 1] of a segment, through equidistant
/// values, by divided differences: Ament, Weiskopf and Carr, "Direct Interval Volume Visualization"
/// (TVCG 2010), equations 19 to 26. It goes through the values to within a few units in the last
/// place of the largest of them.
///
/// NaN or infinite values make a polynomial that is transparent: one piece from NaN to NaN.
class ScalarPolynomial {
 public:
  /// Through values at 0, 1/2 and 1.
  static ScalarPolynomial quadratic(float first, float middle, float last);
  /// Through values at 0, 1/3, 2/3 and 1.
  static ScalarPolynomial cubic(float first, float third, float two_thirds, float last);

  double operator()(double u) const {
    return coefficient_[0] + u * (coefficient_[1] + u * (coefficient_[2] + u * coefficient_[3]));
  }

  /// The places in ascending order where the derivative changes sign, strictly between 0 and 1: at
  /// most two.
  struct Extrema {
    std::array<double, 2> places{};
    std::size_t size = 0;
    const double* begin() const { return places.data(); }
    const double* end() const { return places.data() + size; }
  };
  const Extrema& extrema() const { return extrema_; }

  /// The greatest value on [0, 1]. NaN is passed over; NaN where both ends are.
  float maximum() const;
  /// The least value on [0, 1], likewise.
  float minimum() const;

  /// The integral over [0, 1], exact but for rounding (Simpson's rule, the 3/8 rule).
  double mean() const {
    return coefficient_[0] + coefficient_[1] / 2 + coefficient_[2] / 3 + coefficient_[3] / 4;
  }

  /// Where the polynomial has a value between u0 and u1, two places with no extremum between them:
  /// the root is isolated, and repeated linear interpolation finds it (Marmitt, "Interactive Volume
  /// Ray Tracing" (2008), section 4.3.3, algorithm 8), here with the Illinois rule, by which both
  /// ends close in. Within 1e-12 of the root, where the polynomial's slope leaves that of its own
  /// rounding. Where no value between u0 and u1 is that one (by rounding of what led there), the
  /// place nearer to it.
  double place_of(double value, double u0, double u1) const;

  /// Pieces of each monotone part are no more than this many, whatever the tolerance.
  static constexpr int kMostPieces = 32;

  /// Cuts [0, 1] at the extrema into at most three monotone parts, and each of them evenly into as
  /// many pieces as make the polynomial differ from their chords by at most `tolerance`, in the
  /// scalar's unit. A chord of width h is off by at most h^2 / 8 times the greatest second
  /// derivative, which for a cubic is at an end of the part. Where kMostPieces are too few, the
  /// error is that of so many. Where no more than rounding of the values bends the polynomial, it
  /// is one piece. Calls
  ///     visit(double u0, double u1, float s0, float s1)
  /// for each piece in turn, until it returns false; pieces join bit for bit, and begin and end
  /// with the first and last value. Returns whether all were visited.
  template <class Visit>
  bool for_each_linear_piece(double tolerance, Visit&& visit) const {
    if (!finite_) return visit(0.0, 1.0, kNaN, kNaN);
    if (bend(0, 1) <= rounding_) return visit(0.0, 1.0, first_, last_);
    double from = 0;
    float scalar = first_;
    auto part = [&](double to, float last) {
      const double needed = std::ceil(std::sqrt(bend(from, to) / tolerance));
      // Not finite where the tolerance is 0.
      const int pieces = needed < kMostPieces ? std::max(1, static_cast<int>(needed)) : kMostPieces;
      const double begin = from;
      for (int i = 1; i <= pieces; ++i) {
        const double u = i == pieces ? to : begin + (to - begin) * i / pieces;
        const float next = i == pieces ? last : static_cast<float>((*this)(u));
        if (!visit(from, u, scalar, next)) return false;
        from = u;
        scalar = next;
      }
      return true;
    };
    for (const double extremum : extrema_)
      if (!part(extremum, static_cast<float>((*this)(extremum)))) return false;
    return part(1, last_);
  }

 private:
  static constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

  ScalarPolynomial(const std::array<double, 4>& coefficient, float first, float last,
                   float largest);

  // How far the polynomial may be from its chord between two places.
  double bend(double from, double to) const {
    const double second = std::max(std::abs(2 * coefficient_[2] + 6 * coefficient_[3] * from),
                                   std::abs(2 * coefficient_[2] + 6 * coefficient_[3] * to));
    return second * (to - from) * (to - from) / 8;
  }

  std::array<double, 4> coefficient_;
  float first_, last_;
  double rounding_;
  bool finite_;
  Extrema extrema_;
};

}  // namespace plume
