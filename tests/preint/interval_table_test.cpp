// Intervals and isosurfaces from tables, against what is split in data space.

#include "plume/preint/interval_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "plume/tests/preint/classified_rays.h"

namespace plume {
namespace {

using tests::composite;
using tests::distance;
using tests::Piece;

// Two intervals with a gap, in which there is an isosurface, and a volume.
Classification scene() {
  Classification all;
  all.volume = TransferFunction{{{0, {0.2f, {0, 0, 1}}}, {1, {2, {1, 0.5f, 0}}}}};
  all.intervals = {{0.2f, 0.35f, even_profile(0.4f, {0, 1, 0})},
                   {0.6f, 0.8f, {{{0, {0.1f, {1, 0, 0}}}, {1, {1.5f, {1, 1, 0}}}}}}};
  all.isosurfaces = {{0.5f, 0.3f, {1, 1, 1}}};
  return all;
}

Compositor by_table(const IntervalTable& table, const std::vector<Piece>& pieces) {
  IntervalTable::State state;
  Compositor sum;
  for (const Piece& piece : pieces)
    sum.add(table.add(state, piece.s_in, piece.s_out, static_cast<float>(piece.length)));
  return sum;
}

IntervalTable table_of(const Classification& classification, int scalars, int lengths = 64) {
  return {classification, {0, 1}, {1e-3f, 10}, {scalars, lengths}};
}

// Scalars of pieces, and all bounds, lie on the table's entries, so that nothing but colour is
// interpolated, over lengths.
TEST(IntervalTable, IsExactOnItsEntries) {
  const Classification all = scene();
  const IntervalTable table = table_of(all, 101);
  std::mt19937_64 random(5);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<float> scalars;
    // None is a bound: that would be a question of rounding.
    for (int k = 0; k < 12; ++k)
      scalars.push_back(
          static_cast<float>(5 * std::uniform_int_distribution<int>(0, 19)(random) + 1) / 100);
    const auto pieces = tests::polyline(scalars);
    worst = std::max(worst, distance(by_table(table, pieces), composite(all, pieces)));
  }
  EXPECT_LT(worst, 2e-4);
  RecordProperty("worst", std::to_string(worst));
}

// Off its entries there is no such bound: where a ray turns back next to an isosurface it sees a
// part of it.
TEST(IntervalTable, SmearsBoundsOverItsEntries) {
  Classification surface;
  surface.isosurfaces = {{0.5f, 0.8f, {1, 1, 1}}};
  struct Errors {
    double passing = 0, turning = 0;
    int wrong = 0;
  };
  auto errors = [&](int scalars) {
    const IntervalTable table = table_of(surface, scalars, 2);
    auto off = [&](const std::vector<float>& way) {
      const auto pieces = tests::polyline(way);
      return distance(by_table(table, pieces), composite(surface, pieces));
    };
    Errors found;
    for (int i = 0; i < 200; ++i) {
      const float at = 0.45f + 0.0005f * (static_cast<float>(i) + 0.3f);
      found.passing = std::max(found.passing, off({0.1f, at, 0.9f}));
      const double turned = off({0.1f, at, 0.1f});
      found.turning = std::max(found.turning, turned);
      found.wrong += turned > 0.01 ? 1 : 0;
    }
    return found;
  };
  const Errors coarse = errors(64), fine = errors(256);
  EXPECT_LT(coarse.passing, 1e-6);  // optical depths add up
  EXPECT_GT(coarse.turning, 0.3);
  EXPECT_GT(fine.turning, 0.3);  // in fewer places, not by less
  EXPECT_LT(fine.wrong, coarse.wrong / 2);
}

TEST(IntervalTable, ConvergesOnTheAverage) {
  const Classification all = scene();
  std::mt19937_64 random(6);
  std::vector<std::vector<Piece>> rays;
  for (int i = 0; i < 200; ++i) {
    auto ray = tests::random_ray(random, 12);
    for (Piece& piece : ray) {
      piece.s_in = std::clamp(piece.s_in, 0.0f, 1.0f);
      piece.s_out = std::clamp(piece.s_out, 0.0f, 1.0f);
    }
    rays.push_back(ray);
  }
  auto mean_error = [&](int scalars) {
    const IntervalTable table = table_of(all, scalars, 8);
    double sum = 0;
    for (const auto& ray : rays) sum += distance(by_table(table, ray), composite(all, ray));
    return sum / static_cast<double>(rays.size());
  };
  const double coarse = mean_error(24), medium = mean_error(96), fine = mean_error(384);
  RecordProperty(
      "means", std::to_string(coarse) + " " + std::to_string(medium) + " " + std::to_string(fine));
  EXPECT_LT(medium, 0.5 * coarse);
  EXPECT_LT(fine, 0.5 * medium);
}

TEST(IntervalTable, ShowsAllOfAnIntervalInWhichARayBegins) {
  Classification one;
  one.intervals = {{0.2f, 0.8f, even_profile(0.5f, {1, 1, 1})}};
  const IntervalTable table = table_of(one, 101);
  for (const auto& scalars : {std::vector<float>{0.5f, 0.6f, 0.4f}, {0.5f, 0.9f}, {0.5f, 0.1f}})
    EXPECT_NEAR(by_table(table, tests::polyline(scalars)).alpha(), 0.5, 1e-5);
}

TEST(IntervalTable, BeginsAnewBehindWhatIsNotANumber) {
  Classification one;
  one.intervals = {{0.2f, 0.8f, even_profile(0.5f, {1, 1, 1})}};
  const IntervalTable table = table_of(one, 101);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto pieces = tests::polyline({0.1f, 0.9f, nan, 0.5f, 0.9f});
  EXPECT_NEAR(by_table(table, pieces).alpha(), 0.75, 1e-5);
}

}  // namespace
}  // namespace plume
