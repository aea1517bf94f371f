#include "plume/preint/psi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plume/tests/reference/adaptive_quadrature.h"

namespace plume {
namespace {

/// 0, and from 1e-6 to 1e6 in thirds of a decade.
std::vector<double> grid() {
  std::vector<double> values{0};
  for (int i = -18; i <= 18; ++i) values.push_back(std::pow(10.0, i / 3.0));
  return values;
}

double depth_so_far(double a, double b, double u) { return u * (a + (b - a) * u / 2); }

/// Integral over [0, 1] of f, which falls like exp(-depth): cut at a ladder of points towards 0, so
/// that no rule misses a narrow start.
template <class F>
double oracle(F f) {
  double sum = 0;
  double high = 1;
  for (int i = 0; i < 40; ++i) {
    sum += reference::integrate(f, high / 2, high, 1e-14);
    high /= 2;
  }
  return sum + reference::integrate(f, 0, high, 1e-14);
}

TEST(Psi, is_within_its_bound_of_the_quadrature) {
  double largest_error = 0;
  for (const double a : grid()) {
    for (const double b : grid()) {
      const double expected = oracle([=](double u) { return std::exp(-depth_so_far(a, b, u)); });
      const double error = std::abs(psi(a, b) - expected);
      EXPECT_LE(error, 2e-9) << "a " << a << " b " << b;
      largest_error = std::max(largest_error, error);
    }
  }
  RecordProperty("largest_error", std::to_string(largest_error * 1e9) + "e-9");
}

TEST(Psi, chi_is_within_its_bounds_of_the_quadrature) {
  double largest_error = 0;
  double largest_relative_error = 0;
  for (const double a : grid()) {
    for (const double b : grid()) {
      const double expected = oracle(
          [=](double u) { return u * (a + (b - a) * u) * std::exp(-depth_so_far(a, b, u)); });
      const double error = std::abs(chi(a, b) - expected);
      EXPECT_LE(error, 2e-9) << "a " << a << " b " << b;
      largest_error = std::max(largest_error, error);
      if (a + b > 0 && a + b <= 2) {
        EXPECT_LE(error, 2e-8 * expected) << "a " << a << " b " << b;
        largest_relative_error = std::max(largest_relative_error, error / expected);
      }
    }
  }
  RecordProperty("largest_error", std::to_string(largest_error * 1e9) + "e-9");
  RecordProperty("largest_relative_error", std::to_string(largest_relative_error * 1e9) + "e-9");
}

TEST(Psi, stays_within_its_bound_around_each_change_of_rule) {
  for (const double depth : {0.1, 0.249, 0.25, 0.251, 0.3, 1.0, 4.0, 20.0, 60.0, 700.0}) {
    for (int i = 0; i <= 50; ++i) {
      const double a = 2 * depth * i / 50;
      const double b = 2 * depth - a;
      const double expected = oracle(
          [=](double u) { return u * (a + (b - a) * u) * std::exp(-depth_so_far(a, b, u)); });
      EXPECT_NEAR(chi(a, b), expected, 2e-9) << "a " << a << " b " << b;
    }
  }
}

TEST(Psi, is_within_its_bound_where_extinction_hardly_changes) {
  // The change of sign of b - a, to either side of which belongs another table.
  for (const double a : {0.2, 0.26, 0.5, 2.0, 10.0, 1e3, 1e6}) {
    for (const double change : {1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.3}) {
      for (const double b : {a * (1 - change), a * (1 + change)}) {
        const double expected = oracle([=](double u) { return std::exp(-depth_so_far(a, b, u)); });
        EXPECT_NEAR(psi(a, b), expected, 2e-9) << "a " << a << " b " << b;
      }
    }
  }
}

TEST(Psi, absorbed_is_one_minus_the_transparency) {
  for (const double depth : grid()) {
    EXPECT_NEAR(absorbed(depth), -std::expm1(-depth), -1e-10 * std::expm1(-depth)) << depth;
    EXPECT_EQ(absorption(depth, depth).absorbed, absorbed(depth)) << depth;
  }
}

TEST(Psi, is_known_for_uniform_extinction) {
  EXPECT_EQ(psi(0, 0), 1);
  EXPECT_EQ(chi(0, 0), 0);
  for (const double a : grid()) {
    if (a == 0) continue;
    EXPECT_NEAR(psi(a, a), -std::expm1(-a) / a, 2e-9) << a;
  }
}

TEST(Psi, is_known_for_extinction_that_starts_at_nothing) {
  // The error function of Williams and Max.
  for (const double b : grid()) {
    if (b == 0) continue;
    EXPECT_NEAR(psi(0, b), std::sqrt(std::acos(-1.0) / (2 * b)) * std::erf(std::sqrt(b / 2)), 2e-9)
        << b;
  }
}

TEST(Psi, stays_finite_for_enormous_extinction) {
  for (const double a : {0.0, 1.0, 1e77, 1e150}) {
    for (const double b : {1e77, 1e150}) {
      EXPECT_GE(psi(a, b), 0);
      EXPECT_LE(psi(a, b), 1e-8 + (a <= 1 ? 2e-8 : 0));
      EXPECT_GE(chi(b, a), 0);
      EXPECT_LE(chi(b, a), 1e-8);
    }
  }
}

}  // namespace
}  // namespace plume
