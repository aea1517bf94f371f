// A scene that is given another field is the scene made anew with that field, bit for bit.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/mesh/explicit_cells.h"

namespace plume::test {
namespace {

// All forms, and what they leave out: unused points, cells with repeated points, hidden cells.
struct Case {
  std::string name;
  Mesh mesh;
};

Mesh with_left_out_tetrahedra() {
  Mesh mesh = generate("box-tetrahedra", {5, 0.2, 4});
  std::vector<float> points(3, 0.5f);  // a point that no cell uses
  mesh.points.visit([&](auto values) {
    for (const auto value : values) points.push_back(static_cast<float>(value));
  });
  std::vector<std::int64_t> ids{1, 1, 2, 3};  // a cell without an inside
  mesh.cells.connectivity.visit([&](auto values) {
    for (const auto value : values) ids.push_back(static_cast<std::int64_t>(value) + 1);
  });
  mesh.points = Array::own(std::move(points));
  mesh.cells.connectivity = Array::own(std::move(ids));
  return mesh;
}

Mesh with_hidden_cells(Mesh mesh) {
  std::vector<std::uint8_t> hidden(mesh.cell_count());
  for (std::size_t cell = 0; cell < hidden.size(); cell += 7) hidden[cell] = 1;
  mesh.hidden_cells = Array::own(std::move(hidden));
  return mesh;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* name : {"box-tetrahedra", "box-mixed", "box-polyhedra", "two-blocks", "twisted",
                           "sphere", "box-rectilinear"})
    all.push_back({name, generate(name, {5, 0.2, 4})});
  all.push_back({"tetrahedra of which some are left out", with_left_out_tetrahedra()});
  all.push_back({"hidden cells of a grid", with_hidden_cells(generate("twisted", {5, 0, 1}))});
  all.push_back({"hidden cuboids", with_hidden_cells(generate("box-rectilinear", {6, 0.2, 1}))});
  // Two fields a side, with values that are not finite in one of them.
  for (auto& [name, mesh] : all) {
    mesh.fields.clear();
    std::mt19937 random(17);
    std::normal_distribution<double> noise(0, 0.1);
    std::vector<double> first, second;
    for (std::size_t p = 0; p < mesh.point_count(); ++p) {
      const auto [x, y, z] = point_at(mesh, p);
      first.push_back(x + 2 * y - z + noise(random));
      second.push_back(std::sin(5 * x) * std::cos(4 * y) + z * z + noise(random));
    }
    second[second.size() / 2] = std::numeric_limits<double>::infinity();
    std::vector<float> cells_first, cells_second;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      cells_first.push_back(static_cast<float>(c % 13));
      cells_second.push_back(static_cast<float>(noise(random)));
    }
    cells_second[0] = std::nanf("");
    mesh.fields.push_back({"first", Association::point, 1, Array::own(std::move(first))});
    mesh.fields.push_back({"second", Association::point, 1, Array::own(std::move(second))});
    mesh.fields.push_back(
        {"cells first", Association::cell, 1, Array::own(std::move(cells_first))});
    mesh.fields.push_back(
        {"cells second", Association::cell, 1, Array::own(std::move(cells_second))});
  }
  return all;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

void expect_same_pictures(const Scene& a, const Scene& b, const RenderSettings& settings) {
  const Camera camera = fitted_camera(a.bounds(), {-0.6, 0.5, -0.4});
  const RenderResult mine = render(a, camera, settings), other = render(b, camera, settings);
  EXPECT_GT(mine.statistics.rays_hit, 100u);
  EXPECT_TRUE(same_bits(mine.image.rgba, other.image.rgba));
  ASSERT_EQ(mine.image.channels.size(), other.image.channels.size());
  for (std::size_t i = 0; i < mine.image.channels.size(); ++i)
    EXPECT_TRUE(same_bits(mine.image.channels[i].values, other.image.channels[i].values))
        << mine.image.channels[i].name;
}

void expect_same_words(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.field().name, b.field().name);
  EXPECT_EQ(a.field().low, b.field().low);
  EXPECT_EQ(a.field().high, b.field().high);
  EXPECT_EQ(a.field().not_finite, b.field().not_finite);
  EXPECT_EQ(a.cell_data_averaged(), b.cell_data_averaged());
  EXPECT_EQ(a.default_unit_distance(), b.default_unit_distance());
  ASSERT_EQ(a.findings().size(), b.findings().size());
  for (std::size_t i = 0; i < a.findings().size(); ++i)
    EXPECT_EQ(describe(a.findings()[i]), describe(b.findings()[i]));
}

RenderSettings small() {
  RenderSettings settings;
  settings.width = settings.height = 40;
  return settings;
}

