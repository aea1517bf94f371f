// Which faces are one and the same, against a plain search.

#include "plume/mesh/face_matching.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <map>
#include <mutex>
#include <random>
#include <set>

namespace plume::test {
namespace {

// Faces known by their three smallest points and a fourth number that tells some of these apart.
struct Face {
  std::array<std::uint32_t, 3> key;
  std::uint32_t rest;
};

struct Matches {
  std::set<std::array<std::uint32_t, 2>> pairs;
  std::set<std::uint32_t> extra;
  bool operator==(const Matches&) const = default;
};

Matches matched(std::size_t points, const std::vector<Face>& faces, std::size_t threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  Matches found;
  std::mutex guard;
  match_faces(
      points, faces.size(), [&](std::size_t slot) { return faces[slot].key; },
      [&](std::uint32_t a, std::uint32_t b) { return faces[a].rest == faces[b].rest; },
      [&](std::uint32_t a, std::uint32_t b) {
        const std::lock_guard lock(guard);
        EXPECT_TRUE(found.pairs.insert({a, b}).second);
      },
      [&](std::uint32_t slot) {
        const std::lock_guard lock(guard);
        EXPECT_TRUE(found.extra.insert(slot).second);
      });
  return found;
}

// The first two of equal faces are a pair, the rest is extra.
Matches brute_force(const std::vector<Face>& faces) {
  std::map<std::array<std::uint32_t, 4>, std::vector<std::uint32_t>> groups;
  for (std::uint32_t s = 0; s < faces.size(); ++s) {
    const auto& k = faces[s].key;
    if (k[0] != kNone) groups[{k[0], k[1], k[2], faces[s].rest}].push_back(s);
  }
  Matches found;
  for (const auto& [key, slots] : groups) {
    if (slots.size() > 1) found.pairs.insert({slots[0], slots[1]});
    for (std::size_t i = 2; i < slots.size(); ++i) found.extra.insert(slots[i]);
  }
  return found;
}

TEST(MatchFaces, FindsWhatAPlainSearchFinds) {
  std::mt19937 random(1);
  // From few crowded points, where most faces have many equals, to many, where most have none; and
  // with all faces at one point.
  for (const std::uint32_t points : {3u, 8u, 60u, 300u})
    for (const bool one_hub : {false, true}) {
      std::vector<Face> faces(20000);
      for (Face& face : faces) {
        std::set<std::uint32_t> ids;
        if (one_hub) ids.insert(0);
        while (ids.size() < 3) ids.insert(random() % points);
        std::copy(ids.begin(), ids.end(), face.key.begin());
        face.rest = random() % 3;
        if (random() % 50 == 0) face.key[0] = kNone;
      }
      const Matches wanted = brute_force(faces);
      EXPECT_FALSE(wanted.pairs.empty());
      for (const std::size_t threads : {1u, 2u, 5u})
        EXPECT_EQ(matched(points, faces, threads), wanted) << points << " points";
    }
}

TEST(MatchFaces, AFaceThatFitsOneOfTwoEqualsTakesTheFirstWithoutAPartner) {
  // Faces 0 and 1 belong to one cell, which is no neighbour of itself; 2, 3 and 4 to others.
  const auto cell = [](std::uint32_t slot) { return std::max(slot, 1u); };
  std::vector<std::array<std::uint32_t, 2>> pairs;
  std::vector<std::uint32_t> extra;
  match_faces(
      3, 5,
      [](std::size_t) {
        return std::array<std::uint32_t, 3>{0, 1, 2};
      },
      [&](std::uint32_t a, std::uint32_t b) { return cell(a) != cell(b); },
      [&](std::uint32_t a, std::uint32_t b) {
        pairs.push_back({a, b});
      },
      [&](std::uint32_t slot) { extra.push_back(slot); });
  EXPECT_EQ(pairs, (std::vector<std::array<std::uint32_t, 2>>{{0, 2}, {1, 3}}));
  EXPECT_EQ(extra, std::vector<std::uint32_t>{4});
}

TEST(MatchFaces, TakesNoFacesAtAll) {
  EXPECT_EQ(matched(0, {}, 2), Matches{});
  EXPECT_EQ(matched(5, {{{kNone, kNone, kNone}, 0}}, 2), Matches{});
}

}  // namespace
}  // namespace plume::test
