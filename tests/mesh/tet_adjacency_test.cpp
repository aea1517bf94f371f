// Neighbours, order and orientation of tetrahedra, against a plain search and for any number of
// threads.

#include "plume/mesh/tet_adjacency.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include "plume/datasets/generate.h"
#include "plume/mesh/validate.h"
#include "test_meshes.h"

namespace plume::test {
namespace {

using Ids = std::vector<std::int32_t>;

TetAdjacency adjacency_of(const Mesh& mesh) {
  return find_tet_adjacency(mesh, select_field(mesh), check_structure(mesh));
}

Ids ids_of(const Mesh& mesh) {
  Ids ids;
  for (std::size_t i = 0; i < mesh.cells.connectivity.size(); ++i)
    ids.push_back(mesh.cells.connectivity.at<std::int32_t>(i));
  return ids;
}

enum Flaw : unsigned {
  kShuffled = 1,
  kTurned = 2,
  kRepeated = 4,
  kCrowded = 8,
  kUnused = 16,
  kMirrored = 32,
  kTangled = 64
};

// A box, some of whose cells are listed in any order, the other way round, with a point twice, two
// and more times; some points of which no cell uses; all cells the other way round; or points moved
// so far that cells turn inside out.
Mesh flawed_box(int size, unsigned flaws) {
  Mesh mesh = generate("box-tetrahedra", {size, flaws & kTangled ? 0.5 : 0.2, 1});
  std::mt19937 random(flaws + 1);
  Ids ids = ids_of(mesh);
  const auto cells = static_cast<std::uint32_t>(ids.size() / 4);
  const auto some = [&] { return 4 * std::size_t{random() % cells}; };
  const std::uint32_t few = cells / 20 + 1;
  for (std::uint32_t i = 0; i < few; ++i) {
    if (flaws & kTurned)
      if (const std::size_t c = some()) std::swap(ids[c], ids[c + random() % 3 + 1]);
    if (flaws & kRepeated)
      if (const std::size_t c = some()) ids[c + random() % 2] = ids[c + 2 + random() % 2];
    if (flaws & kCrowded) {
      const std::size_t c = some();
      for (std::size_t v = 0; v < 4; ++v) ids.push_back(ids[c + v]);
      // One that shares a face alone.
      if (i % 2 == 0) ids.back() = ids[some()];
    }
    if (flaws & kUnused) {
      // The first cell takes the place of all others at one of its points.
      const std::int32_t lost = ids[some()];
      for (std::int32_t& id : ids)
        if (id == lost) id = ids[0];
    }
  }
  if (flaws & kMirrored)
    for (std::size_t c = 0; c < ids.size(); c += 4) std::swap(ids[c + 1], ids[c + 2]);
  if (flaws & kShuffled)
    for (std::size_t c = ids.size() / 4; c > 1; --c)
      std::swap_ranges(&ids[4 * c - 4], &ids[4 * c - 4] + 4, &ids[4 * (random() % c)]);
  mesh.cells.connectivity = Array::own(std::move(ids));
  return mesh;
}

// Each face's partner by a plain search: of the faces with equal points, in ascending order, the
// first two are partners.
std::vector<std::uint32_t> partners_of(const TetAdjacency& tets) {
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> groups;
  for (std::uint32_t face = 0; face < 4 * tets.cells.size(); ++face) {
    std::array<std::uint32_t, 3> points{};
    std::size_t n = 0;
    for (std::uint32_t r = 0; r < 4; ++r)
      if (r != face % 4) points[n++] = tets.point(face / 4 * 4 + r);
    groups[points].push_back(face);
  }
  std::vector<std::uint32_t> partners(4 * tets.cells.size(), kNone);
  for (const auto& [points, faces] : groups) {
    if (faces.size() < 2) continue;
    partners[faces[0]] = faces[1];
    partners[faces[1]] = faces[0];
  }
  return partners;
}

double volume(const TetAdjacency& tets, std::size_t c) {
  std::array<std::array<double, 3>, 4> p;
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t a = 0; a < 3; ++a)
      p[r][a] = static_cast<double>(tets.points[tets.point(4 * c + r)].position[a]) -
                (r > 0 ? p[0][a] : 0);
  const double volume = p[1][0] * (p[2][1] * p[3][2] - p[2][2] * p[3][1]) -
                        p[1][1] * (p[2][0] * p[3][2] - p[2][2] * p[3][0]) +
                        p[1][2] * (p[2][0] * p[3][1] - p[2][1] * p[3][0]);
  return tets.odd[c] ? -volume : volume;
}

class FlawedBox : public testing::TestWithParam<unsigned> {};

TEST_P(FlawedBox, HasTheCellsPointsAndNeighborsThatAPlainSearchFinds) {
  const Mesh mesh = flawed_box(7, GetParam());
  const TetAdjacency tets = adjacency_of(mesh);
  const Ids ids = ids_of(mesh);

  // Cells: all whose points differ, each with its own points.
  std::set<std::uint32_t> wanted;
  for (std::uint32_t c = 0; c < ids.size() / 4; ++c)
    if (std::set<std::int32_t>(&ids[4 * c], &ids[4 * c] + 4).size() == 4) wanted.insert(c);
  EXPECT_EQ(std::set<std::uint32_t>(tets.original.begin(), tets.original.end()), wanted);
  ASSERT_EQ(tets.original.size(), wanted.size());
  ASSERT_EQ(tets.cells.size(), wanted.size());
  std::uint32_t next_point = 0;
  for (std::uint32_t c = 0; c < tets.cells.size(); ++c) {
    std::set<std::uint32_t> points;
    for (std::size_t v = 0; v < 4; ++v)
      points.insert(tets.numbers[static_cast<std::size_t>(ids[4 * tets.original[c] + v])]);
    std::uint32_t r = 0;
    for (const std::uint32_t point : points) {
      ASSERT_EQ(tets.point(4 * c + r++), point);
      // Points are numbered as they are met.
      ASSERT_LE(point, next_point + 3);
    }
    for (const std::uint32_t point : points) next_point += point >= next_point;
  }
  EXPECT_EQ(tets.points.size(), next_point);

  // Neighbours, and one orientation: all that hang together agree, and their volume is positive.
  const auto partners = partners_of(tets);
  bool one_sided = false;
  for (const Finding& finding : tets.findings)
    one_sided = one_sided || finding.what.find("cannot agree") != std::string::npos;
  std::vector<std::uint32_t> part(tets.cells.size(), kNone);
  for (std::uint32_t face = 0; face < partners.size(); ++face) {
    const std::uint32_t partner = tets.partner(face);
    if (partner != kNone || !one_sided) {
      ASSERT_EQ(partner, partners[face]) << "face " << face;
    }
    if (partner == kNone) continue;
    ASSERT_EQ(tets.partner(partner), face);
    ASSERT_TRUE(tets.agree(face, partner)) << "face " << face;
  }
  for (std::uint32_t seed = 0; seed < part.size(); ++seed) {
    if (part[seed] != kNone) continue;
    double sum = 0;
    std::vector<std::uint32_t> open{seed};
    part[seed] = seed;
    while (!open.empty()) {
      const std::uint32_t c = open.back();
      open.pop_back();
      sum += volume(tets, c);
      for (std::uint32_t face = 4 * c; face < 4 * c + 4; ++face) {
        const std::uint32_t partner = tets.partner(face);
        if (partner == kNone || part[partner / 4] != kNone) continue;
        part[partner / 4] = seed;
        open.push_back(partner / 4);
      }
    }
    EXPECT_GE(sum, -1e-12) << "the part of cell " << seed;
  }

  // The walkable form says the same in its own words.
  const WalkableTets walkable =
      make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), true);
  EXPECT_EQ(walkable.original_cells, tets.original);
  std::size_t boundary = 0;
  for (std::uint32_t face = 0; face < partners.size(); ++face) {
    const WalkableTets::Link link = walkable.cells[face / 4][face % 4];
    const std::uint32_t partner = tets.partner(face);
    if (partner != kNone) {
      ASSERT_EQ(link.cell, partner / 4);
      ASSERT_EQ(link.apex, tets.point(partner));
      continue;
    }
    ASSERT_EQ(link.cell, kNone);
    ASSERT_LT(boundary, walkable.boundary.size());
    const WalkableTets::Boundary& seen = walkable.boundary[boundary++];
    EXPECT_EQ(seen.cell, face / 4);
    EXPECT_EQ(seen.apex, tets.point(face));
  }
  EXPECT_EQ(boundary, walkable.boundary.size());
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

