#include "plume/examples/plume/chart_ways.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "plume/datasets/generate.h"
#include "plume/examples/plume/chart_measure.h"
#include "plume/examples/plume/chart_walkers.h"
#include "plume/lib/picture_error.h"

namespace plume::command {
namespace {

RenderSettings small() {
  RenderSettings settings;
  settings.width = settings.height = 12;
  settings.threads = 1;
  return settings;
}

std::set<std::string> names(const std::vector<ChartWay>& ways) {
  std::set<std::string> names;
  for (const ChartWay& way : ways) names.insert(way.name);
  return names;
}

TEST(ChartWays, HaveNamesOfTheirOwnAndTheReferenceIsLast) {
  for (const char* mesh : {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear"}) {
    const Scene scene(generate(mesh, {3, 0.2, 1}));
    for (const bool quick : {false, true}) {
      const auto ways = chart_ways(scene, small(), quick);
      EXPECT_EQ(names(ways).size(), ways.size()) << mesh;
      EXPECT_EQ(ways.back().name, "the reference");
      for (const ChartWay& way : ways) {
        EXPECT_EQ(way.settings.width, 12);
        EXPECT_FALSE(way.settings.tolerance);
      }
    }
  }
}

TEST(ChartWays, OrdersAreThoseThatTheMeshTellsApart) {
  const Scene tetrahedra(generate("box-tetrahedra", {3, 0.2, 1}));
  for (const ChartWay& way : chart_ways(tetrahedra, small(), false))
    EXPECT_TRUE(way.settings.order == ScalarOrder::linear || way.name == "the reference");
  const Scene hexahedra(generate("box-hexahedra", {3, 0.2, 1}));
  const auto all = names(chart_ways(hexahedra, small(), false));
  for (const char* name :
       {"order 1; closed form", "order 1; closed form; ray by ray", "order 1; 4 samples",
        "order 1; table 128x128x32", "order 2 to 1e-4; table2 40^3x24",
        "order 2 to 1e-3; closed form", "order 3 to 1e-4; closed form; whole rays",
        "adaptive to 1e-5; closed form; whole rays"})
    EXPECT_TRUE(all.count(name)) << name;
}

TEST(ChartMeasure, TheReferenceHasNoErrorAndSamplesConverge) {
  Scene scene(generate("box-tetrahedra", {4, 0.2, 1}));
  const Camera camera = named_view("iso", scene.bounds());
  std::vector<double> shares;
  const ChartMeasurement measured =
      measure_ways(scene, camera, small(), chart_ways(scene, small(), true), 2,
                   [&](const ChartProgress& at) { shares.push_back(at.share); });
  EXPECT_TRUE(measured.on_processor);
  double one = 0, many = 0;
  for (const MeasuredWay& way : measured.ways) {
    EXPECT_EQ(way.frames, 2) << way.point.method;
    EXPECT_GE(way.point.max_error, way.point.rms_error);
    EXPECT_LE(way.fastest, way.point.milliseconds);
    EXPECT_LE(way.point.milliseconds, way.slowest);
    if (way.point.method == "the reference") {
      EXPECT_EQ(way.point.max_error, 0);
    }
    if (way.point.method == "1 sample") one = way.point.max_error;
    if (way.point.method == "4 samples") many = way.point.max_error;
  }
  EXPECT_GT(many, 0);
  EXPECT_LT(many, 0.25 * one);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
}

// By other decisions through the same grid: as near as single precision is, but for the triangles
// of twisted faces.
TEST(ChartWays, TheThesisWalkersSeeTheSameGrid) {
  const Scene scene(generate("box-hexahedra", {4, 0.2, 1}));
  const Camera camera = named_view("iso", scene.bounds());
  const auto ways = other_walkers(scene, camera, small());
  ASSERT_EQ(ways.size(), 4u);
  for (const ChartWay& way : ways) {
    const Image ours = render(scene, camera, way.settings).image;
    const double error = picture_error(way.draw(way.settings), ours).largest;
    const bool triangles = way.name.ends_with("Plücker walker");
    EXPECT_LT(error, triangles ? 0.1 : 1e-4) << way.name;
    EXPECT_TRUE(!triangles || error > 1e-3) << way.name;
  }
}

TEST(ChartWays, TheThesisWalkersAreOfCurvilinearGridsAlone) {
  for (const char* mesh : {"box-tetrahedra", "box-mixed", "box-rectilinear"}) {
    const Scene scene(generate(mesh, {3, 0.2, 1}));
    EXPECT_TRUE(other_walkers(scene, named_view("iso", scene.bounds()), small()).empty()) << mesh;
  }
}

}  // namespace
}  // namespace plume::command
