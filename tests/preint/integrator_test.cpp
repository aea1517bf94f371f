#include "plume/preint/integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "plume/tests/preint/transfer_functions.h"

namespace plume {
namespace {

SegmentColor integrate(const Integrator& integrator, float s_in, float s_out, float length) {
  return std::visit([&](const auto& chosen) { return chosen.integrate(s_in, s_out, length); },
                    integrator);
}

std::vector<Integrator> all_integrators(const TransferFunction& function) {
  return {make_integrator(function, {IntegratorKind::midpoint, 256, {}}),
          make_integrator(function, {IntegratorKind::table, 1, {256, 64, {}, {}}}),
          make_integrator(function, {IntegratorKind::closed_form, 1, {}})};
}

TEST(Integrator, is_of_the_kind_asked_for) {
  const auto integrators = all_integrators(tests::smooth_function());
  ASSERT_TRUE(std::holds_alternative<MidpointIntegrator>(integrators[0]));
  EXPECT_EQ(std::get<MidpointIntegrator>(integrators[0]).samples(), 256);
  ASSERT_TRUE(std::holds_alternative<PreintegratedTable>(integrators[1]));
  EXPECT_EQ(std::get<PreintegratedTable>(integrators[1]).bytes(), 256u * 256 * 64 * 16);
  EXPECT_TRUE(std::holds_alternative<ClosedForm>(integrators[2]));
  EXPECT_TRUE(std::holds_alternative<ClosedForm>(make_integrator(tests::smooth_function())));
}

TEST(Integrator, all_agree_on_a_smooth_function) {
  const auto integrators = all_integrators(tests::smooth_function());
  std::mt19937_64 random(13);
  std::uniform_real_distribution<float> scalar(-0.2f, 1.2f);
  for (int i = 0; i < 500; ++i) {
    const float s_in = scalar(random);
    const float s_out = scalar(random);
    const float length = tests::random_length(random, 1e-3f, 10);
    const SegmentColor expected = integrate(integrators[2], s_in, s_out, length);
    for (const std::size_t kind : {0u, 1u}) {
      const SegmentColor color = integrate(integrators[kind], s_in, s_out, length);
      // Errors of 256 samples and of a 256 x 256 x 64 table on this function.
      EXPECT_NEAR(color.r, expected.r, 4e-3f) << kind;
      EXPECT_NEAR(color.g, expected.g, 4e-3f) << kind;
      EXPECT_NEAR(color.b, expected.b, 4e-3f) << kind;
      EXPECT_NEAR(color.alpha, expected.alpha, 4e-3f) << kind;
    }
  }
}

TEST(Integrator, all_are_transparent_on_an_empty_segment) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
  for (const Integrator& integrator : all_integrators(tests::smooth_function())) {
    std::vector<SegmentColor> colors{integrate(integrator, 0.2f, 0.8f, 0)};
    for (const float bad : {not_a_number, infinity, -infinity}) {
      colors.push_back(integrate(integrator, bad, 0.5f, 1));
      colors.push_back(integrate(integrator, 0.5f, bad, 1));
      colors.push_back(integrate(integrator, bad, bad, 1));
      const float depth = std::visit(
          [&](const auto& chosen) { return chosen.optical_depth(0.5f, bad, 1); }, integrator);
      EXPECT_EQ(depth, 0) << integrator.index();
    }
    for (const SegmentColor& color : colors) {
      EXPECT_EQ(color.r, 0) << integrator.index();
      EXPECT_EQ(color.g, 0) << integrator.index();
      EXPECT_EQ(color.b, 0) << integrator.index();
      EXPECT_EQ(color.alpha, 0) << integrator.index();
    }
  }
}

}  // namespace
}  // namespace plume
