// Ranges over blocks of a rectilinear grid.

#include "plume/mesh/range_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "plume/datasets/generate.h"

namespace plume::test {
namespace {

WalkableRectilinear grid(int size, const std::string& field) {
  const Mesh mesh = generate("box-rectilinear", {size, 0.4, 5});
  return make_walkable_rectilinear(mesh, select_field(mesh, {field, {}}));
}

struct Counted {
  float least = std::numeric_limits<float>::infinity(), greatest = -least;
};

// Of all values in the block around a cell, one by one.
Counted counted(const WalkableRectilinear& mesh, const std::array<std::uint32_t, 3>& cell,
                std::uint32_t edge) {
  const bool on_points = mesh.cell_values.empty();
  Counted range;
  const std::uint32_t more = on_points ? 1 : 0;
  std::array<std::uint32_t, 3> first, last;
  for (std::size_t a = 0; a < 3; ++a) {
    first[a] = cell[a] / edge * edge;
    last[a] = std::min(first[a] + edge, mesh.points(a) - 1) + more;
  }
  const std::uint32_t row = mesh.points(0) - 1 + more, rows = mesh.points(1) - 1 + more;
  for (std::uint32_t k = first[2]; k < last[2]; ++k)
    for (std::uint32_t j = first[1]; j < last[1]; ++j)
      for (std::uint32_t i = first[0]; i < last[0]; ++i) {
        const std::size_t at = i + row * (j + std::size_t{rows} * k);
        const float value = on_points ? mesh.point_values[at] : mesh.cell_values[at];
        range.least = std::fmin(range.least, value);
        range.greatest = std::fmax(range.greatest, value);
      }
  return range;
}

TEST(RangeTree, HoldsAllValuesAndLittleMore) {
  for (const char* field : {"waves", "cell_radius"})
    for (const int size : {1, 4, 5, 17, 33}) {
      const WalkableRectilinear mesh = grid(size, field);
      const RangeTree tree(mesh);
      for (std::size_t level = 0; level < tree.level_count(); ++level) {
        const std::uint32_t edge = RangeTree::kEdge << level;
        // One cell of each block.
        for (std::uint32_t k = 0; k + 1 < mesh.points(2); k += edge)
          for (std::uint32_t j = 0; j + 1 < mesh.points(1); j += edge)
            for (std::uint32_t i = 0; i + 1 < mesh.points(0); i += edge) {
              const RangeTree::Range& range = tree.around({i, j, k}, level);
              const Counted right = counted(mesh, {i, j, k}, edge);
              ASSERT_LE(range.least, right.least);
              ASSERT_GE(range.greatest, right.greatest);
              const float scale = std::max(std::abs(right.least), std::abs(right.greatest));
              ASSERT_NEAR(range.least, right.least, 3e-6f * scale) << field << size;
              ASSERT_NEAR(range.greatest, right.greatest, 3e-6f * scale) << field << size;
            }
      }
      EXPECT_GE(RangeTree::kEdge << (tree.level_count() - 1), mesh.points(0) - 1);
    }
}

TEST(RangeTree, TakesLittleMemory) {
  const WalkableRectilinear mesh = grid(64, "waves");
  EXPECT_LE(static_cast<double>(RangeTree(mesh).bytes()),
            0.15 * static_cast<double>(mesh.cell_count()));
}

TEST(RangeTree, PassesOverNaNAndKeepsInfinity) {
  WalkableRectilinear mesh = grid(8, "waves");
  std::fill(mesh.point_values.begin(), mesh.point_values.end(),
            std::numeric_limits<float>::quiet_NaN());
  EXPECT_GT(RangeTree(mesh).around({0, 0, 0}, 0).least,
            RangeTree(mesh).around({0, 0, 0}, 0).greatest);
  mesh.point_values[0] = 2;
  EXPECT_NEAR(RangeTree(mesh).around({0, 0, 0}, 0).least, 2, 1e-5);
  EXPECT_NEAR(RangeTree(mesh).around({0, 0, 0}, 1).greatest, 2, 1e-5);
  mesh.point_values[1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(RangeTree(mesh).around({0, 0, 0}, 1).greatest, std::numeric_limits<float>::infinity());
}

TEST(RangeTree, KnowsHowManyCellsMatter) {
  const WalkableRectilinear mesh = grid(19, "radius");
  const RangeTree tree(mesh);
  EXPECT_EQ(tree.share_of([](float, float) { return true; }), 1);
  EXPECT_EQ(tree.share_of([](float, float) { return false; }), 0);
  auto matters = [](float least, float greatest) { return least < 0.4f && greatest > 0.3f; };
  std::size_t cells = 0;
  for (std::uint32_t k = 0; k + 1 < mesh.points(2); ++k)
    for (std::uint32_t j = 0; j + 1 < mesh.points(1); ++j)
      for (std::uint32_t i = 0; i + 1 < mesh.points(0); ++i) {
        const RangeTree::Range& range = tree.around({i, j, k}, 0);
        cells += matters(range.least, range.greatest) ? 1 : 0;
      }
  EXPECT_GT(cells, 0u);
  EXPECT_DOUBLE_EQ(tree.share_of(matters),
                   static_cast<double>(cells) / static_cast<double>(mesh.cell_count()));
}

}  // namespace
}  // namespace plume::test
