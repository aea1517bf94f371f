#include "plume/preint/optical_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "plume/preint/segment_optics.h"
#include "plume/tests/preint/transfer_functions.h"
#include "plume/tests/reference/adaptive_quadrature.h"

namespace plume {
namespace {

TEST(OpticalDepth, equals_the_oracle) {
  std::mt19937_64 random(3);
  for (const auto& [name, function] : tests::all_functions()) {
    const OpticalDepth depth(function);
    for (int i = 0; i < 300; ++i) {
      const auto [s_in, s_out] = tests::random_ends(random, function);
      const double expected =
          reference::integrate_linear(function, s_in, s_out, 1, 1e-12).optical_depth;
      EXPECT_NEAR(depth.mean_extinction(s_in, s_out), expected, 1e-14 * expected)
          << name << " from " << s_in << " to " << s_out;
    }
  }
}

TEST(OpticalDepth, is_the_same_in_both_directions) {
  std::mt19937_64 random(4);
  for (const auto& [name, function] : tests::all_functions()) {
    const OpticalDepth depth(function);
    for (int i = 0; i < 300; ++i) {
      const auto [s_in, s_out] = tests::random_ends(random, function);
      EXPECT_EQ(depth.mean_extinction(s_in, s_out), depth.mean_extinction(s_out, s_in)) << name;
    }
  }
}

TEST(OpticalDepth, does_not_cancel_where_scalars_almost_meet) {
  // A ramp, above so much extinction that a plain antiderivative has no digit left for it.
  const TransferFunction function{{{0, {1e30f, {}}}, {1, {1e30f, {}}}, {1, {1, {}}}, {2, {2, {}}}}};
  const OpticalDepth depth(function);
  float s_out = 1.5f;
  for (int i = 0; i < 4; ++i) {
    s_out = std::nextafter(s_out, 2.0f);
    EXPECT_NEAR(depth.mean_extinction(1.5f, s_out), (1.5 + s_out) / 2, 1e-14);
  }
  EXPECT_EQ(depth.mean_extinction(1.5f, 1.5f), 1.5);
}

TEST(OpticalDepth, keeps_relative_precision_above_a_great_sum) {
  // Three pieces of extinction 1 between knots, above an area of 1e30.
  const TransferFunction function{{{0, {1e30f, {}}},
                                   {1, {1e30f, {}}},
                                   {1, {1, {}}},
                                   {2, {1, {}}},
                                   {3, {1, {}}},
                                   {4, {1, {}}},
                                   {5, {1, {}}}}};
  EXPECT_NEAR(OpticalDepth(function).mean_extinction(1.5f, 4.5f), 1, 1e-14);
}

TEST(OpticalDepth, sees_its_own_side_of_a_step) {
  const OpticalDepth depth(tests::step_function());
  // Extinction is 0.4 just below 0.25 and 5 at and just above it.
  EXPECT_EQ(depth.mean_extinction(0.25f, 0.25f), 5);
  EXPECT_NEAR(depth.mean_extinction(0.25f, 0.0f), 0.3, 1e-7);
  EXPECT_NEAR(depth.mean_extinction(0.25f, 0.5f), 4, 1e-7);
  EXPECT_EQ(depth.mean_extinction(0.5f, 0.75f), 0);
  EXPECT_EQ(depth.mean_extinction(0.75f, 0.5f), 0);
}

TEST(OpticalDepth, is_zero_on_an_empty_segment) {
  const OpticalDepth depth(tests::single_knot_function());
  constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(depth(0, 1, 0), 0);
  EXPECT_EQ(depth(not_a_number, 1, 1), 0);
  EXPECT_EQ(depth(0, std::numeric_limits<float>::infinity(), 1), 0);
  EXPECT_EQ(depth(0, 1, 3), 6);
}

TEST(OpticalDepth, saturates_at_the_largest_float) {
  const TransferFunction function{{{0, {3e38f, {}}}}};
  EXPECT_EQ(OpticalDepth(function)(0, 1, 3e38f), std::numeric_limits<float>::max());
}

}  // namespace
}  // namespace plume
