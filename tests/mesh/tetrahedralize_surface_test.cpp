// What closed surfaces enclose becomes tetrahedra, by TetGen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "plume/mesh/error.h"
#include "plume/mesh/tetrahedralize.h"
#include "plume/mesh/validate.h"

namespace plume::test {
namespace {

struct Surface {
  std::vector<double> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  // A box whose triangles look outwards, or inwards.
  void add_box(std::array<double, 3> low, std::array<double, 3> high, bool outwards = true) {
    const auto first = static_cast<std::uint32_t>(points.size() / 3);
    for (unsigned i = 0; i < 8; ++i)
      for (unsigned a = 0; a < 3; ++a) points.push_back(i >> a & 1u ? high[a] : low[a]);
    constexpr std::uint32_t kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                             {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                             {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& f : kFaces)
      triangles.push_back({first + f[0], first + f[outwards ? 1 : 2], first + f[outwards ? 2 : 1]});
  }

  TriangleSurface surface() const {
    TriangleSurface result;
    result.vertices.points = Array::own(points);
    result.triangles = triangles;
    return result;
  }
};

Surface box() {
  Surface surface;
  surface.add_box({0, 0, 0}, {1, 1, 1});
  return surface;
}

struct Quality {
  double volume = 0, largest = 0, ratio = 0;
  double angle = 180;  // smallest dihedral angle, degrees
  std::size_t not_positive = 0;
};

using Vector = std::array<double, 3>;
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vector& a) { return std::sqrt(dot(a, a)); }

Quality quality_of(const Mesh& mesh) {
  Quality quality;
  for (std::size_t t = 0; t < mesh.cell_count(); ++t) {
    std::array<Vector, 4> p;
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t a = 0; a < 3; ++a)
        p[c][a] =
            mesh.points.at<double>(3 * mesh.cells.connectivity.at<std::size_t>(4 * t + c) + a);
    const Vector u = minus(p[1], p[0]), v = minus(p[2], p[0]), w = minus(p[3], p[0]);
    const double volume = dot(cross(u, v), w) / 6;
    if (!(volume > 0)) ++quality.not_positive;
    quality.volume += volume;
    quality.largest = std::max(quality.largest, volume);
    Vector center{};  // of the circumscribed sphere, from p[0], times 12 volumes
    const Vector vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
    for (std::size_t a = 0; a < 3; ++a)
      center[a] = dot(u, u) * vw[a] + dot(v, v) * wu[a] + dot(w, w) * uv[a];
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        shortest = std::min(shortest, length(minus(p[i], p[j])));
        std::array<std::size_t, 2> rest{};
        for (std::size_t k = 0, n = 0; k < 4; ++k)
          if (k != i && k != j) rest[n++] = k;
        const Vector edge = minus(p[j], p[i]);
        const Vector a = cross(edge, minus(p[rest[0]], p[i]));
        const Vector b = cross(edge, minus(p[rest[1]], p[i]));
        const double cosine = std::clamp(dot(a, b) / (length(a) * length(b)), -1.0, 1.0);
        quality.angle = std::min(quality.angle, std::acos(cosine) * 57.29577951308232);
      }
    quality.ratio = std::max(quality.ratio, length(center) / (12 * volume) / shortest);
  }
  return quality;
}

std::string error_of(const Surface& surface, const SurfaceMeshing& meshing = {}) {
  try {
    tetrahedralize(surface.surface(), meshing);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in: " << message;
}

class TetrahedralizeSurface : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_engine(TetrahedralizationEngine::tetgen))
      GTEST_SKIP() << "SKIPPED FOR LACK OF AN ENGINE: configure with PLUME_WITH_TETGEN, as ./dev "
                      "test does";
  }
};

TEST_F(TetrahedralizeSurface, FillsABox) {
  const Tetrahedralization result = tetrahedralize(box().surface());
  const Quality quality = quality_of(result.mesh);
  EXPECT_NEAR(quality.volume, 1, 1e-14);
  EXPECT_EQ(quality.not_positive, 0u);
  EXPECT_TRUE(result.findings.empty());
  EXPECT_NO_THROW(check_structure(result.mesh));
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(result.mesh.points.at<double>(i), box().points[i]);
}

