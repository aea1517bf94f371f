// Cell data: constant in each cell, or averaged to the points, as the user chooses.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/mesh/explicit_cells.h"

namespace plume::test {
namespace {

// x + 2y + 3z at the mean of each cell's points.
Mesh with_cell_field(Mesh mesh) {
  const CellReader cells(mesh);
  std::vector<double> values(mesh.cell_count(), 0);
  std::vector<std::uint32_t> ids;
  for (std::size_t c = 0; c < values.size(); ++c) {
    cells.points(c, ids);
    for (const std::uint32_t id : ids) {
      const auto p = point_at(mesh, id);
      values[c] += (p[0] + 2 * p[1] + 3 * p[2]) / static_cast<double>(ids.size());
    }
  }
  mesh.fields = {{"value", Association::cell, 1, Array::own(std::move(values))}};
  mesh.active_field = "value";
  return mesh;
}

SceneOptions options_of(CellData cell_data) {
  SceneOptions options;
  options.cell_data = cell_data;
  return options;
}

TEST(CellData, AveragedIsContinuousAndConstantIsNot) {
  for (const char* form : {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-polyhedra"})
    for (const CellData kind : {CellData::constant, CellData::averaged}) {
      const Scene scene(with_cell_field(generate(form, {6, 0.1, 2})), options_of(kind));
      const bool averaged = kind == CellData::averaged;
      EXPECT_EQ(scene.cell_data_averaged(), averaged);
      EXPECT_EQ(scene.field().association, averaged ? Association::point : Association::cell);
      const Ray ray{{-1, 0.31, 0.43}, {1, 0.05, 0.02}};
      float before = 0;
      std::size_t segments = 0, jumps = 0;
      scene.trace(ray, [&](const Segment& s) {
        if (segments++ > 0 && s.s_in != before) ++jumps;
        before = s.s_out;
        EXPECT_EQ(s.s_in == s.s_out, !averaged);
        return true;
      });
      EXPECT_GT(segments, 5u);
      if (averaged)
        EXPECT_EQ(jumps, 0u) << form;
      else
        EXPECT_GT(jumps, 4u) << form;
    }
}

TEST(CellData, AveragedIsALinearFieldInsideOfARegularMesh) {
  const Scene scene(with_cell_field(generate("box-hexahedra", {8, 0, 1})),
                    options_of(CellData::averaged));
  const Ray ray{{0.3, 0.4, -1}, {0.05, 0.02, 1}};
  std::size_t inner = 0;
  scene.trace(
      ray,
      [&](const Segment& s) {
        auto z = [&](double t) { return -1 + t; };
        if (z(s.t_in) < 0.124 || z(s.t_out) > 0.876) return true;  // cells at the boundary
        for (const double t : {s.t_in, s.t_out})
          EXPECT_NEAR(scalar_at(s, t == s.t_in ? 0 : 1),
                      (0.3 + 0.05 * t) + 2 * (0.4 + 0.02 * t) + 3 * z(t), 3e-6);
        ++inner;
        return true;
      },
      ScalarOrder::cubic);
  EXPECT_GE(inner, 6u);
}

TEST(CellData, TheAverageIsSaidInThePlan) {
  const Mesh mesh = with_cell_field(generate("box-mixed", {3, 0, 1}));
  RenderSettings settings;
  settings.width = settings.height = 8;
  for (const CellData kind : {CellData::constant, CellData::averaged}) {
    const Scene scene(mesh, options_of(kind));
    std::string plan;
    for (const auto& line :
         render(scene, named_view("iso", scene.bounds()), settings).statistics.plan)
      plan += line + "\n";
    EXPECT_EQ(plan.find("averaged to the points") != std::string::npos, kind == CellData::averaged);
    EXPECT_EQ(plan.find("constant in each cell") != std::string::npos, kind == CellData::constant);
  }
}

TEST(CellData, ValuesThatAreNoneAreLeftOutOfTheAverageAndSaid) {
  Mesh mesh = with_cell_field(generate("box-hexahedra", {4, 0, 1}));
  std::vector<double> values(mesh.cell_count(), 1);
  values[21] = values[22] = std::numeric_limits<double>::quiet_NaN();
  mesh.fields[0].values = Array::own(values);
  const Scene scene(mesh, options_of(CellData::averaged));
  EXPECT_EQ(scene.field().not_finite, 0u);
  ASSERT_EQ(scene.findings().size(), 1u);
  EXPECT_EQ(scene.findings()[0].count, 2u);
  scene.trace({{0.3, 0.4, -1}, {0, 0, 1}}, [](const Segment& s) {
    EXPECT_EQ(s.s_in, 1);
    EXPECT_EQ(s.s_out, 1);
    return true;
  });
}

TEST(CellData, PointFieldsAreLeftAlone) {
  const Scene scene(generate("box-hexahedra", {3, 0, 1}), options_of(CellData::averaged));
  EXPECT_FALSE(scene.cell_data_averaged());
}

}  // namespace
}  // namespace plume::test