TEST_P(FlawedBox, IsTheSameForAnyNumberOfThreads) {
  // Large enough that each step has several ranges to share among threads.
  const Mesh mesh = flawed_box(20, GetParam());
  const auto make = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), true);
  };
  const WalkableTets one = make(1);
  for (const std::size_t threads : {2u, 2u, 5u}) {
    const WalkableTets several = make(threads);
    EXPECT_TRUE(same_bytes(several.cells, one.cells));
    EXPECT_TRUE(same_bytes(several.points, one.points));
    EXPECT_TRUE(same_bytes(several.boundary, one.boundary));
    EXPECT_EQ(several.original_cells, one.original_cells);
    ASSERT_EQ(several.findings.size(), one.findings.size());
    for (std::size_t i = 0; i < one.findings.size(); ++i)
      EXPECT_EQ(describe(several.findings[i]), describe(one.findings[i]));
  }
}

INSTANTIATE_TEST_SUITE_P(Flaws, FlawedBox,
                         testing::Values(0, kMirrored, kTangled, kMirrored | kTangled,
                                         kTangled | kTurned, kShuffled, kTurned, kRepeated,
                                         kCrowded, kUnused, kShuffled | kTurned | kRepeated,
                                         kShuffled | kTurned | kRepeated | kCrowded | kUnused));

