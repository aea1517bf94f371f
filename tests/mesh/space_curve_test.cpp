// The order along a Hilbert curve, and the sorting that makes it.

#include "plume/mesh/space_curve.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "plume/mesh/radix_sort.h"
#include "plume/tests/reference/hilbert.h"

namespace plume::test {
namespace {

using Places = std::vector<std::array<float, 3>>;

// Half of them spread evenly, half crowded about a corner.
Places random_places(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> even(-1, 1);
  std::normal_distribution<float> crowded(-0.9f, 1e-4f);
  Places places;
  for (std::size_t i = 0; i < count; ++i) {
    const bool far = random() % 2 == 0;
    std::array<float, 3> place;
    for (float& x : place) x = far ? even(random) : crowded(random);
    places.push_back(place);
  }
  return places;
}

TEST(HilbertKey, IsAPathThroughNeighbors) {
  // Among the centres of an 8 x 8 x 8 lattice, those next in order are next in space.
  Places places(512);
  for (std::uint32_t k = 0; k < 8; ++k)
    for (std::uint32_t j = 0; j < 8; ++j)
      for (std::uint32_t i = 0; i < 8; ++i) {
        const std::array<float, 3> place{(static_cast<float>(i) + 0.5f) / 4 - 1,
                                         (static_cast<float>(j) + 0.5f) / 4 - 1,
                                         (static_cast<float>(k) + 0.5f) / 4 - 1};
        const std::uint64_t key = hilbert_key(place, 3);
        ASSERT_LT(key, places.size());
        places[key] = place;
      }
  for (std::size_t i = 1; i < places.size(); ++i) {
    float steps = 0;
    for (std::size_t a = 0; a < 3; ++a) steps += std::abs(places[i][a] - places[i - 1][a]) * 4;
    EXPECT_EQ(steps, 1) << i;
  }
}

TEST(HilbertKey, IsSkillingsAtEveryOrder) {
  std::mt19937 random(1);
  for (int order = 1; order <= 21; ++order)
    for (int i = 0; i < 5000; ++i) {
      const float size = static_cast<float>(1u << order);
      std::array<std::uint32_t, 3> cell;
      std::array<float, 3> place;
      for (std::size_t a = 0; a < 3; ++a) {
        cell[a] = random() >> (32 - order);
        place[a] = 2 * ((static_cast<float>(cell[a]) + 0.5f) / size) - 1;
      }
      ASSERT_EQ(hilbert_key(place, order), reference::hilbert_key(cell, order))
          << "order " << order << ", cell " << cell[0] << " " << cell[1] << " " << cell[2];
      for (int lower = 1; lower < order; ++lower)
        ASSERT_EQ(hilbert_key(place, lower), hilbert_key(place, order) >> 3 * (order - lower));
    }
}

TEST(HilbertKey, ClampsWhatIsOutside) {
  for (const int order : {1, 2, 7, 20, 21}) {
    EXPECT_EQ(hilbert_key({1, 1, 1}, order), hilbert_key({0.9999999f, 0.9999999f, 2}, order));
    EXPECT_EQ(hilbert_key({-7, -1, -1e30f}, order), 0u);
    EXPECT_LT(hilbert_key({1e30f, -1, 1}, order), std::uint64_t{1} << 3 * order);
  }
}

TEST(RadixSort, SortsBySomeBitsAndKeepsTheOrderOfEquals) {
  std::mt19937_64 random(1);
  for (const std::size_t count : {0u, 1u, 2u, 1000u, 200000u}) {
    for (const auto& [low, high] : {std::pair{0, 64}, {32, 53}, {7, 8}, {20, 31}, {5, 5}}) {
      SortItems items(count);
      for (std::size_t i = 0; i < count; ++i) items[i] = random();
      std::vector<std::uint64_t> wanted(&items.values[0], &items.values[0] + count);
      const auto bits = [low = low, high = high](std::uint64_t item) {
        return high == low ? 0 : item << (64 - high) >> (64 - high + low);
      };
      std::stable_sort(wanted.begin(), wanted.end(),
                       [&](std::uint64_t a, std::uint64_t b) { return bits(a) < bits(b); });
      radix_sort(items, low, high);
      EXPECT_TRUE(std::equal(wanted.begin(), wanted.end(), &items.values[0]))
          << count << " items by the bits from " << low << " to " << high;
    }
  }
}

TEST(HilbertOrder, FollowsTheLatticeAndWhereThatIsCrowdedTheFinestCurve) {
  const Places places = random_places(40000, 1);
  const int coarse = lattice_order(places.size());
  std::vector<std::size_t> crowd(std::size_t{1} << 3 * coarse, 0);
  for (const auto& place : places) ++crowd[hilbert_key(place, coarse)];
  EXPECT_GT(*std::max_element(crowd.begin(), crowd.end()), kCrowdedCell);

  std::vector<std::uint32_t> wanted(places.size());
  std::iota(wanted.begin(), wanted.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    const std::uint64_t lattice = hilbert_key(places[i], coarse);
    const int rest = 3 * (21 - coarse);
    return crowd[lattice] > kCrowdedCell ? hilbert_key(places[i], 21) : lattice << rest;
  };
  std::stable_sort(wanted.begin(), wanted.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  EXPECT_EQ(hilbert_order(places.size(), [&](std::size_t i) { return places[i]; }), wanted);
}

TEST(HilbertOrder, IsTheSameForAnyNumberOfThreads) {
  const Places places = random_places(150000, 2);
  const auto order = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return hilbert_order(places.size(), [&](std::size_t i) { return places[i]; });
  };
  const auto one = order(1);
  EXPECT_EQ(order(2), one);
  EXPECT_EQ(order(5), one);
}

TEST(HilbertOrder, KeepsTheOrderOfWhatIsInOnePlace) {
  for (const std::size_t count : {0u, 1u, 63u, 1000u}) {
    const auto order = hilbert_order(count, [](std::size_t) {
      return std::array<float, 3>{0.3f, 0, 0};
    });
    ASSERT_EQ(order.size(), count);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(order[i], i);
  }
}

}  // namespace
}  // namespace plume::test
