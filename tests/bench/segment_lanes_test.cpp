// The closed form by vectors, segment by segment: within its bound of the scalar one, and no lane
// spoils another or itself.

#include "plume/tests/bench/segment_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "plume/preint/closed_form.h"
#include "plume/tests/preint/transfer_functions.h"

namespace plume::bench {
namespace {

// Not a number where one of the four is not.
double distance(const LaneColors& colors, std::size_t i, const SegmentColor& expected) {
  double largest = 0;
  for (const float off : {colors.r[i] - expected.r, colors.g[i] - expected.g,
                          colors.b[i] - expected.b, colors.alpha[i] - expected.alpha})
    largest =
        std::isnan(off) || std::abs(off) > largest ? std::abs(static_cast<double>(off)) : largest;
  return largest;
}

TEST(SegmentLanes, closed_form_is_within_its_bound_of_the_scalar_one) {
  for (const auto& [name, function] : tests::all_functions()) {
    const ClosedForm closed_form(function);
    std::mt19937_64 random(5);
    std::normal_distribution<float> near(0, 0.02f);
    LaneSegments segments;
    for (int i = 0; i < 160000; ++i) {
      // Knots, scalars that differ by one unit in the last place, and lengths that lanes beside
      // each other do not share: one is opaque at once while another goes through all pieces.
      auto [s_in, s_out] = tests::random_ends(random, function);
      if (i % 2 == 0) s_out = s_in + near(random);
      segments.s_in.push_back(s_in);
      segments.s_out.push_back(s_out);
      segments.length.push_back(tests::random_length(random, 1e-4f, 1e3f));
    }
    LaneColors colors;
    colors.resize(segments.size());
    closed_form_by_lanes(PieceTable(function), segments, colors);
    double largest = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const double off =
          distance(colors, i,
                   closed_form.integrate(segments.s_in[i], segments.s_out[i], segments.length[i]));
      ASSERT_LE(off, 1e-6) << name << " from " << segments.s_in[i] << " to " << segments.s_out[i]
                           << " over " << segments.length[i];
      largest = std::max(largest, off);
    }
    RecordProperty(name, std::to_string(largest * 1e9) + "e-9");
  }
}

TEST(SegmentLanes, a_segment_looks_the_same_whatever_is_beside_it) {
  const TransferFunction function = tests::smooth_function();
  std::mt19937_64 random(9);
  std::uniform_real_distribution<float> anywhere(0, 1);
  LaneSegments segments;
  for (int i = 0; i < 16000; ++i) {
    segments.s_in.push_back(anywhere(random));
    segments.s_out.push_back(anywhere(random));
    segments.length.push_back(tests::random_length(random, 1e-3f, 10));  // transparent to opaque
  }
  LaneSegments turned = segments;
  for (auto* values : {&turned.s_in, &turned.s_out, &turned.length})
    for (std::size_t i = 0; i < values->size(); i += 3)
      std::swap((*values)[i], (*values)[values->size() - 1 - i]);
  const PieceTable pieces(function);
  LaneColors colors, others;
  colors.resize(segments.size());
  others.resize(segments.size());
  closed_form_by_lanes(pieces, segments, colors);
  closed_form_by_lanes(pieces, turned, others);
  for (auto* values : {&others.r, &others.g, &others.b, &others.alpha})
    for (std::size_t i = 0; i < values->size(); i += 3)
      std::swap((*values)[i], (*values)[values->size() - 1 - i]);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    ASSERT_EQ(colors.r[i], others.r[i]) << i;
    ASSERT_EQ(colors.g[i], others.g[i]) << i;
    ASSERT_EQ(colors.b[i], others.b[i]) << i;
    ASSERT_EQ(colors.alpha[i], others.alpha[i]) << i;
  }
}

TEST(SegmentLanes, empty_segments_are_transparent_beside_any_others) {
  constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [name, function] : tests::all_functions()) {
    const ClosedForm closed_form(function);
    LaneSegments segments;
    std::mt19937_64 random(6);
    for (int i = 0; i < 1600; ++i) {
      const auto [s_in, s_out] = tests::random_ends(random, function);
      segments.s_in.push_back(i % 5 == 1 ? not_a_number : s_in);
      segments.s_out.push_back(i % 5 == 2 ? not_a_number : s_out);
      segments.length.push_back(i % 5 == 3 ? 0 : tests::random_length(random, 1, 1e3f));
    }
    LaneColors colors;
    colors.resize(segments.size());
    closed_form_by_lanes(PieceTable(function), segments, colors);
    for (std::size_t i = 0; i < segments.size(); ++i)
      ASSERT_LE(
          distance(colors, i,
                   closed_form.integrate(segments.s_in[i], segments.s_out[i], segments.length[i])),
          1e-6)
          << name << ' ' << i;
  }
}

// What the closed form's time is compared with must do the same work as the table.
TEST(SegmentLanes, table_is_the_tables) {
  const PreintegratedTable table(tests::smooth_function(),
                                 {64, 16, std::array{0.0f, 1.0f}, std::array{1e-3f, 10.0f}});
  LaneSegments segments;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<float> scalar(0, 1);
  for (int i = 0; i < 1600; ++i) {
    segments.s_in.push_back(scalar(random));
    segments.s_out.push_back(scalar(random));
    segments.length.push_back(tests::random_length(random, 1e-3f, 10));
  }
  LaneColors colors;
  colors.resize(segments.size());
  table_by_lanes(table, segments, colors);
  for (std::size_t i = 0; i < segments.size(); ++i)
    ASSERT_LE(distance(colors, i,
                       table.integrate(segments.s_in[i], segments.s_out[i], segments.length[i])),
              1e-5);
}

}  // namespace
}  // namespace plume::bench