TEST(TetAdjacency, NamesTheFlawsOfABox) {
  std::set<std::string> named;
  for (const unsigned flaw : {kTurned, kRepeated, kCrowded})
    for (const Finding& finding : adjacency_of(flawed_box(7, flaw)).findings)
      named.insert(finding.what);
  EXPECT_TRUE(named.count("tetrahedra listed with the opposite orientation, turned around"));
  EXPECT_TRUE(named.count("tetrahedra with repeated points left out"));
  EXPECT_TRUE(named.count("faces shared by more than two cells"));
}

// How many cells are turned around of two boxes that do not touch.
std::size_t turned_cells(unsigned first, unsigned second) {
  Mesh mesh = flawed_box(6, first);
  const Mesh other = flawed_box(6, second);
  std::vector<double> points;
  for (const double shift : {0.0, 3.0})
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      points.push_back((shift > 0 ? other : mesh).points.at<double>(i) + shift);
  Ids ids = ids_of(mesh);
  for (const std::int32_t id : ids_of(other))
    ids.push_back(id + static_cast<std::int32_t>(mesh.point_count()));
  std::size_t turned = 0;
  for (const Finding& finding :
       adjacency_of(make_mesh(CellType::tetrahedron, std::move(points), std::move(ids))).findings) {
    EXPECT_EQ(finding.what, "tetrahedra listed with the opposite orientation, turned around");
    turned += finding.count;
  }
  return turned;
}

TEST(TetAdjacency, TurnsThePartsWhoseVolumeIsNegativeAndNoOthers) {
  constexpr std::size_t kBox = 6 * 6 * 6 * 6;
  ASSERT_FALSE(find_poor_cells(flawed_box(6, kTangled)).empty());
  EXPECT_EQ(turned_cells(0, 0), 0u);
  EXPECT_EQ(turned_cells(kTangled, 0), 0u);
  EXPECT_EQ(turned_cells(kTangled, kTangled), 0u);
  EXPECT_EQ(turned_cells(0, kMirrored), kBox);
  EXPECT_EQ(turned_cells(kTangled, kMirrored), kBox);
  EXPECT_EQ(turned_cells(kMirrored | kTangled, kTangled), kBox);
  EXPECT_EQ(turned_cells(kMirrored, kMirrored), 2 * kBox);
  EXPECT_EQ(turned_cells(kMirrored, kMirrored | kTangled), 2 * kBox);
}

// Tetrahedra of four consecutive points of a list each, so that neighbours share three; the last
// face is the first.
Mesh closed_strip(const Ids& list) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 1);
  std::vector<double> points;
  for (int i = 0; i <= 3 * *std::max_element(list.begin(), list.end()) + 2; ++i)
    points.push_back(place(random));
  Ids ids;
  for (std::size_t i = 0; i + 3 < list.size(); ++i) ids.insert(ids.end(), &list[i], &list[i] + 4);
  return make_mesh(CellType::tetrahedron, std::move(points), std::move(ids));
}

TEST(TetAdjacency, AOneSidedStripIsCutOnce) {
  const TetAdjacency twisted = adjacency_of(closed_strip({0, 1, 2, 3, 4, 5, 6, 7, 8, 1, 0, 2}));
  const auto is_cut = [](const Finding& finding) {
    return finding.what == "faces where neighbours cannot agree on a side, taken as boundary";
  };
  const auto cut = std::find_if(twisted.findings.begin(), twisted.findings.end(), is_cut);
  ASSERT_NE(cut, twisted.findings.end());
  EXPECT_EQ(cut->count, 2u);  // one face, seen from both of its cells
  const auto partners = partners_of(twisted);
  std::size_t joined = 0, faces = 0;
  for (std::uint32_t face = 0; face < partners.size(); ++face) {
    faces += partners[face] != kNone;
    const std::uint32_t partner = twisted.partner(face);
    if (partner == kNone) continue;
    ++joined;
    EXPECT_EQ(partner, partners[face]);
    EXPECT_TRUE(twisted.agree(face, partner));
  }
  EXPECT_EQ(faces, joined + 2);

  const TetAdjacency plain = adjacency_of(closed_strip({0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 1, 2}));
  EXPECT_TRUE(std::none_of(plain.findings.begin(), plain.findings.end(), is_cut));
}

}  // namespace
}  // namespace plume::test
