#include "plume/preint/preintegrated_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "plume/tests/preint/transfer_functions.h"

namespace plume {
namespace {

float distance(const SegmentColor& first, const SegmentColor& second) {
  return std::max({std::abs(first.r - second.r), std::abs(first.g - second.g),
                   std::abs(first.b - second.b), std::abs(first.alpha - second.alpha)});
}

/// The largest error against the closed form over 20,000 random segments inside the table.
float largest_error(const TransferFunction& function, const TableSettings& settings) {
  const PreintegratedTable table(function, settings);
  const ClosedForm closed_form(function);
  const auto [shortest, longest] = table.length_range();
  std::uniform_real_distribution<float> scalar(function.knots.front().scalar,
                                               function.knots.back().scalar);
  std::mt19937_64 random(10);
  float largest = 0;
  for (int i = 0; i < 20000; ++i) {
    const float s_in = scalar(random);
    const float s_out = scalar(random);
    const float length = tests::random_length(random, shortest / 100, longest);
    largest = std::max(largest, distance(table.integrate(s_in, s_out, length),
                                         closed_form.integrate(s_in, s_out, length)));
  }
  return largest;
}

TEST(PreintegratedTable, error_falls_with_its_size) {
  const TransferFunction function = tests::smooth_function();
  const float small = largest_error(function, {16, 8, {}, {}});
  const float medium = largest_error(function, {64, 32, {}, {}});
  const float large = largest_error(function, {128, 128, {}, {}});
  RecordProperty("error_16_8", std::to_string(small));
  RecordProperty("error_64_32", std::to_string(medium));
  RecordProperty("error_128_128", std::to_string(large));
  EXPECT_LT(small, 0.2f);
  EXPECT_LT(medium, small / 4);
  EXPECT_LT(large, medium / 2);
}

TEST(PreintegratedTable, is_right_at_its_entries) {
  const TransferFunction function = tests::smooth_function();
  const PreintegratedTable table(function, {17, 9, {}, std::array{0.125f, 32.0f}});
  const ClosedForm closed_form(function);
  for (int front = 0; front <= 16; ++front) {
    for (int back = 0; back <= 16; ++back) {
      for (const float length : {0.125f, 0.25f, 4.0f, 32.0f}) {
        EXPECT_LE(distance(table.integrate(front / 16.0f, back / 16.0f, length),
                           closed_form.integrate(front / 16.0f, back / 16.0f, length)),
                  1e-6f)
            << front << ' ' << back << ' ' << length;
      }
    }
  }
}

TEST(PreintegratedTable, scales_what_is_shorter_than_its_shortest) {
  const TransferFunction function = tests::smooth_function();
  const PreintegratedTable table(function, {17, 9, {}, std::array{1e-3f, 10.0f}});
  const ClosedForm closed_form(function);
  for (const float length : {1e-4f, 1e-6f, 1e-20f}) {
    const SegmentColor found = table.integrate(0.25f, 0.75f, length);
    const SegmentColor exact = closed_form.integrate(0.25f, 0.75f, length);
    // The optical depth of the shortest is 3e-3; the error in colour is a fraction of it.
    EXPECT_NEAR(found.r, exact.r, 1e-3f * exact.r);
    EXPECT_NEAR(found.b, exact.b, 1e-3f * exact.b);
    EXPECT_NEAR(found.alpha, exact.alpha, 1e-6f * exact.alpha);
  }
}

TEST(PreintegratedTable, answers_by_the_closed_form_where_it_does_not_reach) {
  const TransferFunction function = tests::smooth_function();
  const PreintegratedTable table(function, {4, 2, {}, std::array{0.1f, 1.0f}});
  const ClosedForm closed_form(function);
  EXPECT_EQ(distance(table.integrate(-1, 0.5f, 1), closed_form.integrate(-1, 0.5f, 1)), 0);
  EXPECT_EQ(distance(table.integrate(0.5f, 1.5f, 1), closed_form.integrate(0.5f, 1.5f, 1)), 0);
  EXPECT_EQ(distance(table.integrate(0.1f, 0.9f, 1.5f), closed_form.integrate(0.1f, 0.9f, 1.5f)),
            0);
  // Inside, a table this coarse is not it.
  EXPECT_GT(distance(table.integrate(0.1f, 0.9f, 0.5f), closed_form.integrate(0.1f, 0.9f, 0.5f)),
            1e-3f);
}

TEST(PreintegratedTable, needs_no_table_for_one_knot_or_no_extinction) {
  const PreintegratedTable one_knot(tests::single_knot_function());
  EXPECT_EQ(one_knot.bytes(), 0u);
  EXPECT_NEAR(one_knot.integrate(0, 1, 0.5f).alpha, -std::expm1(-1.0), 1e-7);
  EXPECT_NEAR(one_knot.integrate(0.5f, 0.5f, 0.5f).alpha, -std::expm1(-1.0), 1e-7);
  const PreintegratedTable clear(tests::scaled_smooth_function(0));
  EXPECT_EQ(clear.bytes(), 0u);
  EXPECT_EQ(clear.integrate(0, 0, 1).alpha, 0);
}

TEST(PreintegratedTable, lends_no_colour_from_where_there_is_no_extinction) {
  // Vivid green without extinction; then grey. Between the entries there must be no green.
  const TransferFunction function{{{0, {0, {0, 1, 0}}},
                                   {0.5f, {0, {0, 1, 0}}},
                                   {0.5f, {1, {0.5f, 0.5f, 0.5f}}},
                                   {1, {1, {0.5f, 0.5f, 0.5f}}}}};
  const PreintegratedTable table(function, {32, 16, {}, {}});
  std::mt19937_64 random(12);
  std::uniform_real_distribution<float> scalar(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const SegmentColor color =
        table.integrate(scalar(random), scalar(random), tests::random_length(random, 0.01f, 10));
    EXPECT_NEAR(color.g, color.r, 1e-6f);
    EXPECT_NEAR(color.g, 0.5f * color.alpha, 1e-6f);
  }
}

TEST(PreintegratedTable, reports_its_memory) {
  EXPECT_EQ(PreintegratedTable(tests::smooth_function()).bytes(), 128u * 128 * 32 * 16);
  EXPECT_EQ(PreintegratedTable(tests::smooth_function(), {8, 4, {}, {}}).bytes(), 8u * 8 * 4 * 16);
}

TEST(PreintegratedTable, optical_depth_is_exact) {
  const TransferFunction function = tests::spike_function();
  EXPECT_EQ(PreintegratedTable(function, {4, 2, {}, {}}).optical_depth(0.4f, 0.6f, 2),
            ClosedForm(function).optical_depth(0.4f, 0.6f, 2));
}

}  // namespace
}  // namespace plume
