// Clusters of cells hold their cells, and say which of them a ray might go back in.

#include "plume/mesh/cell_clusters.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/mesh/crooked_cell.h"
#include "plume/mesh/validate.h"

namespace plume::test {
namespace {

void expect_inside(const ClusterTree& tree, std::size_t leaf, const WalkablePoint& p) {
  for (std::uint32_t level = 0; level < tree.depth(); ++level) {
    const auto& node = tree.nodes[tree.levels[level] + leaf / 8];
    const std::size_t child = leaf % 8;
    EXPECT_LE(node.least[child], node.greatest[child]);
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_LE(node.low[a][child], p.position[a]);
      EXPECT_GE(node.high[a][child], p.position[a]);
    }
    leaf /= 8;
  }
}

template <class Mesh>
void expect_held(const Mesh& mesh, std::size_t visible_cells, const std::string& which) {
  const CellClusters clusters = make_cell_clusters(mesh);
  std::vector<int> seen(mesh.cell_count());
  std::size_t cells_seen = 0;
  for (std::size_t leaf = 0; leaf < clusters.leaf_count(); ++leaf) {
    const CellClusters::Cells cells = clusters.cells_of(mesh, leaf);
    for (std::size_t place = 0; place < cells.size; ++place) {
      const std::uint32_t cell = cells.cell[place];
      EXPECT_EQ(seen[cell]++, 0) << which;
      ++cells_seen;
      EXPECT_EQ(clusters.crooked[leaf] >> place & 1, is_crooked(mesh, cell) ? 1 : 0) << which;
      for_each_point_of(mesh, cell, [&](std::uint32_t point) {
        expect_inside(clusters.cells, leaf, mesh.points[point]);
        const auto& node = clusters.cells.nodes[leaf / 8];
        EXPECT_LT(node.least[leaf % 8], mesh.points[point].scalar) << which;
        EXPECT_GT(node.greatest[leaf % 8], mesh.points[point].scalar) << which;
      });
    }
  }
  EXPECT_EQ(cells_seen, visible_cells) << which;
  std::vector<int> faces(mesh.boundary.size());
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    const std::uint32_t face = clusters.face(f / kClusterSize, f % kClusterSize);
    EXPECT_EQ(faces[face]++, 0) << which;
    for_each_point_of(mesh, mesh.boundary[face], [&](std::uint32_t point) {
      expect_inside(clusters.boundary, f / kClusterSize, mesh.points[point]);
    });
  }
  // Edges of a grid leave blocks that are not full.
  EXPECT_LE(static_cast<double>(clusters.bytes()),
            3.5 * static_cast<double>(visible_cells) +
                7 * static_cast<double>(mesh.boundary.size()) + 1024)
      << which;
}

WalkableGrid grid_of(const Mesh& mesh) {
  return make_walkable_grid(mesh, select_field(mesh), check_structure(mesh));
}
WalkableCells cells_of(const Mesh& mesh) {
  return make_walkable_cells(mesh, select_field(mesh), check_structure(mesh), false);
}

TEST(CellClusters, HoldTheirCells) {
  for (const int size : {1, 3, 16, 17}) {
    const WalkableGrid grid = grid_of(generate("box-hexahedra", {size, 0.2, 7}));
    expect_held(grid, grid.cell_count(), "grid");
  }
  for (const char* name : {"box-mixed", "box-polyhedra"}) {
    const WalkableCells cells = cells_of(generate(name, {5, 0.2, 7}));
    expect_held(cells, cells.cell_count(), name);
  }
}

TEST(CellClusters, LeaveOutHiddenCells) {
  WalkableGrid grid = grid_of(generate("box-hexahedra", {6, 0.2, 7}));
  grid.hidden.assign(grid.cell_count(), false);
  for (const std::size_t cell : {0, 7, 100}) grid.hidden[cell] = true;
  expect_held(grid, grid.cell_count() - 3, "hidden");
}

std::size_t crooked_in(const WalkableGrid& grid) {
  std::size_t count = 0;
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell)
    count += is_crooked(grid, cell) ? 1 : 0;
  return count;
}

TEST(CrookedCell, AreThoseThatAreTangledOrFlat) {
  EXPECT_EQ(crooked_in(grid_of(generate("box-hexahedra", {6, 0.0, 7}))), 0u);
  EXPECT_EQ(crooked_in(grid_of(generate("box-hexahedra", {6, 0.2, 7}))), 0u);
  EXPECT_EQ(crooked_in(grid_of(generate("twisted", {6, 0.3, 7}))), 0u);
  EXPECT_GT(crooked_in(grid_of(generate("box-hexahedra", {6, 3, 7}))), 150u);
  WalkableGrid turned = grid_of(generate("box-hexahedra", {6, 0.2, 7}));
  turned.left_handed = !turned.left_handed;
  EXPECT_EQ(crooked_in(turned), turned.cell_count());
  WalkableGrid flat = grid_of(generate("box-hexahedra", {6, 0.2, 7}));
  for (WalkablePoint& p : flat.points) p.position[2] *= 1e-6f;
  EXPECT_EQ(crooked_in(flat), flat.cell_count());
}

TEST(CrookedCell, AreNoneOfAnyKindInABoxThatIsNot) {
  for (const char* name : {"box-mixed", "box-polyhedra", "box-wedges"}) {
    const WalkableCells cells = cells_of(generate(name, {4, 0.1, 7}));
    for (std::uint32_t cell = 0; cell < cells.cell_count(); ++cell)
      EXPECT_FALSE(is_crooked(cells, cell)) << name << ' ' << cell;
  }
}

}  // namespace
}  // namespace plume::test
