// Points become tetrahedra: Delaunay by exact predicates, by each engine that the build has.
#include "plume/mesh/tetrahedralize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "plume/mesh/error.h"
#include "plume/mesh/validate.h"
#include "plume/tests/preint/seeded_rapidcheck.h"
#include "plume/tests/reference/delaunay_property.h"
#include "plume/tests/reference/exact_delaunay.h"
#include "point_clouds.h"

namespace plume::test {
namespace {

using Engine = TetrahedralizationEngine;
using Points = reference::Points;

PointSet point_set(const Points& points) {
  std::vector<double> coordinates, sums;
  for (const auto& p : points) {
    coordinates.insert(coordinates.end(), p.begin(), p.end());
    sums.push_back(p[0] + 2 * p[1] + 3 * p[2]);
  }
  PointSet set;
  set.points = Array::own(std::move(coordinates));
  set.fields.push_back({"sum", Association::point, 1, Array::own(std::move(sums))});
  set.active_field = "sum";
  return set;
}

reference::Tetrahedra tetrahedra_of(const Mesh& mesh) {
  reference::Tetrahedra result(mesh.cell_count());
  for (std::size_t i = 0; i < 4 * result.size(); ++i)
    result[i / 4][i % 4] = mesh.cells.connectivity.at<std::uint32_t>(i);
  return result;
}

std::string error_of(const PointSet& set, Engine engine) {
  try {
    tetrahedralize(set, engine);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

class Tetrahedralize : public testing::TestWithParam<Engine> {
 protected:
  void SetUp() override {
    if (!has_engine(GetParam()))
      GTEST_SKIP() << "SKIPPED FOR LACK OF AN ENGINE: configure with PLUME_WITH_TETGEN and "
                      "PLUME_WITH_CGAL, as ./dev test does";
  }
};

void expect_delaunay(const Points& points, Engine engine) {
  const Tetrahedralization result = tetrahedralize(point_set(points), engine);
  const Mesh& mesh = result.mesh;
  const auto tetrahedra = tetrahedra_of(mesh);
  ASSERT_EQ(mesh.point_count(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) ASSERT_EQ(mesh.points.at<double>(3 * i + a), points[i][a]);
    ASSERT_EQ(mesh.fields[0].values.at<double>(i),
              points[i][0] + 2 * points[i][1] + 3 * points[i][2]);
  }
  EXPECT_EQ(mesh.active_field, "sum");
  EXPECT_EQ(reference::count_not_positive(points, tetrahedra), 0u);
  EXPECT_EQ(reference::count_bad_faces(points, tetrahedra), 0u);
  EXPECT_EQ(reference::count_not_delaunay(points, tetrahedra), 0u);
  // Positive volumes that sum up to the hull's cannot overlap, nor leave a gap.
  const reference::ExactDelaunay exact(points);
  EXPECT_EQ(reference::six_volumes(points, tetrahedra),
            reference::six_volumes(points, exact.tetrahedra()));
  std::set<std::uint32_t> used;
  for (const auto& t : tetrahedra) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), points.size());
  EXPECT_TRUE(result.findings.empty());
  EXPECT_NO_THROW(check_structure(mesh));
}

TEST_P(Tetrahedralize, IsDelaunayAndFillsTheHull) {
  for (const std::string& name : cloud_names()) {
    SCOPED_TRACE(name);
    expect_delaunay(cloud(name, 700), GetParam());
  }
}

TEST_P(Tetrahedralize, FourPointsAreOneTetrahedron) {
  expect_delaunay({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, GetParam());
  expect_delaunay({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}, GetParam());
}

// Points of a lattice of 4^3: nearly always some coincide, are cospherical, or lie in one plane.
TEST_P(Tetrahedralize, TakesWhatSmallLatticesGive) {
  const bool good = rc::check([&] {
    const auto coordinates = *rc::gen::container<std::vector<std::array<int, 3>>>(
        rc::gen::container<std::array<int, 3>>(rc::gen::inRange(0, 4)));
    Points points, distinct;
    std::set<std::array<int, 3>> seen;
    for (const auto& p : coordinates) {
      points.push_back({double(p[0]), double(p[1]), double(p[2])});
      if (seen.insert(p).second) distinct.push_back(points.back());
    }
    bool solid = true;
    std::string volume;
    try {
      volume = reference::six_volumes(distinct, reference::ExactDelaunay(distinct).tetrahedra());
    } catch (const std::invalid_argument&) {
      solid = false;
    }
    const std::string problem = error_of(point_set(points), GetParam());
    RC_ASSERT(problem.empty() == solid);
    if (!solid) return;
    const Tetrahedralization result = tetrahedralize(point_set(points), GetParam());
    const auto tetrahedra = tetrahedra_of(result.mesh);
    RC_ASSERT(result.mesh.point_count() == distinct.size());
    RC_ASSERT(reference::count_not_positive(distinct, tetrahedra) == 0u);
    RC_ASSERT(reference::count_not_delaunay(distinct, tetrahedra) == 0u);
    RC_ASSERT(reference::six_volumes(distinct, tetrahedra) == volume);
    RC_ASSERT(result.findings.empty() == (distinct.size() == points.size()));
  });
  EXPECT_TRUE(good);
}

TEST_P(Tetrahedralize, KeepsTheFirstOfEqualPoints) {
  PointSet set = point_set({{0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}});
  set.fields = {{"label", Association::point, 2,
                 Array::own(std::vector<std::int32_t>{1, 1, 2, 2, 3, 3, 4, 4, 2, 2, 6, 6})}};
  const Tetrahedralization result = tetrahedralize(set, GetParam());
  ASSERT_EQ(result.mesh.point_count(), 4u);
  ASSERT_EQ(result.findings.size(), 2u);
  EXPECT_EQ(describe(result.findings[0]),
            "2 points in the place of an earlier one: left out: 2, 4");
  EXPECT_EQ(result.findings[1].examples, std::vector<std::size_t>{2});
  const Array& values = result.mesh.fields[0].values;
  ASSERT_EQ(values.type(), Array::Type::int32);
  const std::vector<int> expected{1, 1, 2, 2, 4, 4, 6, 6};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(values.at<int>(i), expected[i]);
}

TEST_P(Tetrahedralize, BorrowsThePointsWhereAllDiffer) {
  const std::vector<float> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  PointSet set;
  set.points = Array::borrow<float>(points);
  EXPECT_EQ(tetrahedralize(set, GetParam()).mesh.points.data(), points.data());
}

TEST_P(Tetrahedralize, NamesWhatIsFlat) {
  const auto refused = [&](const Points& points, const std::vector<std::string>& parts) {
    expect_parts(error_of(point_set(points), GetParam()), parts);
  };
  refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {"3 points", "point 1 (1, 0, 0)", "needs four"});
  refused({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}},
          {"5 points, of which 1 differ", "point 0 (1, 2, 3)"});
  for (const double z : {0.0, 1.0, 0.1}) {
    Points plane, line;
    for (int i = 0; i < 30; ++i) {
      plane.push_back({double(i % 6), double(i / 6), z});
      line.push_back({double(i), 2.0 * i, z});
    }
    refused(plane, {"all 30 points are in the plane of point 0 (0, 0,", "point 29 (5, 4,",
                    "need a volume"});
    refused(line, {"all 30 points are on the line through point 0 (0, 0,", "point 29 (29, 58,"});
  }
  Points leaning;
  for (int i = 0; i < 30; ++i)
    leaning.push_back({double(i % 6), double(i / 6), double(i % 6 + i / 6)});
  refused(leaning, {"all 30 points are in the plane of point 0 (0, 0, 0)"});
}

TEST_P(Tetrahedralize, NamesACoordinateThatIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()})
    expect_parts(error_of(point_set({{0, 0, 0}, {1, 0, 0}, {0, bad, 0}, {0, 0, 1}}), GetParam()),
                 {"point 2 is at (0, ", "finite"});
}

