// Polynomials along segments: they are what was sampled, and their chords stay near.

#include "plume/preint/scalar_polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace plume {
namespace {

struct Cubic {
  double c[4];
  double operator()(double u) const { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); }
};

struct Sampled {
  Cubic truth;
  ScalarPolynomial polynomial;
};

// Polynomials of degree 2 and 3 with coefficients of any size and sign.
std::vector<Sampled> seeded_polynomials(int count) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Sampled> list;
  for (int i = 0; i < count; ++i) {
    const bool quadratic = i % 2 == 0;
    Cubic f{{uniform(random), uniform(random) * std::exp2(4 * uniform(random)),
             uniform(random) * std::exp2(4 * uniform(random)), uniform(random) * 8}};
    if (quadratic) f.c[3] = 0;
    auto at = [&](double u) { return static_cast<float>(f(u)); };
    list.push_back({f, quadratic
                           ? ScalarPolynomial::quadratic(at(0), at(0.5), at(1))
                           : ScalarPolynomial::cubic(at(0), at(1.0 / 3), at(2.0 / 3), at(1))});
  }
  return list;
}

double size_of(const Cubic& f) {
  return std::abs(f.c[0]) + std::abs(f.c[1]) + std::abs(f.c[2]) + std::abs(f.c[3]);
}

TEST(ScalarPolynomial, is_the_polynomial_that_was_sampled) {
  for (const auto& [f, p] : seeded_polynomials(2000)) {
    for (const double u : {0.0, 0.1, 0.37, 0.5, 0.9, 1.0})
      ASSERT_NEAR(p(u), f(u), 1e-6 * size_of(f));
    ASSERT_NEAR(p.mean(), f.c[0] + f.c[1] / 2 + f.c[2] / 3 + f.c[3] / 4, 1e-6 * size_of(f));
  }
}

TEST(ScalarPolynomial, finds_where_it_has_a_value) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> share(0.001, 0.999);
  for (const auto& [f, p] : seeded_polynomials(2000)) {
    std::vector<double> ends{0};
    ends.insert(ends.end(), p.extrema().begin(), p.extrema().end());
    ends.push_back(1);
    for (std::size_t i = 1; i < ends.size(); ++i) {
      const double rising = p(ends[i]) > p(ends[i - 1]) ? 1 : -1;
      const double value = p(ends[i - 1]) + share(random) * (p(ends[i]) - p(ends[i - 1]));
      const double place = p.place_of(value, ends[i - 1], ends[i]);
      double low = ends[i - 1], high = ends[i];
      for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (rising * (p(middle) - value) < 0 ? low : high) = middle;
      }
      const double slope = std::abs(p(place + 1e-6) - p(place - 1e-6)) / 2e-6;
      ASSERT_NEAR(place, low, 1e-12 + 1e-15 * size_of(f) / slope);
    }
    // Beyond the ends: the nearer one.
    const double greatest = std::max(p(0.0), p(1e-9)), least = std::min(p(0.0), p(1e-9));
    ASSERT_EQ(p.place_of(greatest + 1, 0, 1e-9), p(0.0) >= p(1e-9) ? 0 : 1e-9);
    ASSERT_EQ(p.place_of(least - 1, 0, 1e-9), p(0.0) <= p(1e-9) ? 0 : 1e-9);
  }
}

TEST(ScalarPolynomial, finds_its_extrema) {
  for (const auto& [f, p] : seeded_polynomials(2000)) {
    double greatest = -std::numeric_limits<double>::infinity(), least = -greatest;
    for (int i = 0; i <= 4096; ++i) {
      greatest = std::max(greatest, f(i / 4096.0));
      least = std::min(least, f(i / 4096.0));
    }
    // A parabola's top between two samples is higher by at most an eighth of the second derivative.
    const double second = 2 * std::abs(f.c[2]) + 6 * std::abs(f.c[3]);
    const double sampling = second / 8 / (4096.0 * 4096) + 1e-6 * size_of(f);
    ASSERT_NEAR(p.maximum(), greatest, sampling);
    ASSERT_NEAR(p.minimum(), least, sampling);
    double before = 0;
    for (const double place : p.extrema()) {
      ASSERT_GT(place, before);
      ASSERT_LT(place, 1);
      const double slope = f.c[1] + place * (2 * f.c[2] + place * 3 * f.c[3]);
      // The values are rounded; their derivative is off by at most 13.5 of that.
      ASSERT_NEAR(slope, 0, 4e-6 * size_of(f));
      before = place;
    }
  }
}

