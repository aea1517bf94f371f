// The reference integrator, against the oracle that shares nothing with it.

#include "plume/preint/adaptive_integrator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "plume/tests/preint/curved_segments.h"
#include "plume/tests/preint/transfer_functions.h"

namespace plume {
namespace {

double distance(const PreciseColor& color, const reference::Radiance& expected) {
  return std::max(
      {std::abs(color.rgb[0] - expected.rgb[0]), std::abs(color.rgb[1] - expected.rgb[1]),
       std::abs(color.rgb[2] - expected.rgb[2]), std::abs(color.alpha - expected.alpha)});
}

TEST(AdaptiveIntegrator, equals_the_oracle_on_linear_segments) {
  std::mt19937_64 random(31);
  for (const auto& [name, function] : tests::all_functions()) {
    const AdaptiveIntegrator adaptive(function, 1e-10);
    for (int i = 0; i < 200; ++i) {
      const auto [s_in, s_out] = tests::random_ends(random, function);
      const float length = tests::random_length(random, 1e-4f, 1e3f);
      const auto expected = reference::integrate_linear(function, s_in, s_out, length, 1e-11);
      // Places are known to 1e-12 of the segment; the spike rises by 1e10 a unit.
      const double bound = 3e-10 + (name == "narrow spike" ? 2e-8 : 0);
      EXPECT_LE(
          distance(adaptive.integrate_precisely(ScalarPolynomial::linear(s_in, s_out), length),
                   expected),
          bound)
          << name << " from " << s_in << " to " << s_out << " over " << length;
      EXPECT_NEAR(adaptive.optical_depth(s_in, s_out, length), expected.optical_depth,
                  1e-6 * expected.optical_depth + std::numeric_limits<float>::min());
    }
  }
}

TEST(AdaptiveIntegrator, equals_the_oracle_on_quadratics_and_cubics) {
  std::mt19937_64 random(32);
  std::uniform_real_distribution<float> value(-0.2f, 1.2f);
  for (const auto& [name, function] : tests::all_functions()) {
    if (name == "64 random knots") continue;  // 30 times the oracle's work and nothing new
    const AdaptiveIntegrator adaptive(function, 1e-10);
    for (int i = 0; i < 12; ++i) {
      const bool cubic = i % 2 == 0;
      const std::array<float, 4> s{value(random), value(random), value(random), value(random)};
      const auto scalar = cubic ? ScalarPolynomial::cubic(s[0], s[1], s[2], s[3])
                                : ScalarPolynomial::quadratic(s[0], s[1], s[2]);
      const float length = tests::random_length(random, 1e-3f, 1e2f);
      // The oracle's scalars are rounded, and the spike rises by 1e10 a unit.
      const auto expected =
          tests::oracle(function, scalar, length, name == "narrow spike" ? 1e-8 : 1e-11);
      EXPECT_LE(distance(adaptive.integrate_precisely(scalar, length), expected),
                name == "narrow spike" ? 1e-7 : 1e-9)
          << name << ' ' << cubic << ' ' << s[0] << ' ' << s[1] << ' ' << s[2] << ' ' << s[3]
          << " over " << length;
      EXPECT_NEAR(adaptive.optical_depth(scalar, length), expected.optical_depth,
                  1e-6 * expected.optical_depth);
    }
  }
}

TEST(AdaptiveIntegrator, keeps_its_tolerance) {
  std::mt19937_64 random(33);
  std::uniform_real_distribution<float> value(0, 1);
  const TransferFunction function = tests::random_function(7, 20, 50);
  const AdaptiveIntegrator best(function, 1e-13);
  double loosest = 0;
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    const AdaptiveIntegrator adaptive(function, tolerance);
    for (int i = 0; i < 300; ++i) {
      const auto scalar = ScalarPolynomial::quadratic(value(random), value(random), value(random));
      const float length = tests::random_length(random, 1e-3f, 1e3f);
      const PreciseColor color = adaptive.integrate_precisely(scalar, length);
      const PreciseColor expected = best.integrate_precisely(scalar, length);
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_LE(std::abs(color.rgb[c] - expected.rgb[c]), 2 * tolerance) << length;
        if (tolerance == 1e-2)
          loosest = std::max(loosest, std::abs(color.rgb[c] - expected.rgb[c]));
      }
      ASSERT_EQ(color.alpha, expected.alpha);
    }
  }
  EXPECT_GT(loosest, 1e-7);  // or the tolerance would do nothing
}

TEST(AdaptiveIntegrator, takes_steps_exactly_where_the_scalar_turns_at_one) {
  // Red below 1/2, opaque green from there on. A parabola that touches 1/2 from below sees no green
  // but for a point; one that is constant there sees nothing else.
  const TransferFunction function{
      {{0, {1, {1, 0, 0}}}, {0.5f, {1, {1, 0, 0}}}, {0.5f, {100, {0, 1, 0}}}}};
  const AdaptiveIntegrator adaptive(function);
  const SegmentColor touching = adaptive.integrate(ScalarPolynomial::quadratic(0, 0.5, 0), 1);
  EXPECT_NEAR(touching.r, -std::expm1(-1.0), 1e-7);
  EXPECT_EQ(touching.g, 0);
  const SegmentColor constant = adaptive.integrate(0.5f, 0.5f, 1);
  EXPECT_EQ(constant.r, 0);
  EXPECT_FLOAT_EQ(constant.g, 1);
  // From above it is green throughout.
  EXPECT_EQ(adaptive.integrate(ScalarPolynomial::quadratic(1, 0.5, 1), 1).r, 0);
  // Green between 1/4 and 3/4 of the way.
  const SegmentColor through = adaptive.integrate(ScalarPolynomial::quadratic(0, 2.0 / 3, 0), 1);
  EXPECT_NEAR(through.r, -std::expm1(-0.25), 1e-7);
  EXPECT_NEAR(through.alpha, -std::expm1(-50.5), 1e-7);
}

TEST(AdaptiveIntegrator, is_transparent_where_a_value_is_not_finite) {
  const AdaptiveIntegrator adaptive(tests::smooth_function());
  constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {not_a_number, infinity, -infinity}) {
    for (const auto& scalar :
         {ScalarPolynomial::quadratic(0.2f, bad, 0.4f), ScalarPolynomial::linear(bad, 1),
          ScalarPolynomial::cubic(0.1f, 0.2f, 0.3f, bad)}) {
      EXPECT_EQ(adaptive.integrate(scalar, 1).alpha, 0);
      EXPECT_EQ(adaptive.optical_depth(scalar, 1), 0);
    }
  }
  EXPECT_EQ(adaptive.integrate(ScalarPolynomial::quadratic(0, 1, 0), 0).alpha, 0);
}

TEST(AdaptiveIntegrator, sees_the_front_of_what_hides_everything) {
  // Nodes spread over the whole segment would find nothing.
  const TransferFunction function{{{0, {1e30f, {1, 0, 0}}}, {1, {1e30f, {0, 1, 0}}}}};
  const AdaptiveIntegrator adaptive(function);
  const SegmentColor color = adaptive.integrate(ScalarPolynomial::quadratic(0.5, 1, 0), 1e8f);
  EXPECT_NEAR(color.r, 0.5, 1e-7);
  EXPECT_NEAR(color.g, 0.5, 1e-7);
  EXPECT_EQ(color.alpha, 1);
}

}  // namespace
}  // namespace plume
