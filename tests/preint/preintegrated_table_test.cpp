#include "plume/preint/preintegrated_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

TEST(PreintegratedTable, is_right_at_its_entries_however_it_was_summed) {
  // Many knots between two entries, steps, optical depths from 1e-5 to 1e4: the windows' sums.
  for (const auto& [name, function] : tests::all_functions()) {
    const PreintegratedTable table(function,
                                   {29, 4, std::array{0.0f, 1.0f}, std::array{1e-3f, 1e3f}});
    const ClosedForm closed_form(function);
    for (std::size_t level = 0; level < 4; ++level) {
      const auto length = static_cast<float>(std::exp2(table.length_axis().value(level)));
      for (std::size_t front = 0; front < table.scalar_axis().count; ++front) {
        for (std::size_t back = 0; back < table.scalar_axis().count; ++back) {
          const auto s_in = static_cast<float>(table.scalar_axis().value(front));
          const auto s_out = static_cast<float>(table.scalar_axis().value(back));
          if (function.knots.size() > 3 && (s_in == 0.25f || s_in == 0.5f || s_in == 0.75f ||
                                            s_out == 0.25f || s_out == 0.5f || s_out == 0.75f))
            continue;  // at a step a float beside the entry's double sees its other side
          ASSERT_LE(distance(table.entries()[(level * 29 + back) * 29 + front].color(length),
                             closed_form.integrate(s_in, s_out, length)),
                    // The scalar's rounding, where the spike rises by 1e10 a unit.
                    name == "narrow spike" ? 2e-3f : 2e-5f)
              << name << ": " << s_in << " to " << s_out << " over " << length;
        }
      }
    }
  }
}

TEST(PreintegratedTable, of_a_constant_length_has_two_axes) {
  const TransferFunction function = tests::smooth_function();
  TableSettings settings{65, 32, {}, {}, 0.5f};
  const PreintegratedTable table(function, settings);
  EXPECT_EQ(table.bytes(), 65u * 65 * 16);
  const ClosedForm closed_form(function);
  for (int front = 0; front <= 64; ++front)
    for (int back = 0; back <= 64; ++back)
      ASSERT_LE(distance(table.integrate(front / 64.0f, back / 64.0f, 0.5f),
                         closed_form.integrate(front / 64.0f, back / 64.0f, 0.5f)),
                1e-6f);
  // Of another length it knows the opacity, at its entries; its colour is that of its own length.
  for (const float length : {0.01f, 0.25f, 3.0f, 1e4f}) {
    const SegmentColor found = table.integrate(0.25f, 0.75f, length);
    const SegmentColor own = table.integrate(0.25f, 0.75f, 0.5f);
    EXPECT_NEAR(found.alpha, closed_form.integrate(0.25f, 0.75f, length).alpha, 1e-6f);
    EXPECT_NEAR(found.r, own.r / own.alpha * found.alpha, 1e-6f);
  }
  // It converges with its size, at its length: by 64 where it is of second order, by 8 beside
  // knots, where it is of first.
  settings.scalar_count = 33;
  const float coarse = PreintegratedTable(function, settings).report().largest_error;
  settings.scalar_count = 257;
  const float fine = PreintegratedTable(function, settings).report().largest_error;
  EXPECT_LT(fine, coarse / 16);
}

TEST(PreintegratedTable, reports_an_error_that_others_find_too) {
  for (const auto& function : {tests::smooth_function(), tests::random_function(3, 12, 5)}) {
    const PreintegratedTable table(function, {32, 16, {}, {}});
    const TableReport& report = table.report();
    EXPECT_GT(report.build_seconds, 0);
    EXPECT_GT(report.rms_error, 0);
    EXPECT_GT(report.largest_error, report.rms_error);
    const ClosedForm closed_form(function);
    const float low = function.knots.front().scalar, high = function.knots.back().scalar;
    std::mt19937_64 random(14);
    std::uniform_real_distribution<float> scalar(low, high);
    double squares = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
      const float s_in = scalar(random), s_out = scalar(random);
      const float length =
          tests::random_length(random, table.length_range()[0], table.length_range()[1]);
      const SegmentColor found = table.integrate(s_in, s_out, length);
      const SegmentColor exact = closed_form.integrate(s_in, s_out, length);
      for (const double d :
           {found.r - exact.r, found.g - exact.g, found.b - exact.b, found.alpha - exact.alpha})
        squares += d * d;
    }
    EXPECT_NEAR(report.rms_error, std::sqrt(squares / (4 * count)), 0.15 * report.rms_error);
  }
}

TEST(PreintegratedTable, names_what_is_wrong_with_its_settings) {
  using Range = std::array<float, 2>;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(TableSettings{}.problem());
  EXPECT_EQ(*(TableSettings{1, 8, {}, {}}).problem(),
            "a table of 1 scalars and 8 lengths: at least 2 of each");
  EXPECT_EQ(*(TableSettings{8, 8, Range{2, 1}, {}}).problem(),
            "a table of scalars from 2 to 1: both must be finite, and ascend");
  for (const float bad : {infinity, -infinity, not_a_number}) {
    EXPECT_TRUE((TableSettings{8, 8, Range{0, bad}, {}}).problem()) << bad;
    EXPECT_TRUE((TableSettings{8, 8, Range{bad, 0}, {}}).problem()) << bad;
    EXPECT_TRUE((TableSettings{8, 8, {}, Range{1, bad}}).problem()) << bad;
    EXPECT_TRUE((TableSettings{8, 8, {}, {}, bad}).problem()) << bad;
  }
  EXPECT_EQ(*(TableSettings{8, 8, {}, Range{0, 1}}).problem(),
            "a table of lengths from 0 to 1: both must be finite, above 0, and ascend");
  EXPECT_EQ(*(TableSettings{8, 8, {}, {}, 0.0f}).problem(),
            "a table of segments of length 0: it must be finite and above 0");
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
