// Whole rays through whole classifications, against the oracle and against each other.

#include "plume/preint/classified_optics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plume/tests/preint/classified_rays.h"
#include "plume/tests/reference/interval_walk.h"

namespace plume {
namespace {

using tests::composite;
using tests::Piece;
using tests::random_classification;
using tests::random_ray;

double off_oracle(const Classification& classification, const std::vector<Piece>& pieces,
                  bool linear) {
  std::vector<reference::LinearPiece> same;
  for (const Piece& piece : pieces) same.push_back({piece.s_in, piece.s_out, piece.length});
  const auto expected = reference::interval_walk(classification, same, linear);
  const Compositor found =
      composite(classification, pieces, linear ? IntervalForm::linear : IntervalForm::exponential);
  double error = std::abs(found.alpha() - expected.alpha);
  for (std::size_t c = 0; c < 3; ++c)
    error = std::max(error, std::abs(found.rgb[c] - expected.rgb[c]));
  return error;
}

TEST(ClassifiedOptics, equals_the_oracle) {
  std::mt19937_64 random(21);
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const Classification classification = random_classification(random);
    ASSERT_EQ(classification.problem(), std::nullopt);
    const double error = off_oracle(classification, random_ray(random, 12), false);
    worst = std::max(worst, error);
    // Each part is within 1e-7, and w is in single precision.
    ASSERT_LE(error, 2e-7) << i;
  }
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

TEST(ClassifiedOptics, equals_the_oracle_in_the_linear_form) {
  std::mt19937_64 random(22);
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    // Opacities of at most 0.9, below which nothing saturates.
    const Classification classification = random_classification(random, 0.9f);
    const double error = off_oracle(classification, random_ray(random, 12), true);
    worst = std::max(worst, error);
    ASSERT_LE(error, 2e-7) << i;
  }
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

TEST(ClassifiedOptics, the_forms_differ_by_the_square_of_the_opacity) {
  auto opacity = [](float tau, IntervalForm form) {
    return composite({{}, {{0, 1, {{{0, {tau, {1, 1, 1}}}}}}}, {}}, {{-1, 0.3f}, {0.3f, 2}}, form)
        .alpha();
  };
  for (const float tau : {0.01f, 0.1f, 0.5f}) {
    EXPECT_NEAR(opacity(tau, IntervalForm::linear), tau, 1e-7);
    EXPECT_NEAR(opacity(tau, IntervalForm::exponential), -std::expm1(-tau), 1e-7);
  }
  // The linear form is opaque from an integral of 1 on, and no more than that.
  EXPECT_NEAR(opacity(1, IntervalForm::linear), 1, 1e-7);
  EXPECT_NEAR(opacity(5, IntervalForm::linear), 1, 1e-7);
}

TEST(ClassifiedOptics, the_linear_form_shows_no_colour_behind_full_opacity) {
  // tau = 4 w, so the integral is 1 at w = sqrt(1/2); colour is red before, green behind.
  const float middle = std::sqrt(0.5f);
  const TransferFunction profile{{{0, {0, {1, 0, 0}}},
                                  {middle, {4 * middle, {1, 0, 0}}},
                                  {middle, {4 * middle, {0, 1, 0}}},
                                  {1, {4, {0, 1, 0}}}}};
  const IntervalOptics optics(profile, IntervalForm::linear);
  const SegmentColor whole = optics.integrate(0, 1);
  EXPECT_NEAR(whole.r, 1, 1e-6);
  EXPECT_NEAR(whole.g, 0, 1e-6);
  EXPECT_EQ(whole.alpha, 1);
  // From the other end: tau falls from 4, so the integral is 1 at 1 - w = 1 - sqrt(1/2).
  const SegmentColor back = optics.integrate(1, 0);
  EXPECT_NEAR(back.g, 1, 1e-6);
  EXPECT_NEAR(back.r, 0, 1e-6);
  const float further = optics.integrate(0.9f, 1).alpha;
  EXPECT_EQ(further, 0);
}

// A piece cut anywhere, into any number of pieces, is still the same ray.
TEST(ClassifiedOptics, does_not_see_where_pieces_meet) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const IntervalForm form : {IntervalForm::exponential, IntervalForm::linear})
    for (int i = 0; i < 200; ++i) {
      const Classification classification = random_classification(random, 2);
      const std::vector<Piece> whole = random_ray(random, 6);
      std::vector<Piece> cut;
      for (const Piece& piece : whole) {
        float s = piece.s_in;
        double left = piece.length;
        for (int part = 0; part < 9; ++part) {
          const float next = s + (piece.s_out - s) * 0.3f * unit(random);
          const double share = s == piece.s_out ? 0.1 : (next - s) / (piece.s_out - s);
          cut.push_back({s, next, left * share});
          left -= left * share;
          s = next;
        }
        cut.push_back({s, piece.s_out, left});
      }
      ASSERT_LE(tests::distance(composite(classification, whole, form),
                                composite(classification, cut, form)),
                2e-6)
          << i;
    }
}

