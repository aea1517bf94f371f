/// The oracle itself, against integrals that have a formula.
#include "plume/tests/reference/adaptive_quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace plume {
namespace {

const double pi = std::acos(-1.0);

TEST(AdaptiveQuadrature, integrates_known_functions) {
  EXPECT_NEAR(reference::integrate([](double x) { return std::exp(x); }, 0, 1, 1e-13),
              std::exp(1.0) - 1, 1e-13);
  EXPECT_NEAR(reference::integrate([](double x) { return 1 / (1 + 1e6 * x * x); }, -1, 1, 1e-12),
              2e-3 * std::atan(1e3), 1e-12);
  EXPECT_NEAR(reference::integrate([](double x) { return std::sqrt(x); }, 0, 1, 1e-10), 2.0 / 3,
              1e-10);
}

TEST(AdaptiveQuadrature, knows_a_uniform_slab) {
  for (const double extinction : {1e-9, 1e-3, 1.0, 30.0, 1e3, 1e6}) {
    const TransferFunction function{{{0, {static_cast<float>(extinction), {0.5f, 1, 2}}}}};
    const double depth = static_cast<float>(extinction) * 3.0;
    const auto result = reference::integrate_linear(function, -1, 1, 3, 1e-10);
    EXPECT_NEAR(result.optical_depth, depth, 1e-10 * depth);
    EXPECT_NEAR(result.alpha, -std::expm1(-depth), 1e-10);
    EXPECT_NEAR(result.rgb[0], 0.5 * result.alpha, 1e-10);
    EXPECT_NEAR(result.rgb[2], 2 * result.alpha, 1e-10);
  }
}

TEST(AdaptiveQuadrature, knows_a_ramp_of_extinction_and_colour) {
  // tau(t) = k t, c(t) = t over [0, 1]: C = psi - T, with the error function for psi.
  for (const float k : {1e-4f, 0.1f, 1.0f, 10.0f, 1e4f}) {
    const TransferFunction function{{{0, {0, {0, 0, 0}}}, {1, {k, {1, 1, 1}}}}};
    const double psi = std::sqrt(pi / (2 * k)) * std::erf(std::sqrt(k / 2.0));
    const auto result = reference::integrate_linear(function, 0, 1, 1, 1e-11);
    EXPECT_NEAR(result.rgb[1], psi - std::exp(-k / 2.0), 1e-11) << k;
    // The same ramp met from its dense end, where colour falls as 1 - t: C = integral of
    // k (1 - t)^2 exp(-k (t - t^2 / 2)) = 1 - exp(-k/2) * integral of exp(k v^2 / 2).
    const auto reversed = reference::integrate_linear(function, 1, 0, 1, 1e-11);
    const auto integrand = [k](double v) { return std::exp(k * (v * v - 1) / 2); };
    const double inner = reference::integrate(integrand, 0, 0.9, 1e-13) +
                         reference::integrate(integrand, 0.9, 0.999, 1e-13) +
                         reference::integrate(integrand, 0.999, 1, 1e-13);
    EXPECT_NEAR(reversed.rgb[1], 1 - inner, 1e-11) << k;
  }
}

TEST(AdaptiveQuadrature, takes_any_scalar_along_the_ray) {
  // A scalar of t^2 with extinction s: depth = t^3 / 3, colour 1.
  reference::Medium medium;
  medium.length = 2;
  medium.extinction = [](double t) { return t * t; };
  medium.color = [](double) { return std::array<double, 3>{1, 1, 1}; };
  const auto result = reference::integrate(medium, 1e-11);
  EXPECT_NEAR(result.optical_depth, 8.0 / 3, 1e-10);
  EXPECT_NEAR(result.rgb[0], -std::expm1(-8.0 / 3), 1e-11);
}

TEST(AdaptiveQuadrature, says_that_it_does_not_converge) {
  reference::Medium medium;
  medium.length = 1;
  medium.extinction = [](double t) { return 1 + std::fmod(t * 1e7, 1.0); };
  medium.color = [](double) { return std::array<double, 3>{1, 1, 1}; };
  EXPECT_THROW(reference::integrate(medium, 1e-12), std::runtime_error);
}

TEST(AdaptiveQuadrature, finds_what_lies_behind_a_break_point) {
  // Nothing, then from t = 1 on an opaque wall of colour 0.25.
  reference::Medium medium;
  medium.length = 2;
  medium.extinction = [](double t) { return t < 1 ? 0.0 : 1e6; };
  medium.color = [](double) { return std::array<double, 3>{0.25, 0.25, 0.25}; };
  medium.break_points = {1};
  EXPECT_NEAR(reference::integrate(medium, 1e-10).rgb[0], 0.25, 1e-10);
}

}  // namespace
}  // namespace plume
