// Cell data made point data.

#include "plume/mesh/cell_to_point.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "moved_mesh.h"
#include "test_meshes.h"

namespace plume::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
const char* const kForms[] = {"box-tetrahedra", "box-hexahedra", "twisted",   "box-wedges",
                              "box-mixed",      "box-polyhedra", "two-blocks"};

double linear(const Vector& p) { return 0.25 + p[0] - 2 * p[1] + 0.5 * p[2]; }
double smooth(const Vector& p) {
  return std::sin(2 * p[0] + 1) * std::cos(1.5 * p[1]) * std::exp(p[2]);
}

bool is_inside(const Vector& p) {
  return std::all_of(p.begin(), p.end(), [](double x) { return x > 0 && x < 1; });
}

TEST(CellToPoint, AConstantStaysSoToTheLastBit) {
  for (const char* form : kForms) {
    const Mesh mesh = generate(form, {5, 0.2, 2});
    const ScalarField points =
        average_to_points(mesh, cell_field(mesh, [](const Vector&) { return 1.1; }));
    EXPECT_EQ(points.association, Association::point);
    EXPECT_EQ(points.name, "of cells");
    ASSERT_EQ(points.values.size(), mesh.point_count());
    for (const float value : points.values) ASSERT_EQ(value, 1.1f) << form;
    EXPECT_EQ(points.low, 1.1f);
    EXPECT_EQ(points.high, 1.1f);
    EXPECT_EQ(points.not_finite, 0u);
  }
}

TEST(CellToPoint, StaysWithinTheRangeOfTheCellsAround) {
  for (const char* form : kForms) {
    const Mesh mesh = generate(form, {5, 0.2, 2});
    const ScalarField cells = cell_field(mesh, smooth);
    const ScalarField points = average_to_points(mesh, cells);
    std::vector<float> low(mesh.point_count(), 1e9f), high(mesh.point_count(), -1e9f);
    const CellReader reader(mesh);
    std::vector<std::uint32_t> ids;
    for (std::size_t c = 0; c < reader.size(); ++c) {
      reader.points(c, ids);
      for (const std::uint32_t id : ids) {
        low[id] = std::min(low[id], cells.values[c]);
        high[id] = std::max(high[id], cells.values[c]);
      }
    }
    for (std::size_t p = 0; p < mesh.point_count(); ++p) {
      ASSERT_GE(points.values[p], low[p] - 1e-6f);
      ASSERT_LE(points.values[p], high[p] + 1e-6f);
    }
  }
}

TEST(CellToPoint, IsTheInverseDistanceWeightedMean) {
  // Two cells of different size: centres at 1 and at 3.5 of the points between them at x = 2.
  Mesh mesh;
  mesh.dimensions = {3, 2, 2};
  std::vector<double> points;
  for (const double z : {0.0, 0.0})  // flat, so that distances are along x and y alone
    for (const double y : {0.0, 0.0})
      for (const double x : {0.0, 2.0, 5.0}) points.insert(points.end(), {x, y, z});
  mesh.points = Array::own(points);
  ScalarField cells;
  cells.association = Association::cell;
  cells.values = {10, 20};
  const ScalarField result = average_to_points(mesh, cells);
  EXPECT_EQ(result.values[0], 10);
  EXPECT_FLOAT_EQ(result.values[1], (10 / 1.0 + 20 / 1.5) / (1 / 1.0 + 1 / 1.5));
  EXPECT_EQ(result.values[2], 20);
}

TEST(CellToPoint, IsExactForLinearFieldsInsideOfRegularMeshes) {
  for (const char* form : {"box-hexahedra", "two-blocks", "box-tetrahedra", "box-wedges"}) {
    const Mesh mesh = generate(form, {6, 0, 1});
    const ScalarField points = average_to_points(mesh, cell_field(mesh, linear));
    std::size_t checked = 0;
    for (std::size_t p = 0; p < mesh.point_count(); ++p) {
      const Vector at = point_at(mesh, p);
      // Two blocks have a boundary between them.
      if (!is_inside(at) || (form == std::string("two-blocks") && at[0] == 0.5)) continue;
      ASSERT_NEAR(points.values[p], linear(at), 1e-6) << form;
      ++checked;
    }
    EXPECT_GE(checked, 100u) << form;
  }
}

