// Rectilinear grids: what is refused, what they hold, and that they are the curvilinear grid of the
// same points.

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>

#include "plume/datasets/generate.h"
#include "plume/mesh/connected_parts.h"
#include "plume/mesh/error.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/rectilinear_axes.h"
#include "plume/mesh/validate.h"

namespace plume::test {
namespace {

Mesh grid(std::vector<double> x, std::vector<double> y, std::vector<double> z) {
  Mesh mesh;
  mesh.dimensions = {static_cast<std::int64_t>(x.size()), static_cast<std::int64_t>(y.size()),
                     static_cast<std::int64_t>(z.size())};
  mesh.axes = {Array::own(std::move(x)), Array::own(std::move(y)), Array::own(std::move(z))};
  mesh.fields.push_back(
      {"number", Association::point, 1, Array::own(std::vector<float>(mesh.point_count(), 1.0f))});
  return mesh;
}

std::string error_of(const Mesh& mesh) {
  try {
    check_structure(mesh);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(RectilinearAxes, MayAscendAndDescend) {
  const Mesh mesh = grid({1, 2, 4}, {3, 2, -1, -1.5}, {1e7, 1e7 + 1e-3});
  const Bounds bounds = check_structure(mesh);
  EXPECT_EQ(bounds.low, (std::array<double, 3>{1, -1.5, 1e7}));
  EXPECT_EQ(bounds.high, (std::array<double, 3>{4, 3, 1e7 + 1e-3}));
  EXPECT_EQ(mesh.point_count(), 24u);
  EXPECT_EQ(mesh.cell_count(), 6u);
  EXPECT_EQ(point_at(mesh, 5), (std::array<double, 3>{4, 2, 1e7}));
  EXPECT_TRUE(find_poor_cells(mesh).empty());
}

TEST(RectilinearAxes, NameWhatIsWrong) {
  EXPECT_EQ(error_of(grid({0, 1}, {0, 1, 1, 2}, {0, 1})),
            "the y coordinate 2 is 1 after 1, but from 0 to 2 they must strictly ascend; sort them "
            "and the values with them, or give the grid's points (.vts)");
  EXPECT_NE(error_of(grid({0, 1}, {0, 1}, {5, 3, 4, 1})).find("the z coordinate 2 is 4 after 3, "),
            std::string::npos);
  EXPECT_NE(error_of(grid({0, 0}, {0, 1}, {0, 1})).find("the x coordinate 1 is 0 after 0"),
            std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(grid({0, nan, 1}, {0, 1}, {0, 1})),
            "the x coordinate 1 is nan: coordinates must be finite; repair the axis");
  EXPECT_NE(error_of(grid({0, 1}, {0, 1}, {0, std::numeric_limits<double>::infinity()}))
                .find("the z coordinate 1 is inf"),
            std::string::npos);
  EXPECT_EQ(error_of(grid({0, 1}, {3}, {0, 1, 2})),
            "a grid of 2 x 1 x 3 points has no volume cells");

  Mesh mesh = grid({0, 1}, {0, 1}, {0, 1});
  mesh.dimensions[2] = 3;
  EXPECT_EQ(error_of(mesh), "a grid of 2 x 2 x 3 points has 2 coordinates along z");
  mesh = grid({0, 1}, {0, 1}, {0, 1});
  mesh.points = Array::own(std::vector<float>(24));
  EXPECT_NE(error_of(mesh).find("24 values of points; leave out one of the two"),
            std::string::npos);
  mesh = grid({0, 1}, {0, 1}, {0, 1});
  mesh.hidden_cells = Array::own(std::vector<std::uint8_t>{0, 1});
  EXPECT_EQ(error_of(mesh), "hidden_cells has 2 values for 1 cells");
  mesh.fields[0].values = Array::own(std::vector<float>(7));
  EXPECT_THROW(select_field(mesh), Error);
}

TEST(RectilinearAxes, RefuseMoreThanCanBeNumbered) {
  Mesh mesh;
  std::vector<double> axis(1626);
  for (std::size_t i = 0; i < axis.size(); ++i) axis[i] = static_cast<double>(i);
  for (std::size_t a = 0; a < 3; ++a) {
    mesh.axes[a] = Array::own(axis);
    mesh.dimensions[a] = 1626;
  }
  EXPECT_EQ(error_of(mesh), "a grid of 1626 x 1626 x 1626 points has more than Plume can number");
  axis.pop_back();
  for (std::size_t a = 0; a < 3; ++a) {
    mesh.axes[a] = Array::own(axis);
    mesh.dimensions[a] = 1625;
  }
  EXPECT_EQ(error_of(mesh), "no error");
}

TEST(RectilinearAxes, WriteTheirPointsOut) {
  Mesh mesh = grid({1, 2, 4}, {3, 2, -1, -1.5}, {0, 7});
  const Mesh points = with_points(mesh);
  EXPECT_FALSE(points.is_rectilinear());
  EXPECT_EQ(points.points.type(), Array::Type::float64);
  EXPECT_EQ(points.dimensions, mesh.dimensions);
  EXPECT_EQ(points.cell_count(), mesh.cell_count());
  ASSERT_EQ(points.point_count(), mesh.point_count());
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    EXPECT_EQ(point_at(points, p), point_at(mesh, p));
  for (Array& axis : mesh.axes) axis = Array::own(std::vector<float>{0, 1});
  mesh.dimensions = {2, 2, 2};
  EXPECT_EQ(with_points(mesh).points.type(), Array::Type::float32);
}

TEST(WalkableRectilinear, HoldsItsScalarsAndNothingElse) {
  Mesh mesh = generate("box-rectilinear", {20, 0.2, 1});
  const std::size_t planes = 3 * 21, widths = 3 * 20;
  const auto bytes = [&](Association association) {
    const ScalarField field = select_field(
        mesh, {association == Association::point ? "radius" : "cell_radius", association});
    return make_walkable_rectilinear(mesh, field).bytes();
  };
  EXPECT_EQ(bytes(Association::point), 4u * 21 * 21 * 21 + 8 * (planes + widths));
  EXPECT_EQ(bytes(Association::cell), 4u * 20 * 20 * 20 + 8 * (planes + widths));
  // A bit a cell where some are hidden; none where none is.
  std::vector<std::uint8_t> hidden(8000, 0);
  mesh.hidden_cells = Array::own(hidden);
  EXPECT_EQ(bytes(Association::point), 4u * 21 * 21 * 21 + 8 * (planes + widths));
  hidden[77] = 1;
  mesh.hidden_cells = Array::own(hidden);
  EXPECT_EQ(bytes(Association::point), 4u * 21 * 21 * 21 + 8 * (planes + widths) + 1000);
}

TEST(WalkableRectilinear, HasTheFacesAndPartsOfTheCurvilinearGrid) {
  for (const double share : {0.0, 0.1, 0.5, 0.9}) {
    Mesh mesh = generate("box-rectilinear", {7, 0.2, 1});
    std::mt19937_64 random(5);
    std::vector<std::uint8_t> hidden(mesh.cell_count());
    for (auto& h : hidden) h = static_cast<double>(random() >> 11) * 0x1p-53 < share ? 1 : 0;
    mesh.hidden_cells = Array::own(std::move(hidden));
    const Bounds bounds = check_structure(mesh);
    const WalkableRectilinear ours = make_walkable_rectilinear(mesh, select_field(mesh));
    const WalkableGrid theirs = make_walkable_grid(with_points(mesh), select_field(mesh), bounds);
    EXPECT_EQ(ours.boundary_face_count(), theirs.boundary.size()) << share;
    EXPECT_EQ(connected_parts(ours), connected_parts(theirs)) << share;
    ASSERT_EQ(ours.cell_count(), theirs.cell_count());
    for (std::uint32_t cell = 0; cell < ours.cell_count(); ++cell)
      for (std::uint32_t face = 0; face < 6; ++face)
        ASSERT_EQ(ours.neighbor(cell, face), theirs.neighbor(cell, face));
    ASSERT_EQ(ours.findings.size(), theirs.findings.size());
    if (!ours.findings.empty()) {
      EXPECT_EQ(describe(ours.findings[0]), describe(theirs.findings[0]));
    }
  }
}

}  // namespace
}  // namespace plume::test
