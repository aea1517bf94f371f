// Light and normals: of fields whose gradients are known.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/gradient_field.h"
#include "plume/lib/plume.h"
#include "plume/lib/scene_body.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/gradients.h"
#include "plume/mesh/validate.h"

namespace plume::test {
namespace {

using Vector = std::array<double, 3>;

const char* const kForms[] = {"box-tetrahedra", "box-hexahedra",   "box-mixed",  "box-wedges",
                              "box-polyhedra",  "box-rectilinear", "two-blocks", "twisted"};

Mesh with(Mesh mesh, const std::function<double(const Vector&)>& of) {
  std::vector<double> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) values.push_back(of(point_at(mesh, p)));
  mesh.fields = {{"value", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "value";
  return mesh;
}

SceneOptions lit() {
  SceneOptions options;
  options.keep_gradients = true;
  return options;
}

RenderSettings settings_of(int size) {
  RenderSettings settings;
  settings.width = settings.height = size;
  settings.early_termination = 0;
  return settings;
}

double linear(const Vector& p) { return p[0] + 2 * p[1] + 3 * p[2]; }
double radius(const Vector& p) { return std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5); }

// Normals of the first hits, with where they are.
void for_each_normal(Scene& scene, const Camera& camera, float isovalue,
                     const std::function<void(const Vector&, const Vector&)>& visit) {
  scene.set_classification({{}, {}, {{isovalue}}});
  RenderSettings settings = settings_of(48);
  settings.order = ScalarOrder::cubic;
  settings.channels = {"depth", "normal"};
  const Image image = render(scene, camera, settings).image;
  const PixelRays rays(camera, 48, 48);
  int hits = 0;
  for (std::size_t i = 0; i < 48 * 48; ++i) {
    const double depth = image.channel("depth")->values[i];
    if (!std::isfinite(depth)) {
      ASSERT_TRUE(std::isnan(image.channel("normal.x")->values[i]));
      continue;
    }
    const Ray ray = rays(static_cast<double>(i % 48) + 0.5, static_cast<double>(i / 48) + 0.5);
    Vector place, normal;
    const char* const names[] = {"normal.x", "normal.y", "normal.z"};
    for (std::size_t a = 0; a < 3; ++a) {
      place[a] = ray.origin[a] + depth * ray.direction[a];
      normal[a] = image.channel(names[a])->values[i];
    }
    visit(place, normal);
    ++hits;
  }
  EXPECT_GT(hits, 200);
}

TEST(Normals, OfALinearFieldAreExact) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Scene scene(with(generate(form, {4, 0.2, 3}), linear), lit());
    for_each_normal(scene, fitted_camera(scene.bounds(), {-0.7, 0.4, -0.59}), 3,
                    [](const Vector&, const Vector& normal) {
                      for (std::size_t a = 0; a < 3; ++a)
                        ASSERT_NEAR(normal[a], (static_cast<double>(a) + 1) / std::sqrt(14.0),
                                    2e-5);
                    });
  }
}

TEST(Normals, OfASphereConverge) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    auto error = [&](int size) {
      Scene scene(with(generate(form, {size, 0.1, 3}), radius), lit());
      double sum = 0;
      int count = 0;
      for_each_normal(scene, named_view("iso", {{0, 0, 0}, {1, 1, 1}}), 0.4f,
                      [&](const Vector& p, const Vector& normal) {
                        const double r = radius(p);
                        if (std::max({p[0], p[1], p[2]}) > 0.9) return;
                        for (std::size_t a = 0; a < 3; ++a)
                          sum += std::pow(normal[a] - (p[a] - 0.5) / r, 2);
                        ++count;
                      });
      return std::sqrt(sum / count);
    };
    const double coarse = error(8), fine = error(16);
    // At least linearly (mesh/gradients.h), which would be a factor of 0.5 if meshes were alike.
    EXPECT_LT(coarse, 0.06);
    EXPECT_LT(fine, 0.65 * coarse);
  }
}