// Powers of two, which leave no trace in floats.
TEST(ClassifiedOptics, does_not_see_the_scale_of_space_or_scalar) {
  std::mt19937_64 random(24);
  for (int i = 0; i < 200; ++i) {
    Classification plain = random_classification(random);
    const std::vector<Piece> ray = random_ray(random, 8);
    const Compositor expected = composite(plain, ray);
    Classification scaled = plain;
    std::vector<Piece> scaled_ray = ray;
    for (Piece& piece : scaled_ray) {
      piece.s_in *= 1024;
      piece.s_out *= 1024;
      piece.length /= 8;
    }
    for (auto& interval : scaled.intervals) {
      interval.low *= 1024;
      interval.high *= 1024;
    }
    for (auto& surface : scaled.isosurfaces) surface.value *= 1024;
    if (scaled.volume)
      for (auto& knot : scaled.volume->knots) {
        knot.scalar *= 1024;
        knot.optics.extinction *= 8;
      }
    ASSERT_LE(tests::distance(composite(scaled, scaled_ray), expected), 1e-7);

    // Without a volume, space plays no part at all.
    plain.volume.reset();
    const Compositor surfaces = composite(plain, ray);
    for (Piece& piece : scaled_ray) piece.length = tests::random_length(random, 1e-6f, 1e6f);
    scaled.volume.reset();
    ASSERT_EQ(tests::distance(composite(scaled, scaled_ray), surfaces), 0);
  }
}

TEST(ClassifiedOptics, opacity_is_the_same_from_behind) {
  std::mt19937_64 random(25);
  for (int i = 0; i < 300; ++i) {
    const Classification classification = random_classification(random);
    // From outside to outside, else a cut face is seen from one side alone.
    std::vector<Piece> ray = random_ray(random, 8);
    ray.front().s_in = -0.5f;
    ray.back().s_out = 1.5f;
    // Visits left by the end they were entered by see the same from both sides; so does a crossing.
    ASSERT_NEAR(composite(classification, ray).transmittance,
                composite(classification, tests::reversed(ray)).transmittance, 1e-6);
  }
}

TEST(ClassifiedOptics, an_interval_of_ever_less_width_becomes_its_isosurface) {
  std::mt19937_64 random(26);
  std::uniform_real_distribution<float> unit(0.1f, 0.9f);
  int compared = 0;
  for (int i = 0; i < 50; ++i) {
    const TransferFunction profile = tests::random_profile(random, 3);
    const float value = unit(random);
    const std::vector<Piece> ray = random_ray(random, 8);
    const TransferFunction volume = tests::smooth_function();
    // Its colour seen from below and from above differs; that of one colour does not.
    TransferFunction one_colour = profile;
    for (auto& knot : one_colour.knots) knot.optics.color = {0.3f, 0.6f, 0.9f};
    const SegmentColor whole = ClosedForm(one_colour).integrate(0, 1, 1);
    if (whole.alpha == 0) continue;
    const Classification surface{volume, {}, {{value, whole.alpha, {0.3f, 0.6f, 0.9f}}}};
    const Compositor limit = composite(surface, ray);
    // What the interval cuts out of the volume, whose extinction is at most 6.
    double volume_per_width = 0;
    float nearest_turn = 1;
    for (const Piece& piece : ray) {
      volume_per_width += 6 * piece.length / std::abs(piece.s_out - piece.s_in);
      nearest_turn = std::min(nearest_turn, std::abs(piece.s_in - value));
    }
    for (const float width : {1e-2f, 1e-3f, 1e-4f, 1e-5f, 1e-6f}) {
      if (width > nearest_turn) continue;  // a visit that does not cross it
      const Classification interval{
          volume, {{value - width / 2, value + width / 2, one_colour}}, {}};
      EXPECT_LE(tests::distance(composite(interval, ray), limit), 1e-6 + width * volume_per_width)
          << i << ' ' << width;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace plume
