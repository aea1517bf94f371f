#include "plume/preint/scalar_polynomial.h"

#include <initializer_list>
#include <utility>

namespace plume {

ScalarPolynomial::ScalarPolynomial(const std::array<double, 4>& coefficient, float first,
                                   float last, float largest)
    : coefficient_(coefficient),
      first_(first),
      last_(last),
      // Each value is off by half a unit in its last place, 2^-24 of it; the second derivative by
      // at most 9 (2 + 5 + 4 + 1) = 108 times that, a chord by an eighth of it.
      rounding_(13.5 * 0x1p-24 * static_cast<double>(largest)),
      finite_(std::isfinite(largest)) {
  if (!finite_) return;
  // a u^2 + 2 b u + c, by the formula that does not cancel. A root of even order is no extremum.
  const double a = 3 * coefficient[3], b = coefficient[2], c = coefficient[1];
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) return;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  for (const double root : {q / a, c / q})
    if (root > 0 && root < 1) extrema_.places[extrema_.size++] = root;
  if (extrema_.size == 2 && extrema_.places[0] > extrema_.places[1])
    std::swap(extrema_.places[0], extrema_.places[1]);
}

namespace {

// The largest absolute value, or what is not finite.
float largest_of(std::initializer_list<float> values) {
  float largest = 0;
  for (const float value : values) {
    if (!std::isfinite(value)) return value;
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

}  // namespace

ScalarPolynomial ScalarPolynomial::quadratic(float first, float middle, float last) {
  const double s0 = first, s1 = middle, s2 = last;
  const double d01 = 2 * (s1 - s0), d12 = 2 * (s2 - s1);
  const double d012 = d12 - d01;
  return {{s0, d01 - d012 / 2, d012, 0}, first, last, largest_of({first, middle, last})};
}

ScalarPolynomial ScalarPolynomial::cubic(float first, float third, float two_thirds, float last) {
  const double s0 = first, s1 = third, s2 = two_thirds, s3 = last;
  const double d01 = 3 * (s1 - s0), d12 = 3 * (s2 - s1), d23 = 3 * (s3 - s2);
  const double d012 = 1.5 * (d12 - d01), d123 = 1.5 * (d23 - d12);
  const double d0123 = d123 - d012;
  return {{s0, d01 - d012 / 3 + 2 * d0123 / 9, d012 - d0123, d0123},
          first,
          last,
          largest_of({first, third, two_thirds, last})};
}

double ScalarPolynomial::place_of(double value, double u0, double u1) const {
  constexpr int kSteps = 100;  // some 6 do; a bisection would need 40
  double f0 = (*this)(u0)-value, f1 = (*this)(u1)-value;
  if (!(f0 * f1 < 0)) return std::abs(f0) <= std::abs(f1) ? u0 : u1;
  int kept = 0;  // +1 where u0 was kept in the last step, -1 where u1 was
  double u = u0;
  for (int step = 0; step < kSteps && std::abs(u1 - u0) > 1e-12; ++step) {
    u = u0 + (u1 - u0) * (f0 / (f0 - f1));
    const double f = (*this)(u)-value;
    if (f == 0) return u;
    if (f * f1 > 0) {
      u1 = u;
      f1 = f;
      if (kept > 0) f0 /= 2;
      kept = 1;
    } else {
      u0 = u;
      f0 = f;
      if (kept < 0) f1 /= 2;
      kept = -1;
    }
  }
  return u;
}

float ScalarPolynomial::maximum() const {
  float maximum = std::fmax(first_, last_);
  for (const double place : extrema_)
    maximum = std::fmax(maximum, static_cast<float>((*this)(place)));
  return maximum;
}

float ScalarPolynomial::minimum() const {
  float minimum = std::fmin(first_, last_);
  for (const double place : extrema_)
    minimum = std::fmin(minimum, static_cast<float>((*this)(place)));
  return minimum;
}

}  // namespace plume
