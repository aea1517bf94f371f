#include "plume/preint/optics_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "plume/preint/closed_form.h"
#include "plume/tests/preint/seeded_rapidcheck.h"
#include "plume/tests/reference/adaptive_quadrature.h"

namespace plume {
namespace {

double mixed(double front, double back, double u) { return (1 - u) * front + u * back; }

// The same media for the oracle, as functions of the distance.
reference::Radiance expected(const std::vector<LinearOptics>& media, double length) {
  reference::Medium medium;
  medium.length = length;
  medium.extinction = [&](double t) {
    double sum = 0;
    for (const LinearOptics& m : media)
      sum += mixed(m.front.extinction, m.back.extinction, t / length);
    return sum;
  };
  medium.color = [&](double t) {
    std::array<double, 3> sum{0, 0, 0};
    for (std::size_t c = 0; c < 3; ++c)
      for (const LinearOptics& m : media)
        sum[c] += mixed(m.front.extinction, m.back.extinction, t / length) *
                  mixed(m.front.color[c], m.back.color[c], t / length);
    const double extinction = medium.extinction(t);
    for (double& channel : sum) channel = extinction > 0 ? channel / extinction : 0;
    return sum;
  };
  return reference::integrate(medium, 1e-12);
}

double distance(const PreciseColor& color, const reference::Radiance& other) {
  double worst = std::abs(color.alpha - other.alpha);
  for (std::size_t c = 0; c < 3; ++c)
    worst = std::max(worst, std::abs(color.rgb[c] - other.rgb[c]));
  return worst;
}

// A tenth of the ends are transparent; extinction spans six orders of magnitude.
PreciseOptics random_optics(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  PreciseOptics optics;
  if (unit(random) > 0.1) optics.extinction = std::pow(10, 6 * unit(random) - 3);
  for (double& channel : optics.color) channel = unit(random);
  return optics;
}

std::vector<LinearOptics> random_media(std::mt19937_64& random) {
  std::vector<LinearOptics> media(1 + random() % 4);
  for (LinearOptics& medium : media) medium = {random_optics(random), random_optics(random)};
  return media;
}

TEST(OpticsSum, equals_the_oracle) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto media = random_media(random);
    const double length = std::pow(10, 4 * unit(random) - 3);
    const double error = distance(integrate_sum(media, length), expected(media, length));
    // The closed form of one medium alone is good to 2e-9, the oracle here to 1e-12.
    ASSERT_LE(error, media.size() == 1 ? 1e-8 : 2e-12) << i;
    if (media.size() > 1) worst = std::max(worst, error);
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
}

TEST(OpticsSum, of_a_medium_in_shares_is_the_medium) {
  EXPECT_TRUE(rc::check("shares", [] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const LinearOptics whole{random_optics(random), random_optics(random)};
    std::vector<LinearOptics> shares(3, whole);
    const std::array<double, 3> of{0.25, 0.25, 0.5};
    for (std::size_t i = 0; i < 3; ++i) {
      shares[i].front.extinction *= of[i];
      shares[i].back.extinction *= of[i];
    }
    const PreciseColor one = integrate_linear(whole.front, whole.back, 1.5);
    const PreciseColor sum = integrate_sum(shares, 1.5);
    for (std::size_t c = 0; c < 3; ++c) RC_ASSERT(std::abs(one.rgb[c] - sum.rgb[c]) < 1e-8);
    RC_ASSERT(std::abs(one.alpha - sum.alpha) < 1e-9);
  }));
}

TEST(OpticsSum, composites_where_it_is_cut) {
  EXPECT_TRUE(rc::check("cut", [] {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    std::vector<LinearOptics> media = random_media(random);
    media.push_back({random_optics(random), random_optics(random)});  // two at least
    const double at = std::uniform_real_distribution<double>(0, 1)(random);
    std::vector<LinearOptics> before, behind;
    for (const LinearOptics& medium : media) {
      before.push_back(medium.part(0, at));
      behind.push_back(medium.part(at, 1));
    }
    const PreciseColor whole = integrate_sum(media, 2);
    PreciseColor parts = integrate_sum(before, 2 * at);
    parts.add_behind(integrate_sum(behind, 2 * (1 - at)));
    for (std::size_t c = 0; c < 3; ++c) RC_ASSERT(std::abs(whole.rgb[c] - parts.rgb[c]) < 1e-12);
    RC_ASSERT(std::abs(whole.alpha - parts.alpha) < 1e-12);
  }));
}

TEST(OpticsSum, knows_extremes) {
  const LinearOptics nothing{};
  const std::vector<LinearOptics> clear{nothing, nothing};
  EXPECT_EQ(integrate_sum(clear, 1).alpha, 0);
  const LinearOptics wall{{1e30, {1, 0, 0}}, {1e30, {1, 0, 0}}};
  const LinearOptics rising{{0, {0, 1, 0}}, {1e35, {0, 1, 0}}};
  const LinearOptics falling{{1e35, {0, 1, 0}}, {0, {0, 1, 0}}};
  for (const auto& media : {std::vector{wall, wall}, {wall, nothing}, {nothing, wall}}) {
    const PreciseColor color = integrate_sum(media, 1e3);
    EXPECT_NEAR(color.rgb[0], 1, 1e-12);
    EXPECT_EQ(color.alpha, 1);
  }
  for (const auto& media : {std::vector{rising, nothing}, {falling, nothing}, {rising, falling}}) {
    EXPECT_NEAR(integrate_sum(media, 10).rgb[1], 1, 1e-12);
    EXPECT_EQ(integrate_sum(media, 0).alpha, 0);
  }
  // Relative accuracy where there is next to nothing.
  const LinearOptics haze{{1e-20, {1, 0.5, 0}}, {3e-20, {1, 0.5, 0}}};
  const std::vector<LinearOptics> two{haze, haze};
  EXPECT_NEAR(integrate_sum(two, 1).alpha, 4e-20, 1e-32);
  EXPECT_NEAR(integrate_sum(two, 1).rgb[1], 2e-20, 1e-32);
}

}  // namespace
}  // namespace plume