void fit(Scene& scene) {
  scene.set_transfer_function(
      to_transfer_function(scene.default_color_map(), scene.default_unit_distance()));
}

SceneOptions of(const char* field) {
  SceneOptions options;
  options.field.name = field;
  options.keep_field_order = true;
  return options;
}

TEST(SetField, IsTheSceneMadeAnew) {
  for (const auto& [name, mesh] : cases())
    for (const auto& [before, after] :
         {std::pair{"first", "second"}, {"second", "first"}, {"cells first", "cells second"}}) {
      SCOPED_TRACE(name + ", " + before + " to " + after);
      Scene scene(mesh, of(before));
      SceneOptions plain;
      plain.field.name = after;
      const Scene anew(mesh, plain);
      EXPECT_GE(scene.bytes(), anew.bytes());
      scene.set_field(mesh, {after, {}});
      fit(scene);
      expect_same_words(scene, anew);
      expect_same_pictures(scene, anew, small());
      RenderSettings integral = small();
      integral.mode = Mode::integral;
      integral.order = ScalarOrder::cubic;
      expect_same_pictures(scene, anew, integral);
    }
}

TEST(SetField, BringsGradientsAlong) {
  for (const auto& [name, mesh] : cases()) {
    SCOPED_TRACE(name);
    SceneOptions options = of("first");
    options.keep_gradients = true;
    Scene scene(mesh, options);
    options.field.name = "second";
    options.keep_field_order = false;
    Scene anew(mesh, options);
    scene.set_field(mesh, {"second", {}});
    RenderSettings settings = small();
    settings.lighting.emplace();
    settings.channels = {"normal", "isovalue"};
    for (Scene* each : {&scene, &anew}) each->set_classification({{}, {}, {{0.4f}}});
    expect_same_pictures(scene, anew, settings);
  }
}

TEST(SetField, AveragesCellData) {
  for (const auto& [name, mesh] : cases()) {
    SCOPED_TRACE(name);
    SceneOptions options = of("cells first");
    options.cell_data = CellData::averaged;
    Scene scene(mesh, options);
    options.field.name = "cells second";
    const Scene anew(mesh, options);
    scene.set_field(mesh, {"cells second", {}});
    fit(scene);
    expect_same_words(scene, anew);
    expect_same_pictures(scene, anew, small());
    // From averages to points is no change of kind.
    scene.set_field(mesh, {"first", {}});
    EXPECT_FALSE(scene.cell_data_averaged());
  }
}

TEST(SetField, ReadsBorrowedValuesThatHaveChanged) {
  Mesh mesh = generate("box-tetrahedra", {6, 0.2, 1});
  std::vector<double> values(mesh.point_count(), 1);
  mesh.fields = {
      {"value", Association::point, 1, Array::borrow<double>(std::span<const double>(values))}};
  SceneOptions options;
  options.keep_field_order = true;
  Scene scene(mesh, options);
  const TransferFunction looks = scene.transfer_function();
  for (int step = 0; step < 3; ++step) {
    for (std::size_t p = 0; p < values.size(); ++p) values[p] = static_cast<double>(p) * (step + 1);
    scene.set_field(mesh);
    EXPECT_EQ(scene.field().high, static_cast<float>((values.size() - 1) * (step + 1.0)));
    EXPECT_EQ(scene.transfer_function().knots.size(), looks.knots.size()) << "it stays";
    Scene anew(mesh);
    anew.set_transfer_function(looks);
    expect_same_pictures(scene, anew, small());
  }
}

std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(SetField, RefusesWhatItCannotDoAndLeavesTheScene) {
  const Case tets = cases().front();
  Scene unprepared(tets.mesh, {{"first", {}}});
  EXPECT_NE(error_of([&] {
              unprepared.set_field(tets.mesh, {"second", {}});
            }).find("SceneOptions::keep_field_order"),
            std::string::npos);

  Scene scene(tets.mesh, of("first"));
  const Scene anew(tets.mesh, of("first"));
  EXPECT_NE(error_of([&] {
              scene.set_field(tets.mesh, {"third", {}});
            }).find("no field 'third'"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              scene.set_field(tets.mesh, {"cells first", {}});
            })
                .find("'cells first' is constant in each cell and the scene was made of one that "
                      "is on points"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              scene.set_field(generate("box-tetrahedra", {4, 0, 1}));
            }).find("for a scene made of 216 and 750"),
            std::string::npos);
  Mesh cut = tets.mesh;
  cut.fields[1].values = Array::own(std::vector<float>(5));
  EXPECT_NE(error_of([&] {
              scene.set_field(cut, {"second", {}});
            }).find("holds 5 values"),
            std::string::npos);
  expect_same_words(scene, anew);
  expect_same_pictures(scene, anew, small());
}

}  // namespace
}  // namespace plume::test
