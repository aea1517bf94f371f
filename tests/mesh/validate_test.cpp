// Bad meshes get one clear error that names the place, the value and the remedy.

#include "plume/mesh/validate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "plume/mesh/error.h"
#include "test_meshes.h"

namespace plume::test {
namespace {

std::string error_of(const Mesh& mesh) {
  try {
    check_structure(mesh);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(CheckStructure, AcceptsASoundMesh) { EXPECT_EQ(error_of(two_tetrahedra()), "no error"); }

TEST(CheckStructure, NamesThePointThatIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    Mesh mesh =
        make_mesh(CellType::tetrahedron, {0, 0, 0, 1, 0, 0, 0, bad, 0, 0, 0, 1}, {0, 1, 2, 3});
    EXPECT_NE(error_of(mesh).find("point 2 is at (0, "), std::string::npos) << error_of(mesh);
  }
}

TEST(CheckStructure, NamesTheCellWhoseIdsAreOutOfRange) {
  for (const std::int32_t bad : {5, -1}) {
    Mesh mesh = two_tetrahedra();
    mesh.cells.connectivity = Array::own(std::vector<std::int32_t>{0, 1, 2, 3, 4, 1, 3, bad});
    EXPECT_EQ(error_of(mesh),
              "cell 1 refers to point " + std::to_string(bad) + ", but the mesh has points 0 to 4");
  }
}

TEST(CheckStructure, NamesTheCellWhoseOffsetsAreOutOfOrder) {
  Mesh mesh = two_tetrahedra();
  mesh.cells.offsets = Array::own(std::vector<std::int64_t>{0, 4, 99});
  EXPECT_NE(error_of(mesh).find("cell 1 claims connectivity 4 to 99 of 8"), std::string::npos)
      << error_of(mesh);
  mesh.cells.offsets = Array::own(std::vector<std::int64_t>{0, 5, 8});
  EXPECT_EQ(error_of(mesh), "cell 0, a tetrahedron, has 5 points instead of 4");
}

TEST(CheckStructure, RefusesWhatIsNoVolume) {
  Mesh mesh = two_tetrahedra();
  mesh.cells.types = Array::own(std::vector<std::uint8_t>{10, 5});
  mesh.cells.offsets = Array::own(std::vector<std::int32_t>{0, 4, 8});
  EXPECT_NE(error_of(mesh).find("cell 1 is of type 5"), std::string::npos) << error_of(mesh);
  Mesh flat;
  flat.points = Array::own(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  flat.dimensions = {2, 2, 1};
  EXPECT_EQ(error_of(flat), "a grid of 2 x 2 x 1 points has no volume cells");
  EXPECT_EQ(error_of(Mesh{}), "the mesh has no points");
}

TEST(CheckStructure, RefusesAGridWithPointsMissing) {
  Mesh grid;
  grid.points = Array::own(std::vector<float>(3 * 7, 0.0f));
  grid.dimensions = {2, 2, 2};
  EXPECT_EQ(error_of(grid), "a grid of 2 x 2 x 2 points needs 8 points and has 7");
}

TEST(CheckStructure, RefusesFacesBeyondTheStream) {
  const Mesh mesh = one_polyhedron({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {4, 3, 0, 1, 2, 3, 0, 1});
  EXPECT_NE(error_of(mesh).find("cell 0, a polyhedron, has faces beyond"), std::string::npos)
      << error_of(mesh);
}

TEST(FindPoorCells, NamesWhatIsInsideOutFlatOrRepeated) {
  // Cells 0 and 4 are sound, 1 is inside out, 2 flat, 3 has a point twice.
  const Mesh mesh = make_mesh(CellType::tetrahedron, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0},
                              {0, 1, 2, 3, 0, 2, 1, 3, 0, 1, 2, 4, 0, 1, 1, 3, 1, 4, 2, 3});
  const auto findings = find_poor_cells(mesh);
  ASSERT_EQ(findings.size(), 3u);
  EXPECT_EQ(describe(findings[0]), "1 cells inside out: 1");
  EXPECT_EQ(describe(findings[1]), "2 cells of zero volume: 2, 3");
  EXPECT_EQ(describe(findings[2]), "1 cells with repeated points: 3");
}

TEST(FindPoorCells, ALeftHandedMeshIsNotInsideOut) {
  Mesh mesh = make_mesh(CellType::tetrahedron, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 3});
  EXPECT_TRUE(find_poor_cells(mesh).empty());
}

}  // namespace
}  // namespace plume::test
