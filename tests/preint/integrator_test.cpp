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

// Built once, as the larger tables take their time.
const std::vector<Integrator>& all_integrators() {
  static const TransferFunction function = tests::smooth_function();
  static const std::vector<Integrator> made{
      make_integrator(function, {IntegratorKind::midpoint, 256, {}}),
      make_integrator(function, {IntegratorKind::table, 1, {256, 64, {}, {}}}),
      make_integrator(function, {IntegratorKind::closed_form, 1, {}}),
      make_integrator(function, {IntegratorKind::second_order_table, 1, {}, {8, 4}}),
      make_integrator(function, {IntegratorKind::reference, 1, {}, {}, 1e-8})};
  return made;
}

TEST(Integrator, is_of_the_kind_asked_for) {
  const auto& integrators = all_integrators();
  ASSERT_TRUE(std::holds_alternative<MidpointIntegrator>(integrators[0]));
  EXPECT_EQ(std::get<MidpointIntegrator>(integrators[0]).samples(), 256);
  ASSERT_TRUE(std::holds_alternative<PreintegratedTable>(integrators[1]));
  EXPECT_EQ(std::get<PreintegratedTable>(integrators[1]).bytes(), 256u * 256 * 64 * 16);
  EXPECT_TRUE(std::holds_alternative<ClosedForm>(integrators[2]));
  EXPECT_TRUE(std::holds_alternative<ClosedForm>(make_integrator(tests::smooth_function())));
  ASSERT_TRUE(std::holds_alternative<SecondOrderTable>(integrators[3]));
  EXPECT_EQ(std::get<SecondOrderTable>(integrators[3]).report().bytes, 8u * 8 * 8 * 4 * 16);
  ASSERT_TRUE(std::holds_alternative<AdaptiveIntegrator>(integrators[4]));
  EXPECT_EQ(std::get<AdaptiveIntegrator>(integrators[4]).tolerance(), 1e-8);
}

TEST(Integrator, all_agree_on_a_smooth_function) {
  const auto& integrators = all_integrators();
  std::mt19937_64 random(13);
  std::uniform_real_distribution<float> scalar(-0.2f, 1.2f);
  for (int i = 0; i < 500; ++i) {
    const float s_in = scalar(random);
    const float s_out = scalar(random);
    const float length = tests::random_length(random, 1e-3f, 10);
    const SegmentColor expected = integrate(integrators[2], s_in, s_out, length);
    for (const std::size_t kind : {0u, 1u, 3u, 4u}) {
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
  for (const Integrator& integrator : all_integrators()) {
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

TEST(Integrator, settings_say_what_is_wrong_with_what_is_read) {
  IntegratorSettings settings;
  settings.samples = 0;
  settings.table.scalar_count = 0;
  settings.second_order_table.scalar_count = 1;
  settings.tolerance = 0;
  EXPECT_FALSE(settings.problem());  // the closed form reads none of it
  settings.kind = IntegratorKind::midpoint;
  EXPECT_EQ(*settings.problem(), "0 samples per segment: at least 1");
  settings.kind = IntegratorKind::table;
  EXPECT_EQ(*settings.problem(), "a table of 0 scalars and 32 lengths: at least 2 of each");
  settings.kind = IntegratorKind::second_order_table;
  EXPECT_EQ(*settings.problem(), "a table of 1 scalars and 24 lengths: at least 2 of each");
  settings.kind = IntegratorKind::reference;
  EXPECT_EQ(*settings.problem(), "a reference to a tolerance of 0: it must be 1e-13 to 1");
}

}  // namespace
}  // namespace plume