TEST(GradientField, IsContinuousAcrossFaces) {
  auto wild = [](const Vector& p) { return std::sin(7 * p[0]) * std::cos(5 * p[1]) + p[2] * p[2]; };
  for (const char* form : kForms) {
    if (std::string(form) == "two-blocks") continue;  // each has points of its own
    SCOPED_TRACE(form);
    const Scene scene(with(generate(form, {4, 0.2, 3}), wild), lit());
    const Camera camera = fitted_camera(scene.bounds(), {-0.7, 0.4, -0.59});
    const PixelRays rays(camera, 12, 12);
    int compared = 0;
    double worst = 0;
    std::visit(
        [&](const auto& walkable) {
          for (int i = 0; i < 144; ++i) {
            const Ray ray = rays(i % 12 + 0.5, i / 12 + 0.5);
            Segment before{0, -1, 0, 0, 0};
            trace(walkable->mesh, walkable->boundary, ray, [&](const Segment& segment) {
              if (segment.t_in == before.t_out && segment.s_in == before.s_out) {
                Vector place;
                for (std::size_t a = 0; a < 3; ++a)
                  place[a] = ray.origin[a] + segment.t_in * ray.direction[a];
                const Vector here = scene.body().gradients->at(walkable->mesh, segment.cell, place);
                const Vector there = scene.body().gradients->at(walkable->mesh, before.cell, place);
                for (std::size_t a = 0; a < 3; ++a)
                  worst = std::max(worst, std::abs(here[a] - there[a]));
                ++compared;
              }
              before = segment;
              return true;
            });
          }
        },
        scene.body().walkable);
    // Gradients are up to 7, and change by some 50 per unit of length; places are off by 1e-6.
    EXPECT_LT(worst, 2e-4);
    EXPECT_GT(compared, 100);
  }
}

// Of tetrahedra the walkable form keeps neither the cells' points nor the user's order; the
// gradients must come to where they belong all the same.
TEST(GradientField, AtPointsIsWhatTheyHave) {
  auto wild = [](const Vector& p) { return std::sin(7 * p[0]) * std::cos(5 * p[1]) + p[2] * p[2]; };
  for (const char* form : {"box-tetrahedra", "ball-tetrahedra", "box-mixed", "box-hexahedra"}) {
    SCOPED_TRACE(form);
    const Mesh mesh = with(generate(form, {5, 0.2, 2}), wild);
    const std::vector<float> expected = point_gradients(mesh, select_field(mesh, {}));
    SceneOptions options = lit();
    options.keep_cell_numbers = true;
    const Scene scene(mesh, options);
    const CellReader reader(mesh);
    std::vector<std::uint32_t> ids;
    std::visit(
        [&](const auto& walkable) {
          for (std::uint32_t cell = 0; cell < walkable->mesh.cell_count(); ++cell) {
            reader.points(walkable->mesh.original_cell(cell), ids);
            for (const std::uint32_t id : ids) {
              const Vector found =
                  scene.body().gradients->at(walkable->mesh, cell, point_at(mesh, id));
              for (std::size_t a = 0; a < 3; ++a)
                ASSERT_NEAR(found[a], expected[3 * std::size_t{id} + a], 1e-3) << cell;
            }
          }
        },
        scene.body().walkable);
  }
}

