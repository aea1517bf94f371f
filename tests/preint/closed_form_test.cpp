#include "plume/preint/closed_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "plume/preint/compositing.h"
#include "plume/tests/preint/seeded_rapidcheck.h"
#include "plume/tests/preint/transfer_functions.h"
#include "plume/tests/reference/adaptive_quadrature.h"

namespace plume {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// The largest error of any channel or of alpha.
double distance(const SegmentColor& color, const reference::Radiance& expected) {
  return std::max({std::abs(color.r - expected.rgb[0]), std::abs(color.g - expected.rgb[1]),
                   std::abs(color.b - expected.rgb[2]), std::abs(color.alpha - expected.alpha)});
}

float distance(const SegmentColor& first, const SegmentColor& second) {
  return std::max({std::abs(first.r - second.r), std::abs(first.g - second.g),
                   std::abs(first.b - second.b), std::abs(first.alpha - second.alpha)});
}

TEST(ClosedForm, equals_the_oracle) {
  std::mt19937_64 random(1);
  for (const auto& [name, function] : tests::all_functions()) {
    const ClosedForm closed_form(function);
    double largest_error = 0;
    for (int i = 0; i < 300; ++i) {
      const auto [s_in, s_out] = tests::random_ends(random, function);
      const float length = tests::random_length(random, 1e-4f, 1e3f);
      const double error =
          distance(closed_form.integrate(s_in, s_out, length),
                   reference::integrate_linear(function, s_in, s_out, length, 1e-10));
      // The documented bound; colours here are at most 1.
      EXPECT_LE(error, 1e-7) << name << " from " << s_in << " to " << s_out << " over " << length;
      largest_error = std::max(largest_error, error);
    }
    RecordProperty(name, std::to_string(largest_error * 1e9) + "e-9");
  }
}

TEST(ClosedForm, keeps_relative_accuracy_where_nearly_transparent) {
  // Below it, floats themselves lose relative accuracy.
  constexpr float smallest_normal = std::numeric_limits<float>::min();
  std::mt19937_64 random(2);
  for (const float scale : {1e-3f, 1e-8f, 1e-20f}) {
    const TransferFunction function = tests::scaled_smooth_function(scale);
    const ClosedForm closed_form(function);
    for (int i = 0; i < 200; ++i) {
      const auto [s_in, s_out] = tests::random_ends(random, function);
      const float length = tests::random_length(random, 1e-3f, 10);
      const SegmentColor color = closed_form.integrate(s_in, s_out, length);
      const auto expected = reference::integrate_linear(function, s_in, s_out, length, 1e-10);
      const std::array<float, 3> rgb{color.r, color.g, color.b};
      for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(rgb[channel], expected.rgb[channel],
                    2e-7 * expected.rgb[channel] + smallest_normal)
            << scale << " from " << s_in << " to " << s_out << " over " << length;
      }
      EXPECT_NEAR(color.alpha, expected.alpha, 1e-7 * expected.alpha + smallest_normal);
    }
  }
}

TEST(ClosedForm, of_one_colour_is_that_colour_times_opacity) {
  TransferFunction function = tests::random_function(5, 64, 10);
  for (auto& knot : function.knots) knot.optics.color = {0.25f, 0.5f, 1.0f};
  const ClosedForm closed_form(function);
  std::mt19937_64 random(6);
  for (int i = 0; i < 1000; ++i) {
    const auto [s_in, s_out] = tests::random_ends(random, function);
    const SegmentColor color =
        closed_form.integrate(s_in, s_out, tests::random_length(random, 1e-4f, 1e3f));
    EXPECT_FLOAT_EQ(color.r, 0.25f * color.alpha);
    EXPECT_FLOAT_EQ(color.g, 0.5f * color.alpha);
    EXPECT_FLOAT_EQ(color.b, color.alpha);
  }
}

TEST(ClosedForm, alpha_belongs_to_the_optical_depth) {
  std::mt19937_64 random(7);
  for (const auto& [name, function] : tests::all_functions()) {
    const ClosedForm closed_form(function);
    for (int i = 0; i < 300; ++i) {
      const auto [s_in, s_out] = tests::random_ends(random, function);
      const float length = tests::random_length(random, 1e-4f, 1e3f);
      const double depth = closed_form.optical_depth(s_in, s_out, length);
      EXPECT_NEAR(closed_form.integrate(s_in, s_out, length).alpha, -std::expm1(-depth), 1e-7)
          << name;
    }
  }
}