TEST_F(TetrahedralizeSurface, KeepsToTheBoundsThatAreAskedFor) {
  const Quality plain = quality_of(tetrahedralize(box().surface()).mesh);
  EXPECT_GT(plain.largest, 1e-3);
  const SurfaceMeshing meshing{.radius_edge_ratio = 2, .dihedral_angle = 10, .volume = 1e-3};
  const Tetrahedralization fine = tetrahedralize(box().surface(), meshing);
  const Quality quality = quality_of(fine.mesh);
  EXPECT_NEAR(quality.volume, 1, 1e-12);
  EXPECT_LE(quality.largest, 1e-3);
  EXPECT_LE(quality.ratio, 2);
  EXPECT_GE(quality.angle, 10);
  EXPECT_EQ(quality.not_positive, 0u);
  EXPECT_TRUE(fine.findings.empty());
}

// TetGen leaves one ratio of 1.52 here.
TEST_F(TetrahedralizeSurface, CountsWhatIsBeyondTheBounds) {
  const SurfaceMeshing meshing{.radius_edge_ratio = 1.4, .dihedral_angle = 10, .volume = 1e-3};
  const Tetrahedralization fine = tetrahedralize(box().surface(), meshing);
  const Quality quality = quality_of(fine.mesh);
  ASSERT_GT(quality.ratio, 1.4);
  ASSERT_EQ(fine.findings.size(), 1u);
  char worst[64];
  std::snprintf(worst, sizeof worst, "above 1.4 (at most %.3g)", quality.ratio);
  expect_parts(describe(fine.findings[0]), {"tetrahedra have a radius-edge ratio", worst});
}

TEST_F(TetrahedralizeSurface, AddsNoMorePointsThanAllowed) {
  SurfaceMeshing meshing{.radius_edge_ratio = 2, .volume = 1e-5, .added_points = 500};
  const Tetrahedralization result = tetrahedralize(box().surface(), meshing);
  EXPECT_NEAR(quality_of(result.mesh).volume, 1, 1e-12);
  EXPECT_LT(result.mesh.point_count(), 600u);
  ASSERT_GE(result.findings.size(), 2u);
  expect_parts(describe(result.findings.front()), {"tetrahedra have", "above"});
  expect_parts(describe(result.findings.back()), {"points added", "not finished"});
}

TEST_F(TetrahedralizeSurface, ASurfaceInsideOfAnotherBoundsACavity) {
  for (const bool outwards : {true, false}) {
    Surface shells = box();
    shells.add_box({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}, outwards);
    EXPECT_NEAR(quality_of(tetrahedralize(shells.surface()).mesh).volume, 1 - 0.064, 1e-13);
    // An island in the cavity, and a box apart.
    shells.add_box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}, outwards);
    shells.add_box({2, 0, 0}, {2.5, 0.5, 0.5}, outwards);
    const SurfaceMeshing meshing{.radius_edge_ratio = 2, .volume = 0.01};
    EXPECT_NEAR(quality_of(tetrahedralize(shells.surface(), meshing).mesh).volume,
                1 - 0.064 + 0.008 + 0.125, 1e-13);
  }
}

TEST_F(TetrahedralizeSurface, FillsWhatIsNotConvex) {
  // A tetrahedron cut out of a box' top: an L would do, this has a re-entrant vertex.
  Surface surface = box();
  surface.triangles.erase(surface.triangles.begin() + 2, surface.triangles.begin() + 4);
  surface.points.insert(surface.points.end(), {0.5, 0.5, 0.25});
  for (const auto& [a, b] : {std::pair{4u, 5u}, {5u, 7u}, {7u, 6u}, {6u, 4u}})
    surface.triangles.push_back({a, b, 8});
  EXPECT_NEAR(quality_of(tetrahedralize(surface.surface()).mesh).volume, 1 - 0.25, 1e-13);
}

