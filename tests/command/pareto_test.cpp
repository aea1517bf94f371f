#include "plume/examples/plume/pareto.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "plume/tests/command/chart_points.h"

namespace plume::command {
namespace {

using tests::any_points;

RC_GTEST_PROP(Pareto, TheFrontIsAllThatNoneDominates, ()) {
  const std::vector<ChartPoint> points = any_points();
  std::set<std::size_t> expected;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // In words of its own: somebody is at least as good in both and not the same.
    const bool beaten = std::any_of(points.begin(), points.end(), [&](const ChartPoint& other) {
      const double dt = points[i].milliseconds - other.milliseconds;
      const double de = points[i].max_error - other.max_error;
      return dt >= 0 && de >= 0 && dt + de > 0;
    });
    if (!beaten) expected.insert(i);
  }
  const auto front = pareto_front(points);
  RC_ASSERT(std::set<std::size_t>(front.begin(), front.end()) == expected);
  RC_ASSERT(front.size() == expected.size());
}

RC_GTEST_PROP(Pareto, AlongTheFrontTimesRiseAndErrorsFall, ()) {
  const std::vector<ChartPoint> points = any_points();
  const auto front = pareto_front(points, &ChartPoint::rms_error);
  for (std::size_t k = 0; k + 1 < front.size(); ++k) {
    RC_ASSERT(points[front[k]].milliseconds <= points[front[k + 1]].milliseconds);
    RC_ASSERT(points[front[k]].rms_error >= points[front[k + 1]].rms_error);
  }
}

RC_GTEST_PROP(Pareto, WhatIsDominatedIsSoByTheFastestThatIsAsExact, ()) {
  const std::vector<ChartPoint> points = any_points();
  const auto front = pareto_front(points);
  const auto by = dominated_by(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool on_front = std::find(front.begin(), front.end(), i) != front.end();
    RC_ASSERT(by[i].has_value() != on_front);
    if (!by[i]) continue;
    RC_ASSERT(std::find(front.begin(), front.end(), *by[i]) != front.end());
    RC_ASSERT(points[*by[i]].max_error <= points[i].max_error);
    for (const ChartPoint& other : points)
      RC_ASSERT(other.max_error > points[i].max_error ||
                other.milliseconds >= points[*by[i]].milliseconds);
  }
}

TEST(Pareto, FactorsSayHowMuchLongerAPeerTakes) {
  const std::vector<ChartPoint> ours{{"a", "plume", 10, 5e-3, 0}, {"b", "plume", 20, 0, 0}};
  const std::vector<ChartPoint> theirs{{"c", "peer", 15, 5e-2, 0}, {"d", "peer", 100, 1e-4, 0}};
  const auto factors = peer_factors(ours, theirs);
  ASSERT_EQ(factors.size(), 6u);
  EXPECT_DOUBLE_EQ(*factors[0].factor, 1.5);  // 1e-1: c by a
  EXPECT_DOUBLE_EQ(*factors[1].factor, 10);   // 1e-2: d by a
  EXPECT_DOUBLE_EQ(*factors[2].factor, 5);    // 1e-3: d by b
  EXPECT_DOUBLE_EQ(*factors[3].factor, 5);    // 1e-4: d keeps to it exactly
  EXPECT_FALSE(factors[4].factor);            // 1e-5: the peer has no point
  EXPECT_TRUE(factors[4].ours);
  EXPECT_FALSE(factors[5].theirs);
}

}  // namespace
}  // namespace plume::command