TEST(GradientField, PassesOverPointsWithoutAGradient) {
  for (const char* form : {"box-tetrahedra", "box-mixed", "box-rectilinear", "blunt-body"}) {
    SCOPED_TRACE(form);
    Mesh mesh = with(generate(form, {4, 0.1, 3}), linear);
    const std::vector<float> none(3 * mesh.point_count(), std::nanf(""));
    std::vector<float> some = none;
    for (std::size_t i = 0; i < some.size(); i += 6)
      some[i] = 1, some[i + 1] = 2, some[i + 2] = 3;  // every second point
    SceneOptions options;
    options.keep_cell_numbers = true;
    options.keep_field_order = true;
    const Scene scene(mesh, options);
    const CellReader reader(mesh);
    std::visit(
        [&](const auto& walkable) {
          const GradientField partly(walkable->mesh, some);
          const GradientField empty(walkable->mesh, none);
          std::vector<std::uint32_t> ids;
          for (std::uint32_t cell = 0; cell < walkable->mesh.cell_count(); ++cell) {
            reader.points(walkable->mesh.original_cell(cell), ids);
            Vector middle{0, 0, 0};
            bool any = false;
            for (const std::uint32_t id : ids) {
              for (std::size_t a = 0; a < 3; ++a)
                middle[a] += point_at(mesh, id)[a] / static_cast<double>(ids.size());
              any = any || id % 2 == 0;
            }
            EXPECT_TRUE(std::isnan(empty.at(walkable->mesh, cell, middle)[0]));
            const Vector found = partly.at(walkable->mesh, cell, middle);
            if (!any) continue;
            for (std::size_t a = 0; a < 3; ++a)
              ASSERT_NEAR(found[a], static_cast<double>(a) + 1, 1e-6) << cell;
          }
        },
        scene.body().walkable);
  }
}

TEST(Shading, IsPhongs) {
  Lighting lighting;
  lighting.ambient = 0.1;
  lighting.diffuse = 0.6;
  lighting.specular = 0.5;
  lighting.exponent = 10;
  // Headlight: at an angle a, both (n . l) and (n . h) are cos a. From either side.
  for (const double angle : {0.0, 0.5, 1.2}) {
    for (const double side : {1.0, -1.0}) {
      const Shading s =
          shading_of(lighting, {side * 1e-12 * std::sin(angle), 0, side * 1e-12 * std::cos(angle)},
                     {0, 0, -1});
      EXPECT_NEAR(s.factor, 0.1 + 0.6 * std::cos(angle), 1e-6);
      EXPECT_NEAR(s.highlight, 0.5 * std::pow(std::cos(angle), 10), 1e-6);
    }
  }
  // From the side, at 90 degrees to the viewer: l . n = sin a, h at 45 degrees.
  lighting.lights = {{Vector{7, 0, 0}, 2}};
  const Shading aside = shading_of(lighting, {std::sin(0.5), 0, std::cos(0.5)}, {0, 0, -1});
  EXPECT_NEAR(aside.factor, 0.1 + 0.6 * 2 * std::sin(0.5), 1e-6);
  EXPECT_NEAR(aside.highlight, 0.5 * 2 * std::pow(std::cos(0.5 - std::acos(-1) / 4), 10), 1e-6);
  // Behind the surface, there is no light but the ambient.
  lighting.lights = {{Vector{0, 0, -1}, 2}};
  EXPECT_NEAR(shading_of(lighting, {0, 0, 1}, {0, 0, -1}).factor, 0.1, 1e-6);
  EXPECT_EQ(shading_of(lighting, {0, 0, 1}, {0, 0, -1}).highlight, 0);
  // Lights add up.
  lighting.lights = {{}, {Vector{0, 0, 1}, 0.5}};
  EXPECT_NEAR(shading_of(lighting, {0, 0, 1}, {0, 0, -1}).factor, 0.1 + 0.6 * 1.5, 1e-6);
  // Without a normal the colour stays.
  for (const double bad : {0.0, std::nan(""), HUGE_VAL}) {
    const Shading none = shading_of(lighting, {0, 0, bad}, {0, 0, -1});
    EXPECT_EQ(none.factor, 1);
    EXPECT_EQ(none.highlight, 0);
  }
}