TEST(ClosedForm, handles_a_segment_exactly_at_a_step) {
  const ClosedForm closed_form(tests::step_function());
  // Constant at the step: the later knot, extinction 5 and red.
  const SegmentColor at_step = closed_form.integrate(0.25f, 0.25f, 0.1f);
  EXPECT_NEAR(at_step.alpha, -std::expm1(-0.5), 1e-7);
  EXPECT_NEAR(at_step.r, at_step.alpha, 1e-7);
  EXPECT_EQ(at_step.b, 0);
  // From the step down: only the lower side, extinction 0.4 to 0.2, no red.
  const SegmentColor down = closed_form.integrate(0.25f, 0.0f, 1);
  EXPECT_NEAR(down.alpha, -std::expm1(-0.3), 1e-7);
  EXPECT_EQ(down.r, 0);
  EXPECT_NEAR(down.b, down.alpha, 1e-7);
  // From the step up: only the upper side, extinction 5 to 3, no blue.
  const SegmentColor up = closed_form.integrate(0.25f, 0.5f, 1);
  EXPECT_NEAR(up.alpha, -std::expm1(-4.0), 1e-7);
  EXPECT_EQ(up.b, 0);
  // Up to the step: its lower side.
  EXPECT_NEAR(closed_form.integrate(0.0f, 0.25f, 1).alpha, -std::expm1(-0.3), 1e-7);
  // Across the piece without extinction between two steps.
  EXPECT_EQ(closed_form.integrate(0.5f, 0.75f, 1e6f).alpha, 0);
  EXPECT_EQ(closed_form.integrate(0.75f, 0.5f, 1e6f).r, 0);
}

TEST(ClosedForm, handles_steps_that_are_all_there_is) {
  const TransferFunction function{{{1, {0, {1, 0, 0}}}, {1, {3, {0, 1, 0}}}}};
  const ClosedForm closed_form(function);
  EXPECT_EQ(closed_form.integrate(0, 1, 5).alpha, 0);
  EXPECT_NEAR(closed_form.integrate(0, 2, 1).g, -std::expm1(-1.5), 1e-7);
  EXPECT_NEAR(closed_form.integrate(2, 0, 1).g, -std::expm1(-1.5), 1e-7);
  EXPECT_NEAR(closed_form.integrate(1, 1, 1).g, -std::expm1(-3.0), 1e-7);
  EXPECT_EQ(closed_form.integrate(2, 0, 1).r, 0);
}

TEST(ClosedForm, is_transparent_where_a_segment_is_empty) {
  const ClosedForm closed_form(tests::single_knot_function());
  const SegmentColor nothing;
  EXPECT_EQ(distance(closed_form.integrate(0, 1, 0), nothing), 0);
  for (const float bad : {not_a_number, infinity, -infinity}) {
    EXPECT_EQ(distance(closed_form.integrate(bad, 1, 1), nothing), 0);
    EXPECT_EQ(distance(closed_form.integrate(0, bad, 1), nothing), 0);
    EXPECT_EQ(closed_form.optical_depth(0, bad, 1), 0);
  }
}

TEST(ClosedForm, shows_the_front_of_an_optical_depth_of_a_million) {
  const TransferFunction function{{{0, {1e6f, {1, 0, 0}}}, {1, {1e6f, {0, 1, 0}}}}};
  const ClosedForm closed_form(function);
  const SegmentColor front = closed_form.integrate(0, 1, 1);
  EXPECT_NEAR(front.r, 1 - 1e-6, 1e-7);
  EXPECT_NEAR(front.g, 1e-6, 1e-8);
  EXPECT_EQ(front.alpha, 1);
  EXPECT_NEAR(closed_form.integrate(1, 0, 1).g, 1 - 1e-6, 1e-7);
  EXPECT_FLOAT_EQ(closed_form.optical_depth(0, 1, 1), 1e6f);
}

