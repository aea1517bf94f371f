#include "plume/preint/midpoint.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plume/preint/closed_form.h"
#include "plume/tests/preint/transfer_functions.h"

namespace plume {
namespace {

/// How far n samples are from the closed form, in green, on one segment.
double error_of(const TransferFunction& function, int samples, float s_in, float s_out) {
  const SegmentColor exact = ClosedForm(function).integrate(s_in, s_out, 1);
  return std::abs(MidpointIntegrator(function, samples).integrate(s_in, s_out, 1).g - exact.g);
}

TEST(MidpointIntegrator, is_exact_for_uniform_optics) {
  const TransferFunction function = tests::single_knot_function();
  for (const int samples : {1, 2, 7}) {
    const SegmentColor color = MidpointIntegrator(function, samples).integrate(0, 1, 0.5f);
    EXPECT_NEAR(color.alpha, -std::expm1(-1.0), 1e-7);
    EXPECT_NEAR(color.g, 0.6 * -std::expm1(-1.0), 1e-7);
  }
}

TEST(MidpointIntegrator, one_sample_sees_the_middle_only) {
  const TransferFunction function = tests::smooth_function();
  const Optics middle = function.at(0.5f);
  const SegmentColor color = MidpointIntegrator(function).integrate(0.375f, 0.625f, 0.3f);
  EXPECT_NEAR(color.alpha, -std::expm1(-0.3 * middle.extinction), 1e-7);
  EXPECT_NEAR(color.r, color.alpha * middle.color[0], 1e-7);
}

TEST(MidpointIntegrator, converges_at_second_order_between_knots) {
  const TransferFunction ramp{{{0, {0, {0, 0, 0}}}, {1, {5, {1, 1, 1}}}}};
  for (const int samples : {4, 8, 16, 32}) {
    const double ratio = error_of(ramp, samples, 0, 1) / error_of(ramp, 2 * samples, 0, 1);
    EXPECT_NEAR(ratio, 4, 0.2) << samples;
  }
}

TEST(MidpointIntegrator, converges_at_second_order_in_trend_across_knots) {
  const TransferFunction function = tests::smooth_function();
  double coarse = 0;
  double fine = 0;
  for (int i = 0; i < 20; ++i) {
    coarse += error_of(function, 8, 0.02f * i, 1);
    fine += error_of(function, 64, 0.02f * i, 1);
  }
  // 64 by the order; half of it, since the knots fall differently among the samples.
  EXPECT_LT(fine, coarse / 32);
}

TEST(MidpointIntegrator, converges_across_steps) {
  const TransferFunction function = tests::step_function();
  EXPECT_LT(error_of(function, 4096, 0.1f, 0.9f), 1e-3);
  EXPECT_GT(error_of(function, 1, 0.1f, 0.9f), 0.05);
}

TEST(MidpointIntegrator, alpha_belongs_to_its_optical_depth) {
  const MidpointIntegrator midpoint(tests::step_function(), 5);
  for (const float s_out : {0.0f, 0.3f, 0.6f, 1.0f}) {
    EXPECT_NEAR(midpoint.integrate(0.2f, s_out, 0.7f).alpha,
                -std::expm1(-static_cast<double>(midpoint.optical_depth(0.2f, s_out, 0.7f))), 1e-7);
  }
}

}  // namespace
}  // namespace plume