TEST_P(Tetrahedralize, NamesAFieldOfTheWrongLength) {
  PointSet set = point_set(cloud("uniform", 10));
  set.fields[0].values = Array::own(std::vector<float>(9));
  expect_parts(error_of(set, GetParam()), {"field 'sum' has 9 values for 10 points"});
  expect_parts(error_of(PointSet{}, GetParam()), {"no points"});
}

INSTANTIATE_TEST_SUITE_P(By, Tetrahedralize, testing::Values(Engine::tetgen, Engine::cgal),
                         [](const auto& engine) {
                           return engine.param == Engine::tetgen ? "TetGen" : "CGAL";
                         });

// Thin beyond what TetGen takes: it may refuse, but only in words; CGAL fills it.
TEST(TetrahedralizeNearlyFlat, IsFilledOrRefused) {
  if (!has_engine(Engine::tetgen) || !has_engine(Engine::cgal))
    GTEST_SKIP() << "SKIPPED FOR LACK OF AN ENGINE";
  for (const double thickness : {1e-6, 1e-9, 1e-12, 1e-15, 1e-30, 1e-300}) {
    Points points = cloud("uniform", 200);
    for (auto& p : points) p[2] *= thickness;
    SCOPED_TRACE(thickness);
    expect_delaunay(points, Engine::cgal);
    if (error_of(point_set(points), Engine::tetgen).empty())
      expect_delaunay(points, Engine::tetgen);
    else
      expect_parts(error_of(point_set(points), Engine::tetgen), {"TetGen", "in the plane of"});
  }
}

// Pairs of points at a distance of 1e-3 to 1e-16 of the cloud's size.
TEST(TetrahedralizeNearlyEqual, IsFilledOrRefused) {
  if (!has_engine(Engine::tetgen) || !has_engine(Engine::cgal))
    GTEST_SKIP() << "SKIPPED FOR LACK OF AN ENGINE";
  for (int digits = 3; digits <= 16; ++digits) {
    Points points = cloud("uniform", 100);
    for (std::size_t i = 0; i < 50; ++i) {
      points.push_back(points[i]);
      points.back()[i % 3] += std::pow(10.0, -digits);
      if (points.back() == points[i]) points.pop_back();
    }
    SCOPED_TRACE(digits);
    expect_delaunay(points, Engine::cgal);
    const std::string problem = error_of(point_set(points), Engine::tetgen);
    if (problem.empty())
      expect_delaunay(points, Engine::tetgen);
    else
      expect_parts(problem, {"TetGen leaves out", "too close", "point "});
  }
}

}  // namespace
}  // namespace plume::test