TEST(ScalarPolynomial, pieces_stay_within_the_tolerance_of_their_chords) {
  int most = 0;
  for (const Sampled& sampled : seeded_polynomials(2000)) {
    const Cubic& f = sampled.truth;
    const ScalarPolynomial& p = sampled.polynomial;
    for (const double tolerance : {1e-2 * size_of(f), 1e-3 * size_of(f)}) {
      double u_before = 0, last_slope = 0;
      float s_before = 0;
      int pieces = 0;
      std::size_t turns = 0;
      const bool all =
          p.for_each_linear_piece(tolerance, [&](double u0, double u1, float s0, float s1) {
            EXPECT_EQ(u0, u_before);
            EXPECT_GT(u1, u0);
            if (pieces > 0) {
              EXPECT_EQ(s0, s_before);
            }
            for (int i = 0; i <= 16; ++i) {
              const double share = i / 16.0;
              EXPECT_NEAR(f(u0 + share * (u1 - u0)), s0 + share * (s1 - s0),
                          tolerance + 2e-6 * size_of(f));
            }
            if (last_slope * (s1 - s0) < 0) ++turns;
            last_slope = s1 - s0;
            u_before = u1;
            s_before = s1;
            ++pieces;
            return true;
          });
      ASSERT_TRUE(all);
      ASSERT_EQ(u_before, 1);
      ASSERT_EQ(s_before, static_cast<float>(f(1)));
      // It turns around at the extrema and nowhere else (but where that is less than rounding).
      ASSERT_LE(turns, p.extrema().size);
      most = std::max(most, pieces);
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_LE(most, 3 * ScalarPolynomial::kMostPieces);
}

TEST(ScalarPolynomial, the_error_falls_with_the_square_of_the_tolerance_s_pieces) {
  const auto p = ScalarPolynomial::quadratic(0, 1, 0);  // 4 u (1 - u): bends by 1 from end to end
  auto count = [&](double tolerance) {
    int pieces = 0;
    p.for_each_linear_piece(tolerance, [&](double, double, float, float) {
      ++pieces;
      return true;
    });
    return pieces;
  };
  EXPECT_EQ(count(1.0), 2);  // split at its top whatever the tolerance
  EXPECT_EQ(count(0.25 / 4), 4);
  EXPECT_EQ(count(0.25 / 64), 16);
  EXPECT_EQ(count(0), 2 * ScalarPolynomial::kMostPieces);
}

TEST(ScalarPolynomial, what_is_linear_is_one_piece) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<float> uniform(-1000, 1000);
  for (int i = 0; i < 2000; ++i) {
    const float a = uniform(random), b = uniform(random);
    auto at = [&](double u) { return static_cast<float>(a + u * (static_cast<double>(b) - a)); };
    for (const auto& p : {ScalarPolynomial::quadratic(a, at(0.5), b),
                          ScalarPolynomial::cubic(a, at(1.0 / 3), at(2.0 / 3), b)}) {
      int pieces = 0;
      p.for_each_linear_piece(0, [&](double, double, float s0, float s1) {
        EXPECT_EQ(s0, a);
        EXPECT_EQ(s1, b);
        return ++pieces > 0;
      });
      ASSERT_EQ(pieces, 1);
    }
  }
}

TEST(ScalarPolynomial, is_transparent_where_a_value_is_no_number) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& p :
       {ScalarPolynomial::quadratic(1, nan, 2), ScalarPolynomial::cubic(1, 2, nan, 3),
        ScalarPolynomial::quadratic(nan, 1, 2),
        ScalarPolynomial::cubic(1, std::numeric_limits<float>::infinity(), 2, 3)}) {
    int pieces = 0;
    p.for_each_linear_piece(0.1, [&](double u0, double u1, float s0, float s1) {
      EXPECT_EQ(u0, 0);
      EXPECT_EQ(u1, 1);
      EXPECT_TRUE(std::isnan(s0) && std::isnan(s1));
      return ++pieces > 0;
    });
    EXPECT_EQ(pieces, 1);
    EXPECT_FALSE(std::isfinite(p.mean()));
    EXPECT_GE(p.maximum(), 2);  // of the ends that are numbers
    EXPECT_FALSE(std::isnan(p.minimum()));
  }
}

TEST(ScalarPolynomial, stops_when_told) {
  int pieces = 0;
  EXPECT_FALSE(ScalarPolynomial::quadratic(0, 1, 0).for_each_linear_piece(
      1e-9, [&](double, double, float, float) { return ++pieces < 3; }));
  EXPECT_EQ(pieces, 3);
}

}  // namespace
}  // namespace plume
