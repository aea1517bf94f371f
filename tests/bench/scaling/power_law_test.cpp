#include "plume/tests/bench/scaling/power_law.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace plume::bench {
namespace {

TEST(PowerLaw, FindsTheExponentOfOne) {
  std::vector<double> x, y;
  for (int i = 1; i <= 6; ++i) {
    x.push_back(std::pow(3.0, i));
    y.push_back(0.7 * std::pow(x.back(), 1.0 / 3));
  }
  const auto law = fit_power_law(x, y);
  ASSERT_TRUE(law && law->error);
  EXPECT_NEAR(law->exponent, 1.0 / 3, 1e-12);
  EXPECT_NEAR(law->factor, 0.7, 1e-12);
  EXPECT_NEAR(*law->error, 0, 1e-12);
  EXPECT_NEAR(law->least, 1.0 / 3, 1e-12);
  EXPECT_NEAR(law->most, 1.0 / 3, 1e-12);
}

// By hand: slopes 0 and 2 over equal steps; the middle is off the line by 2/3, the ends by 1/3.
TEST(PowerLaw, SaysHowFarPointsAreOffIt) {
  const double e = std::exp(1.0);
  const std::array x{1.0, e, e * e}, y{1.0, 1.0, e * e};
  const auto law = fit_power_law(x, y);
  ASSERT_TRUE(law && law->error);
  EXPECT_NEAR(law->exponent, 1, 1e-12);
  EXPECT_NEAR(*law->error, std::sqrt((4.0 / 9 + 2.0 / 9) / 1 / 2), 1e-12);
  EXPECT_NEAR(law->least, 0, 1e-12);
  EXPECT_NEAR(law->most, 2, 1e-12);
}

TEST(PowerLaw, HasNoErrorForTwoPointsAndNoLawForOneOrForZeros) {
  const std::array x{1.0, 2.0}, y{3.0, 12.0}, with_zero{0.0, 1.0};
  const auto law = fit_power_law(x, y);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 2, 1e-12);
  EXPECT_FALSE(law->error);
  EXPECT_FALSE(fit_power_law(std::span(x).first(1), std::span(y).first(1)));
  EXPECT_FALSE(fit_power_law(x, with_zero));
}

}  // namespace
}  // namespace plume::bench
