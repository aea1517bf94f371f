#include "plume/preint/compositing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "plume/preint/closed_form.h"
#include "plume/tests/preint/transfer_functions.h"

namespace plume {
namespace {

TEST(Compositor, starts_with_nothing) {
  const Compositor compositor;
  EXPECT_EQ(compositor.alpha(), 0);
  EXPECT_EQ(compositor.rgb[0], 0);
  EXPECT_FALSE(compositor.opaque(0.999f));
}

TEST(Compositor, puts_later_segments_behind) {
  Compositor compositor;
  compositor.add({0.5f, 0, 0, 0.5f});
  compositor.add({0, 0.5f, 0, 0.5f});
  compositor.add({0, 0, 1, 1});
  compositor.add({9, 9, 9, 1});
  EXPECT_EQ(compositor.rgb, (std::array<double, 3>{0.5, 0.25, 0.25}));
  EXPECT_EQ(compositor.alpha(), 1);
  EXPECT_TRUE(compositor.opaque(0));
}

/// A ray of segments with scalars that wander through [0, 1].
std::vector<SegmentColor> random_ray(const ClosedForm& closed_form, std::mt19937_64& random) {
  std::vector<SegmentColor> ray;
  std::uniform_real_distribution<float> unit(0, 1);
  float scalar = unit(random);
  for (int i = 0; i < 200; ++i) {
    const float next = std::clamp(scalar + 0.1f * (unit(random) - 0.5f), 0.0f, 1.0f);
    ray.push_back(closed_form.integrate(scalar, next, 0.05f * unit(random)));
    scalar = next;
  }
  return ray;
}

TEST(Compositor, early_termination_errs_by_its_threshold_at_most) {
  const ClosedForm closed_form(tests::smooth_function());
  std::mt19937_64 random(8);
  int terminated = 0;
  for (const float threshold : {0.5f, 0.1f, 1e-2f, 1e-3f}) {
    for (int i = 0; i < 50; ++i) {
      Compositor whole;
      Compositor early;
      for (const SegmentColor& segment : random_ray(closed_form, random)) {
        whole.add(segment);
        if (!early.opaque(threshold)) early.add(segment);
      }
      terminated += whole.transmittance < early.transmittance;
      EXPECT_LE(whole.alpha() - early.alpha(), threshold);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_GE(whole.rgb[channel], early.rgb[channel]);
        // Colours of the transfer function are at most 1.
        EXPECT_LE(whole.rgb[channel] - early.rgb[channel], threshold);
      }
    }
  }
  EXPECT_GT(terminated, 100);
}

TEST(Compositor, keeps_its_rounding_within_the_stated_bound) {
  Compositor compositor;
  double transmittance = 1;
  std::mt19937_64 random(9);
  for (int i = 1; i <= 1000; ++i) {
    const float alpha = tests::random_length(random, 1e-7f, 1e-2f);
    compositor.add({alpha, alpha, alpha, alpha});
    transmittance *= 1 - static_cast<double>(alpha);
    ASSERT_NEAR(compositor.transmittance, transmittance, 1e-15 * i);
  }
  EXPECT_NEAR(compositor.transmittance, transmittance, 1e-13);
  // White segments: what is not seen through is white.
  EXPECT_NEAR(compositor.rgb[0], compositor.alpha(), 1e-13);
}

}  // namespace
}  // namespace plume