TEST(CellToPoint, Converges) {
  for (const char* form : {"box-hexahedra", "box-tetrahedra", "box-mixed", "box-polyhedra"}) {
    double before[2] = {0, 0}, order[2] = {0, 0};
    std::printf("%-15s max error at all points, inside:", form);
    for (const int size : {4, 8, 16, 32}) {
      const Mesh plain = generate(form, {size, 0, 1});
      const Mesh mesh = moved_mesh(plain, twisted_cube);
      const ScalarField points = average_to_points(mesh, cell_field(mesh, smooth));
      double worst[2] = {0, 0};
      for (std::size_t p = 0; p < mesh.point_count(); ++p) {
        const double off = std::abs(points.values[p] - smooth(point_at(mesh, p)));
        for (std::size_t k = 0; k < (is_inside(point_at(plain, p)) ? 2u : 1u); ++k)
          worst[k] = std::max(worst[k], off);
      }
      for (std::size_t k = 0; k < 2; ++k) {
        order[k] = std::log2(before[k] / worst[k]);
        before[k] = worst[k];
      }
      std::printf("  %.1e %.1e", before[0], before[1]);
    }
    std::printf("  orders %.2f %.2f\n", order[0], order[1]);
    EXPECT_GT(order[0], 0.85) << form;
    EXPECT_GT(order[1], form == std::string("box-hexahedra") ? 1.8 : 0.85) << form;
  }
}

TEST(CellToPoint, PassesOverCellsWithoutAValue) {
  const Mesh mesh = generate("box-hexahedra", {4, 0, 1});
  ScalarField cells = cell_field(mesh, [](const Vector&) { return 2.0; });
  // Cell 0 has a corner for itself, cells 0 and 1 have an edge's points.
  cells.values[0] = cells.values[1] = kNaN;
  const ScalarField points = average_to_points(mesh, cells);
  EXPECT_EQ(points.not_finite, 2u);
  for (std::size_t p = 0; p < points.values.size(); ++p) {
    if (p == 0 || p == 1)
      EXPECT_TRUE(std::isnan(points.values[p]));
    else
      EXPECT_EQ(points.values[p], 2) << p;
  }
  std::fill(cells.values.begin(), cells.values.end(), kNaN);
  const ScalarField none = average_to_points(mesh, cells);
  EXPECT_EQ(none.not_finite, mesh.point_count());
  EXPECT_EQ(none.low, 0);
  EXPECT_EQ(none.high, 0);
}

TEST(CellToPoint, LeavesOutHiddenCells) {
  Mesh mesh = generate("box-hexahedra", {4, 0, 1});
  ScalarField cells = cell_field(mesh, [](const Vector&) { return 2.0; });
  std::vector<std::uint8_t> hidden(mesh.cell_count(), 0);
  for (const std::size_t c : {0, 1, 5, 42}) {
    hidden[c] = 1;
    cells.values[c] = 1000;
  }
  mesh.hidden_cells = Array::own(hidden);
  const ScalarField points = average_to_points(mesh, cells);
  EXPECT_EQ(points.not_finite, 0u);  // points 0 and 1 are of no visible cell
  EXPECT_TRUE(std::isnan(points.values[0]) && std::isnan(points.values[1]));
  for (std::size_t p = 2; p < points.values.size(); ++p) EXPECT_EQ(points.values[p], 2) << p;
  EXPECT_EQ(points.high, 2);
}

TEST(CellToPoint, TakesCellsWhoseCentreIsAtThePointAlone) {
  // A cell without extent at a point, besides one with.
  const Mesh mesh = make_mesh(CellType::tetrahedron, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                              {0, 1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0});
  ScalarField cells;
  cells.association = Association::cell;
  cells.values = {5, 7, 8};
  const ScalarField points = average_to_points(mesh, cells);
  EXPECT_EQ(points.values[0], 7.5f);
  EXPECT_EQ(points.values[1], 5);
}

TEST(CellToPoint, IsTheSameForAnyNumberOfThreads) {
  for (const char* form : kForms) {
    const Mesh mesh = generate(form, {8, 0.2, 5});
    const ScalarField cells = cell_field(mesh, smooth);
    ScalarField one, two;
    tbb::task_arena(1).execute([&] { one = average_to_points(mesh, cells); });
    tbb::task_arena(2).execute([&] { two = average_to_points(mesh, cells); });
    EXPECT_EQ(one.values, two.values) << form;
  }
}

}  // namespace
}  // namespace plume::test