TEST(Light, OnAFlatSurfaceIsEvenAndChangesNoOpacity) {
  for (const char* form : {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear"}) {
    SCOPED_TRACE(form);
    Scene scene(
        with(generate(form, {4, 0.2, 3}), [](const Vector& p) { return p[2] + 0.75 * p[0]; }),
        lit());
    // An isosurface at an angle of acos(0.8) to the view, and an interval behind it.
    scene.set_classification(
        {{}, {{0.5f, 0.6f, even_profile(0.5f, {1, 1, 1})}}, {{1, 0.5f, {1, 0.5f, 0.25f}}}});
    Camera camera = named_view("-z", scene.bounds());
    camera.parallel = true;
    camera.parallel_scale = 0.1;
    RenderSettings settings = settings_of(32);
    const Image plain = render(scene, camera, settings).image;
    Lighting lighting;
    lighting.ambient = 0.25;
    lighting.diffuse = 0.5;
    lighting.specular = 0;
    for (const bool intervals : {false, true}) {
      lighting.intervals = intervals;
      settings.lighting = lighting;
      const RenderResult result = render(scene, camera, settings);
      const double factor = 0.25 + 0.5 * 0.8, behind = intervals ? factor : 1;
      for (std::size_t i = 0; i < 32 * 32; ++i) {
        const float* rgba = &result.image.rgba[4 * i];
        ASSERT_NEAR(rgba[0], factor * 0.5 + 0.5 * behind * 0.5, 1e-5);
        ASSERT_NEAR(rgba[1], factor * 0.25 + 0.5 * behind * 0.5, 1e-5);
        ASSERT_EQ(rgba[3], plain.rgba[4 * i + 3]);
      }
    }
  }
}

TEST(Light, CutFacesAreNotLit) {
  Scene scene(with(generate("box-tetrahedra", {4, 0.2, 3}), linear), lit());
  scene.set_classification({{}, {{0, 6, even_profile(0.5f, {1, 1, 1})}}, {}});
  RenderSettings settings = settings_of(16);
  settings.clip_planes = {{{0.5, 0.5, 0.5}, {0.1, 0.2, -1}}};
  Camera camera = named_view("-z", scene.bounds());
  camera.parallel = true;
  camera.parallel_scale = 0.2;
  const Image plain = render(scene, camera, settings).image;
  settings.lighting = Lighting{};
  EXPECT_EQ(render(scene, camera, settings).image.rgba, plain.rgba);
}

TEST(Light, AsksForGradients) {
  auto message = [](auto&& doing) -> std::string {
    try {
      doing();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const Mesh mesh = with(generate("box-tetrahedra", {2, 0, 1}), linear);
  Scene dark(mesh);
  dark.set_classification({{}, {}, {{3}}});
  EXPECT_FALSE(dark.has_gradients());
  const Camera camera = named_view("iso", dark.bounds());
  RenderSettings settings = settings_of(4);
  settings.lighting = Lighting{};
  EXPECT_NE(message([&] { render(dark, camera, settings); }).find("keep_gradients"),
            std::string::npos);
  settings.lighting.reset();
  settings.channels = {"normal"};
  EXPECT_NE(message([&] { render(dark, camera, settings); }).find("keep_gradients"),
            std::string::npos);
  SceneOptions options = lit();
  options.field.name = "cell_radius";
  EXPECT_NE(message([&] {
              Scene(generate("box-tetrahedra", {2, 0, 1}), options);
            }).find("cell-data averaged"),
            std::string::npos);
  options.cell_data = CellData::averaged;
  EXPECT_TRUE(Scene(generate("box-tetrahedra", {2, 0, 1}), options).has_gradients());

  Lighting bad;
  bad.exponent = 0;
  EXPECT_NE(bad.problem()->find("exponent of 0"), std::string::npos);
  bad = {};
  bad.lights[0].intensity = -1;
  EXPECT_NE(bad.problem()->find("intensity -1"), std::string::npos);
  bad = {};
  bad.lights[0].direction = Vector{0, 0, 0};
  EXPECT_NE(bad.problem()->find("0,0,0"), std::string::npos);
  bad = {};
  bad.diffuse = std::nan("");
  EXPECT_TRUE(bad.problem());
  EXPECT_FALSE(Lighting{}.problem());
}

}  // namespace
}  // namespace plume::test