// As .stl files have it: each triangle with corners of its own, some of no extent.
TEST_F(TetrahedralizeSurface, MergesCornersAndDropsTrianglesWithoutExtent) {
  const Surface whole = box();
  Surface soup;
  for (const auto& triangle : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.points.size() / 3);
    for (const std::uint32_t corner : triangle)
      for (std::size_t a = 0; a < 3; ++a) soup.points.push_back(whole.points[3 * corner + a]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  soup.triangles.push_back({0, 1, 0});
  TriangleSurface surface = soup.surface();
  surface.vertices.fields.push_back(
      {"T", Association::point, 1, Array::own(std::vector<float>(36))});
  const Tetrahedralization result = tetrahedralize(surface);
  EXPECT_NEAR(quality_of(result.mesh).volume, 1, 1e-14);
  ASSERT_EQ(result.findings.size(), 3u);
  EXPECT_EQ(result.findings[0].count, 28u);
  EXPECT_EQ(describe(result.findings[1]), "1 triangles with equal corners: left out: 12");
  expect_parts(describe(result.findings[2]), {"1 fields of the surface left out"});
  EXPECT_TRUE(result.mesh.fields.empty());
}

TEST_F(TetrahedralizeSurface, NamesWhereItIsOpen) {
  Surface open = box();
  open.triangles.erase(open.triangles.begin() + 7);
  expect_parts(error_of(open), {"not closed", "3 edges", "triangle 6", "(0, 1, 1)"});
  Surface fin = box();
  fin.triangles.push_back({0, 1, 7});
  expect_parts(error_of(fin), {"not closed", "triangle 0, 4, 12", "triangle 12"});
}

TEST_F(TetrahedralizeSurface, NamesTrianglesThatIntersect) {
  Surface crossing = box();
  crossing.add_box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
  expect_parts(error_of(crossing),
               {"intersects itself", "triangle 2 (0, 0, 1) (1, 0, 1) (0, 1, 1)", "repair"});
  Surface twice = box();
  twice.add_box({0, 0, 0}, {1, 1, 1});
  expect_parts(error_of(twice), {"intersects itself", "24 triangles", "triangle 0 (0, 0, 0)"});
  Surface hanging = box();  // a corner on another's face
  hanging.add_box({0.25, 0.25, 1}, {0.75, 0.75, 2});
  expect_parts(error_of(hanging), {"intersects itself", "triangle"});
  Surface nearly = box();
  nearly.add_box({1e-9, 1e-9, 1e-9}, {2, 2, 2});
  expect_parts(error_of(nearly), {"intersects itself", "triangle"});
}

TEST_F(TetrahedralizeSurface, BoxesMayTouchInACommonCorner) {
  Surface surface = box();
  surface.add_box({1, 1, 1}, {2, 2, 2});
  EXPECT_NEAR(quality_of(tetrahedralize(surface.surface()).mesh).volume, 2, 1e-13);
}

TEST_F(TetrahedralizeSurface, NamesWhatIsWrongWithItsArrays) {
  Surface surface = box();
  surface.triangles[5][1] = 99;
  expect_parts(error_of(surface), {"triangle 5 has point 99", "points 0 to 7"});
  surface = box();
  surface.points[4] = std::numeric_limits<double>::quiet_NaN();
  expect_parts(error_of(surface), {"point 1 is at (1, nan, 0)", "finite"});
  surface = box();
  surface.triangles.clear();
  expect_parts(error_of(surface), {"no triangles"});
}

TEST_F(TetrahedralizeSurface, NamesSettingsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_parts(error_of(box(), {.radius_edge_ratio = 0.5}), {"0.5", "1 to 1000"});
  expect_parts(error_of(box(), {.radius_edge_ratio = nan}), {"nan", "1 to 1000"});
  expect_parts(error_of(box(), {.dihedral_angle = 10}), {"dihedral", "give both"});
  expect_parts(error_of(box(), {.radius_edge_ratio = 2, .dihedral_angle = 60}), {"60", "0 to 40"});
  expect_parts(error_of(box(), {.volume = -1}), {"-1", "positive"});
  expect_parts(error_of(box(), {.added_points = 0}), {"0 points", "at least 1"});
}

}  // namespace
}  // namespace plume::test
