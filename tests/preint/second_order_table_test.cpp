// The table of second order, and what it gains over linear parts.

#include "plume/preint/second_order_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "plume/preint/compositing.h"
#include "plume/preint/preintegrated_table.h"
#include "plume/tests/preint/curved_segments.h"
#include "plume/tests/preint/transfer_functions.h"

namespace plume {
namespace {

template <class First, class Second>
double distance(const First& first, const Second& second) {
  return std::max({std::abs(first.r - second.r), std::abs(first.g - second.g),
                   std::abs(first.b - second.b), std::abs(first.alpha - second.alpha)});
}

SegmentColor oracle(const TransferFunction& function, const ScalarPolynomial& scalar,
                    double length) {
  const auto sum = tests::oracle(function, scalar, length, 1e-9);
  return {static_cast<float>(sum.rgb[0]), static_cast<float>(sum.rgb[1]),
          static_cast<float>(sum.rgb[2]), static_cast<float>(sum.alpha)};
}

constexpr std::array<float, 2> kLengths{0.01f, 10};

TEST(SecondOrderTable, is_right_at_its_entries) {
  const TransferFunction function = tests::smooth_function();
  const SecondOrderTable table(function, {9, 3, {}, std::array{0.25f, 4.0f}});
  for (int front = 0; front <= 8; front += 2) {
    for (int middle = 0; middle <= 8; ++middle) {
      for (int back = 0; back <= 8; back += 4) {
        const auto scalar = ScalarPolynomial::quadratic(front / 8.0, middle / 8.0, back / 8.0);
        for (const float length : {0.25f, 1.0f, 4.0f}) {
          ASSERT_LE(distance(table.integrate(scalar, length), oracle(function, scalar, length)),
                    2e-5)
              << front << ' ' << middle << ' ' << back << ' ' << length;
        }
      }
    }
  }
}

TEST(SecondOrderTable, error_falls_with_its_size) {
  const TransferFunction function = tests::smooth_function();
  const auto report = [&](int scalars, int lengths) {
    return SecondOrderTable(function, {scalars, lengths, {}, kLengths}).report();
  };
  const TableReport small = report(6, 6), medium = report(12, 12), large = report(24, 24);
  EXPECT_LT(small.largest_error, 0.3f);
  EXPECT_LT(medium.rms_error, small.rms_error / 3);
  EXPECT_LT(large.rms_error, medium.rms_error / 3);
  EXPECT_EQ(small.bytes, 6u * 6 * 6 * 6 * 16);
  EXPECT_GT(small.build_seconds, 0);
  // Nothing but interpolation: a colour and an extinction without knots are exact.
  const TransferFunction even{{{0, {2, {0.25f, 0.5f, 1}}}, {1, {2, {0.25f, 0.5f, 1}}}}};
  EXPECT_LT(SecondOrderTable(even, {4, 4, {}, {}}).report().largest_error, 2e-6f);
}

TEST(SecondOrderTable, of_a_constant_length_has_three_axes) {
  const TransferFunction function = tests::smooth_function();
  SecondOrderTableSettings settings{9, 16, {}, {}, 0.5f};
  const SecondOrderTable table(function, settings);
  EXPECT_EQ(table.report().bytes, 9u * 9 * 9 * 16);
  const auto scalar = ScalarPolynomial::quadratic(0.125, 0.75, 0.5);
  EXPECT_LE(distance(table.integrate(scalar, 0.5f), oracle(function, scalar, 0.5)), 2e-5);
  // Of another length, the opacity.
  EXPECT_NEAR(table.integrate(scalar, 3).alpha, oracle(function, scalar, 3).alpha, 1e-6);
  settings.scalar_count = 33;
  EXPECT_LT(SecondOrderTable(function, settings).report().largest_error,
            table.report().largest_error / 6);
}

TEST(SecondOrderTable, answers_exactly_where_it_does_not_reach) {
  const TransferFunction function = tests::smooth_function();
  const SecondOrderTable table(function, {3, 2, {}, std::array{0.1f, 1.0f}});
  const AdaptiveIntegrator exact(function);
  const auto outside = ScalarPolynomial::quadratic(0.2f, 1.3f, 0.4f);
  EXPECT_LE(distance(table.integrate(outside, 0.5f), exact.integrate(outside, 0.5f)), 2e-7);
  const auto inside = ScalarPolynomial::quadratic(0.2f, 0.9f, 0.4f);
  EXPECT_LE(distance(table.integrate(inside, 2), exact.integrate(inside, 2)), 2e-7);
  EXPECT_GT(distance(table.integrate(inside, 0.5f), exact.integrate(inside, 0.5f)), 1e-3);
  // Linear segments, and optical depths, never need it.
  const ClosedForm closed_form(function);
  EXPECT_EQ(distance(table.integrate(0.2f, 0.9f, 0.5f), closed_form.integrate(0.2f, 0.9f, 0.5f)),
            0);
  EXPECT_EQ(table.optical_depth(inside, 0.5f), exact.optical_depth(inside, 0.5f));
  const SecondOrderTable none(tests::single_knot_function());
  EXPECT_EQ(none.report().bytes, 0u);
  EXPECT_NEAR(none.integrate(inside, 0.5f).alpha, -std::expm1(-1.0), 1e-7);
}

TEST(SecondOrderTable, is_transparent_where_a_value_is_not_finite) {
  const SecondOrderTable table(tests::smooth_function(), {3, 2, {}, {}});
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(table.integrate(ScalarPolynomial::quadratic(0.1, bad, 0.4), 1).alpha, 0);
    EXPECT_EQ(table.integrate(ScalarPolynomial::quadratic(bad, 0.2, 0.4), 1).alpha, 0);
  }
}

// El Hajjar et al., figures 7 to 9: with half of the samples second order is nearer than first,
// where the scalar along a ray is quadratic: then it is exact but for its table.
TEST(SecondOrderTable, is_better_at_twice_the_step_on_quadratic_scalars) {
  const TransferFunction function = tests::smooth_function();
  constexpr double length = 32;  // in the paper's unit, voxels
  std::mt19937_64 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<ScalarPolynomial> rays;
  while (rays.size() < 24) {
    const auto ray = ScalarPolynomial::quadratic(unit(random), unit(random), unit(random));
    double low = 0, high = 1;
    for (int i = 0; i <= 64; ++i) {
      low = std::min(low, ray(i / 64.0));
      high = std::max(high, ray(i / 64.0));
    }
    if (low == 0 && high == 1) rays.push_back(ray);
  }
  // Steps of 4 and 2 voxels by first order, slabs of twice two such steps by second. Of steps of
  // one voxel first order is nearer than what this table resolves: that takes one of 96^3
  // (docs/integrators.md).
  for (const int samples : {8, 16}) {
    const double step = length / samples;
    const PreintegratedTable first(function,
                                   {256, 2, std::array{0.0f, 1.0f}, {}, static_cast<float>(step)});
    const SecondOrderTable second(
        function, {64, 2, std::array{0.0f, 1.0f}, {}, static_cast<float>(4 * step)});
    double of_first = 0, of_second = 0;
    for (const ScalarPolynomial& ray : rays) {
      const SegmentColor expected = oracle(function, ray, length);
      const auto at = [&](int i) { return static_cast<float>(ray(i * step / length)); };
      Compositor by_first, by_second;
      for (int i = 0; i < samples; ++i)
        by_first.add(first.integrate(at(i), at(i + 1), static_cast<float>(step)));
      for (int i = 0; i < samples; i += 4)
        by_second.add(second.integrate(ScalarPolynomial::quadratic(at(i), at(i + 2), at(i + 4)),
                                       static_cast<float>(4 * step)));
      const auto squared = [&](const Compositor& sum) {
        const double off =
            std::max({std::abs(sum.rgb[0] - expected.r), std::abs(sum.rgb[1] - expected.g),
                      std::abs(sum.rgb[2] - expected.b), std::abs(sum.alpha() - expected.alpha)});
        return off * off;
      };
      of_first += squared(by_first);
      of_second += squared(by_second);
    }
    EXPECT_LT(of_second, of_first) << samples;
    RecordProperty("ratio_" + std::to_string(samples),
                   std::to_string(std::sqrt(of_second / of_first)));
  }
}

// Likewise where a smooth scalar is resolved.
TEST(SecondOrderTable, is_better_at_twice_the_step_than_first_order) {
  const TransferFunction function = tests::smooth_function();
  const auto scalar_at = [](double t) {
    return 0.5 + 0.3 * std::sin(5 * t + 1) + 0.15 * std::cos(8 * t);
  };
  constexpr double length = 2;
  const auto expected = tests::oracle(
      function, [&](double u) { return scalar_at(u * length); }, length);
  // Fewer than 32 do not resolve the scalar, whatever is made of them.
  for (const int samples : {32, 64}) {
    const double step = length / samples;
    const PreintegratedTable first(function, {256, 2, {}, {}, static_cast<float>(step)});
    // Slabs of two steps, each of which is twice the first order's.
    const SecondOrderTable second(function, {64, 2, {}, {}, static_cast<float>(4 * step)});
    Compositor by_first, by_second;
    const auto at = [&](int i) { return static_cast<float>(scalar_at(i * step)); };
    for (int i = 0; i < samples; ++i)
      by_first.add(first.integrate(at(i), at(i + 1), static_cast<float>(step)));
    for (int i = 0; i < samples; i += 4)
      by_second.add(second.integrate(ScalarPolynomial::quadratic(at(i), at(i + 2), at(i + 4)),
                                     static_cast<float>(4 * step)));
    const auto error = [&](const Compositor& sum) {
      return std::max(
          {std::abs(sum.rgb[0] - expected.rgb[0]), std::abs(sum.rgb[1] - expected.rgb[1]),
           std::abs(sum.rgb[2] - expected.rgb[2]), std::abs(sum.alpha() - expected.alpha)});
    };
    EXPECT_LT(error(by_second), error(by_first)) << samples;
    RecordProperty("first_" + std::to_string(samples), std::to_string(error(by_first)));
    RecordProperty("second_" + std::to_string(samples), std::to_string(error(by_second)));
  }
}

}  // namespace
}  // namespace plume