TEST(ClosedForm, stays_finite_for_every_finite_input) {
  constexpr float largest = std::numeric_limits<float>::max();
  constexpr float smallest = std::numeric_limits<float>::denorm_min();
  const TransferFunction function{{{-largest, {largest, {largest, 0, 1}}},
                                   {0, {0, {0, largest, 1}}},
                                   {smallest, {largest, {1, 0, largest}}},
                                   {largest, {smallest, {largest, smallest, 0}}}}};
  const ClosedForm closed_form(function);
  const std::array<float, 7> scalars{-largest, -1, 0, smallest, 2 * smallest, 1, largest};
  for (const float s_in : scalars) {
    for (const float s_out : scalars) {
      for (const float length : {smallest, 1.0f, largest}) {
        const SegmentColor color = closed_form.integrate(s_in, s_out, length);
        for (const float value : {color.r, color.g, color.b, color.alpha}) {
          EXPECT_TRUE(std::isfinite(value)) << s_in << ' ' << s_out << ' ' << length;
          EXPECT_GE(value, 0) << s_in << ' ' << s_out << ' ' << length;
        }
        EXPECT_LE(color.alpha, 1);
        EXPECT_TRUE(std::isfinite(closed_form.optical_depth(s_in, s_out, length)));
      }
    }
  }
}

/// A transfer function with knots at multiples of 1/16, so that steps and shared knots are common.
TransferFunction any_function() {
  TransferFunction function;
  const auto count = *rc::gen::inRange<int>(1, 13);
  int position = 0;
  int equal = 1;
  for (int i = 0; i < count; ++i) {
    int gap = *rc::gen::inRange(0, 4);
    if (gap == 0 && equal == 2) gap = 1;
    equal = gap == 0 && i > 0 ? 2 : 1;
    position += gap;
    Optics optics;
    const int exponent = *rc::gen::inRange(-4, 5);
    optics.extinction = *rc::gen::inRange(0, 4) == 0 ? 0.0f : std::pow(10.0f, exponent / 2.0f);
    for (float& channel : optics.color) channel = *rc::gen::inRange(0, 17) / 16.0f;
    function.knots.push_back({position / 16.0f, optics});
  }
  RC_ASSERT(!function.problem());
  return function;
}

/// On the same grid of sixteenths, or between.
float any_scalar() { return *rc::gen::inRange(-64, 700) / 256.0f; }

RC_GTEST_PROP(ClosedFormProperty, two_halves_composite_to_the_whole, ()) {
  const TransferFunction function = any_function();
  const ClosedForm closed_form(function);
  const float s_in = any_scalar();
  const float s_out = any_scalar();
  const float length = *rc::gen::inRange(1, 1000) / 64.0f;
  // Quarters, which floats split without rounding.
  const float part = *rc::gen::inRange(1, 4) / 4.0f;
  const float s_middle = s_in + (s_out - s_in) * part;
  Compositor compositor;
  compositor.add(closed_form.integrate(s_in, s_middle, length * part));
  compositor.add(closed_form.integrate(s_middle, s_out, length - length * part));
  const SegmentColor whole = closed_form.integrate(s_in, s_out, length);
  auto single = [](double value) { return static_cast<float>(value); };
  const SegmentColor parts{single(compositor.rgb[0]), single(compositor.rgb[1]),
                           single(compositor.rgb[2]), single(compositor.alpha())};
  // Twice the bound of one segment, and the compositor's rounding.
  RC_ASSERT(distance(parts, whole) <= 3e-7f);
}

RC_GTEST_PROP(ClosedFormProperty, reversal_keeps_opacity, ()) {
  const TransferFunction function = any_function();
  const ClosedForm closed_form(function);
  const float s_in = any_scalar();
  const float s_out = any_scalar();
  const float length = *rc::gen::inRange(1, 1000) / 64.0f;
  const SegmentColor forward = closed_form.integrate(s_in, s_out, length);
  const SegmentColor backward = closed_form.integrate(s_out, s_in, length);
  RC_ASSERT(std::abs(forward.alpha - backward.alpha) <= 1.2e-7f);
  RC_ASSERT(closed_form.optical_depth(s_in, s_out, length) ==
            closed_form.optical_depth(s_out, s_in, length));
}

RC_GTEST_PROP(ClosedFormProperty, equals_the_oracle, ()) {
  const TransferFunction function = any_function();
  const float s_in = any_scalar();
  const float s_out = any_scalar();
  const float length = *rc::gen::inRange(1, 1000) / 64.0f;
  const auto expected = reference::integrate_linear(function, s_in, s_out, length, 1e-10);
  RC_ASSERT(distance(ClosedForm(function).integrate(s_in, s_out, length), expected) <= 1e-7);
}

}  // namespace
}  // namespace plume
