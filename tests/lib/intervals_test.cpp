// Pictures of interval volumes and isosurfaces: that nothing but the field counts.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/tests/lib/interval_scenes.h"
#include "plume/tests/reference/box_chord.h"
#include "plume/tests/reference/interval_walk.h"

namespace plume::test {
namespace {

// Off the corner where the scalar is that of a bound, for there one ulp decides on a whole
// interval.
bool is_clear(double s, const Classification& classification) {
  for (const auto& interval : classification.intervals)
    if (std::abs(s - interval.low) < 1e-4 || std::abs(s - interval.high) < 1e-4) return false;
  for (const auto& surface : classification.isosurfaces)
    if (std::abs(s - surface.value) < 1e-4) return false;
  return true;
}

// Every form of mesh, cells of every kind: what a linear field shows is known without any mesh.
TEST(Intervals, OfALinearFieldAreWhatTheOracleSees) {
  const Classification all = everything();
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Scene scene(with(generate(form, {5, 0.2, 4}), linear));
    scene.set_classification(all);
    const Camera camera = askew({{0, 0, 0}, {1, 1, 1}});
    const RenderResult result = render(scene, camera, exact(40));
    EXPECT_EQ(result.statistics.lost_rays, 0u);
    EXPECT_GT(result.statistics.surfaces, 100u);
    EXPECT_GT(result.statistics.visits, 100u);
    const Bounds box = scene.bounds();
    const PixelRays rays(camera, 40, 40);
    int compared = 0;
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) {
        const Ray ray = rays(x + 0.5, y + 0.5);
        const auto span = reference::box_span(box.low, box.high, ray.origin, ray.direction);
        if (!(span[1] - span[0] > 1e-4)) continue;
        auto at = [&](double t) {
          Point p;
          for (std::size_t a = 0; a < 3; ++a) p[a] = ray.origin[a] + t * ray.direction[a];
          return linear(p);
        };
        const double s_in = at(span[0]), s_out = at(span[1]);
        if (!is_clear(s_in, all) || !is_clear(s_out, all)) continue;
        const auto expected = reference::interval_walk(all, {{s_in, s_out, span[1] - span[0]}});
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(result.image.pixel(x, y)[c], expected.rgb[c], kBound) << x << ' ' << y;
        ASSERT_NEAR(result.image.pixel(x, y)[3], expected.alpha, kBound) << x << ' ' << y;
        ++compared;
      }
    EXPECT_GT(compared, 400);
  }
}

TEST(Intervals, ScaleOfSpaceAndScalarChangesNothing) {
  auto picture = [](double space, float scalar) {
    Scene scene(with(
        generate("box-tetrahedra", {4, 0.2, 3}), [&](const Point& p) { return scalar * linear(p); },
        space));
    scene.set_classification(everything(scalar, static_cast<float>(space)));
    return render(scene, askew(scene.bounds()), exact(48)).image;
  };
  const Image plain = picture(1, 1);
  for (const auto& [space, scalar] :
       {std::pair{1e-6, 1.0f}, {1e6, 1.0f}, {1.0, 4096.0f}, {1.0, 0x1p-20f}, {128.0, 0.125f}})
    EXPECT_LE(worst_difference(plain, picture(space, scalar)), kBound) << space << ' ' << scalar;
  // Scales that are no powers of two move values at bounds by rounding, and what is reached of an
  // interval by as much of it.
  EXPECT_LE(worst_difference(plain, picture(1, 1000)), kBound);
  EXPECT_LE(worst_difference(plain, picture(1, 1e-3f)), kBound);
}

TEST(Intervals, RefinementOfALinearFieldChangesNothing) {
  auto picture = [](const char* form, int size) {
    Scene scene(with(generate(form, {size, 0.2, 3}), linear));
    scene.set_classification(everything());
    return render(scene, askew({{0, 0, 0}, {1, 1, 1}}), exact(48)).image;
  };
  const Image coarse = picture("box-tetrahedra", 1);
  for (const int size : {2, 5, 12})
    EXPECT_LE(worst_difference(coarse, picture("box-tetrahedra", size)), kBound) << size;
  for (const char* form : {"box-hexahedra", "box-mixed", "box-rectilinear"})
    for (const int size : {1, 4}) EXPECT_LE(worst_difference(coarse, picture(form, size)), kBound);
}

// The limit, in whole pictures of a curved field. Rays that graze the surface see one of the two
// and not the other: fewer of them, as the interval gets narrower.
TEST(Intervals, OfEverLessWidthBecomeTheirIsosurface) {
  Scene scene(with(generate("box-tetrahedra", {8, 0.2, 3}), [](const Point& p) {
    return 3 + std::sin(7 * p[0]) + std::cos(5 * p[1]) * std::sin(6 * p[2]);
  }));
  Classification surface;
  surface.isosurfaces = {{3.1f, 0.4f, {1, 0.5f, 0}}};
  scene.set_classification(surface);
  const Image limit = render(scene, askew(scene.bounds()), exact(64)).image;
  double last = 1;
  for (const float width : {0.4f, 0.04f, 0.004f}) {
    scene.set_classification(
        {{}, {{3.1f - width / 2, 3.1f + width / 2, even_profile(0.4f, {1, 0.5f, 0})}}, {}});
    const Image image = render(scene, askew(scene.bounds()), exact(64)).image;
    double mean = 0;
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
      mean += std::abs(image.rgba[i] - limit.rgba[i]) / static_cast<double>(image.rgba.size());
    EXPECT_LT(mean, 0.3 * last) << width;
    last = mean;
  }
  EXPECT_LT(last, 5e-4);
}

// Blocks that touch with points of their own: no seam, no second start inside of an interval.
TEST(Intervals, BlocksThatTouchShowNoSeam) {
  auto curved = [](const Point& p) { return 2 + 3 * p[0] * p[0] - 2 * p[1] + p[2]; };
  Classification one;
  one.intervals = {{1, 4, even_profile(0.5f, {1, 1, 1})}};
  Mesh blocks = with(generate("two-blocks", {6, 0, 1}), curved);
  Scene apart(blocks);
  apart.set_classification(one);
  Camera camera = named_view("+x", apart.bounds());
  const RenderResult result = render(apart, camera, exact(64));
  EXPECT_GT(result.statistics.entries, result.statistics.rays_hit);  // there are two blocks
  // From x = 0 to the end: an interval entered at most once and left at most once.
  for (std::size_t i = 0; i < 64 * 64; ++i) ASSERT_LE(result.image.rgba[4 * i + 3], 0.5f + 1e-5f);
}

// Two cells with points of their own, apart by what seven digits in a file leave, or by more.
TEST(Intervals, AGapOfRoundingIsNone) {
  for (const auto& [gap, seen_twice] : {std::pair{0.0, false}, {2e-7, false}, {1e-3, true}}) {
    Mesh mesh;
    std::vector<double> points;
    for (const double x : {0.0, 1.0, 1.0 + gap, 2.0})
      for (const auto& [y, z] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        points.insert(points.end(), {x, 1.0 * y, 1.0 * z});
    mesh.points = Array::own(std::move(points));
    mesh.cells.types = Array::own(std::vector<std::uint8_t>{12});
    mesh.cells.connectivity =
        Array::own(std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15});
    Scene scene(with(std::move(mesh), [](const Point& p) { return p[0]; }));
    scene.set_classification({{}, {{0.5f, 1.5f, even_profile(0.5f, {1, 1, 1})}}, {}});
    Camera camera = named_view("+x", scene.bounds());
    camera.parallel = true;
    camera.parallel_scale = 0.4;
    const RenderResult result = render(scene, camera, exact(16));
    EXPECT_EQ(result.statistics.entries, 2 * result.statistics.rays_hit);
    for (std::size_t i = 0; i < 16 * 16; ++i) {
      // Beyond a gap begins a cut face, which shows the interval whole, after half of it.
      const double expected = seen_twice ? 1 - std::sqrt(0.5) * 0.5 : 0.5;
      ASSERT_NEAR(result.image.rgba[4 * i + 3], expected, 1e-5) << gap;
    }
  }
}

TEST(Isosurfaces, OfACubicFieldLieWhereItHasTheirValue) {
  // Trilinear, so a cubic along each ray, with up to two turns.
  auto product = [](const Point& p) { return p[0] * (1.1 - p[1]) * (p[2] + 0.2); };
  Scene scene(with(generate("box-rectilinear", {2, 0, 1}), product));
  Classification surface;
  surface.isosurfaces = {{0.2f}};
  scene.set_classification(surface);
  const Camera camera = askew({{0, 0, 0}, {1, 1, 1}});
  RenderSettings settings = exact(64);
  settings.order = ScalarOrder::cubic;
  settings.channels = {"depth", "isovalue", "cell_id"};
  const Image image = render(scene, camera, settings).image;
  const PixelRays rays(camera, 64, 64);
  int hits = 0;
  double worst = 0;
  for (std::size_t i = 0; i < 64 * 64; ++i) {
    const double depth = image.channel("depth")->values[i];
    if (!std::isfinite(depth)) {
      EXPECT_EQ(image.channel("cell_id")->values[i], -1);
      EXPECT_TRUE(std::isnan(image.channel("isovalue")->values[i]));
      continue;
    }
    ++hits;
    EXPECT_EQ(image.channel("isovalue")->values[i], 0.2f);
    EXPECT_EQ(image.rgba[4 * i + 3], 1);
    const Ray ray = rays(static_cast<double>(i % 64) + 0.5, static_cast<double>(i / 64) + 0.5);
    Point p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = ray.origin[a] + depth * ray.direction[a];
    worst = std::max(worst, std::abs(product(p) - 0.2));
  }
  EXPECT_GT(hits, 500);
  // A depth of some 3 in single precision is off by 1e-7, the values inside of cells by 1e-7.
  EXPECT_LT(worst, 2e-6);
}

TEST(Isosurfaces, DepthIsOfTheFirstHit) {
  Scene scene(with(generate("box-tetrahedra", {5, 0.2, 3}), linear));
  Classification hidden = everything();
  hidden.isosurfaces.push_back({5, 0, {1, 1, 1}});  // transparent: no hit
  hidden.isosurfaces.push_back({4.5f, 0.3f});
  scene.set_classification(hidden);
  Camera camera;
  camera.position = {0.5, 0.5, 3};
  camera.focal_point = {0.5, 0.5, 0};
  camera.view_up = {0, 1, 0};
  RenderSettings settings = exact(1);
  settings.channels = {"depth", "isovalue", "cell_count", "optical_depth"};
  const RenderResult result = render(scene, camera, settings);
  // s = 1.5 + 3 z; the ray begins at 4.5, which is an end and an isovalue, above it, and falls.
  EXPECT_NEAR(result.image.channel("depth")->values[0], 2, 1e-6);
  EXPECT_EQ(result.image.channel("isovalue")->values[0], 4.5f);
  EXPECT_EQ(result.image.channel("cell_count")->values[0],
            static_cast<float>(result.statistics.cells_visited));
  EXPECT_NEAR(-std::log1p(-result.image.rgba[3]), result.image.channel("optical_depth")->values[0],
              1e-5);
  settings.mode = Mode::depth;
  settings.channels = {};
  EXPECT_NEAR(render(scene, camera, settings).image.channels[0].values[0], 2, 1e-6);
}

TEST(Classified, ScenesCostOnlyWhatTheyNeed) {
  Scene scene(with(generate("box-tetrahedra", {4, 0.2, 3}), linear));
  const Camera camera = askew(scene.bounds());
  const RenderResult before = render(scene, camera, exact(32));
  EXPECT_TRUE(has(before.statistics.plan, "rays: in packets"));
  EXPECT_FALSE(has(before.statistics.plan, "intervals"));
  const TransferFunction volume = scene.transfer_function();
  scene.set_classification({volume, {{1, 2, even_profile(0.5f, {1, 1, 1})}}, {{3}}});
  const RenderResult surfaces = render(scene, camera, exact(32));
  EXPECT_TRUE(has(surfaces.statistics.plan, "rays: in packets"));
  EXPECT_TRUE(has(surfaces.statistics.plan, "intervals: [1, 2]"));
  EXPECT_TRUE(has(surfaces.statistics.plan, "isosurfaces: 3, in closed form"));
  EXPECT_GT(worst_difference(before.image, surfaces.image), 0.1);
  // Modes that know no surfaces are as they were.
  RenderSettings maximum = exact(32);
  maximum.mode = Mode::maximum;
  const Image with_surfaces = render(scene, camera, maximum).image;
  scene.set_classification({volume, {}, {}});
  EXPECT_EQ(worst_difference(render(scene, camera, maximum).image, with_surfaces), 0);
  const RenderResult after = render(scene, camera, exact(32));
  EXPECT_TRUE(has(after.statistics.plan, "rays: in packets"));
  EXPECT_EQ(worst_difference(before.image, after.image), 0);
}

TEST(Classified, ProblemsAreErrors) {
  Scene scene(with(generate("box-tetrahedra", {2, 0, 1}), linear));
  auto message = [](auto&& doing) -> std::string {
    try {
      doing();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const TransferFunction half = even_profile(0.5f, {1, 1, 1});
  EXPECT_NE(message([&] {
              scene.set_classification({{}, {{0, 2, half}, {1, 3, half}}, {}});
            }).find("[0, 2] and [1, 3] overlap"),
            std::string::npos);
  RenderSettings settings = exact(4);
  settings.channels = {"isovalue"};
  EXPECT_NE(message([&] { render(scene, askew(scene.bounds()), settings); }).find("isovalue"),
            std::string::npos);
}

// The paper's way, to compare: near what is split in data space on the average, and off it at
// bounds.
TEST(Classified, TablesShowNearlyTheSame) {
  Scene scene(with(generate("box-tetrahedra", {6, 0.2, 3}), linear));
  scene.set_classification(everything());
  const Camera camera = askew(scene.bounds());
  const Image split = render(scene, camera, exact(48)).image;
  RenderSettings table = exact(48);
  table.interval_way = IntervalWay::table;
  double last = 1;
  for (const int scalars : {32, 128, 512}) {
    table.interval_table.scalar_count = scalars;
    const RenderResult result = render(scene, camera, table);
    EXPECT_TRUE(has(result.statistics.plan, "intervals: [1, 1.5] [1.5, 2] [4, 4.5], from tables"));
    EXPECT_TRUE(has(result.statistics.plan, "rays: one by one"));
    double mean = 0;
    for (std::size_t i = 0; i < split.rgba.size(); ++i)
      mean +=
          std::abs(result.image.rgba[i] - split.rgba[i]) / static_cast<double>(split.rgba.size());
    EXPECT_LT(mean, 0.5 * last) << scalars;
    last = mean;
  }
  EXPECT_LT(last, 2e-3);
  EXPECT_GT(last, 1e-7);
  table.channels = {"depth"};
  EXPECT_THROW(render(scene, camera, table), Error);
  table.channels = {};
  table.interval_table.scalar_count = 1;
  EXPECT_THROW(render(scene, camera, table), Error);
}

// Values of cells: an isosurface lies between them, and an interval in a jump is crossed whole.
TEST(Classified, CellsThatAreConstantAreJumpsBetweenThem) {
  Mesh mesh = generate("box-rectilinear", {4, 0, 1});
  std::vector<double> values;
  for (int i = 0; i < 64; ++i) values.push_back(i / 16);  // layers along z: 0, 1, 2, 3
  mesh.fields = {{"layer", Association::cell, 1, Array::own(std::move(values))}};
  mesh.active_field = "layer";
  Scene scene(mesh);
  scene.set_classification({{}, {{1.25f, 1.75f, even_profile(0.5f, {1, 1, 1})}}, {{2.5f, 0.5f}}});
  Camera camera = named_view("-z", scene.bounds());
  camera.parallel = true;
  camera.parallel_scale = 0.45;
  RenderSettings settings = exact(32);
  settings.channels = {"depth"};
  const Image image = render(scene, camera, settings).image;
  for (std::size_t i = 0; i < 32 * 32; ++i) {
    ASSERT_NEAR(image.rgba[4 * i + 3], 0.75, 1e-6);
    const double z = camera.position[2] - image.channel("depth")->values[i];
    ASSERT_NEAR(z, 0.75, 1e-6);  // between the layers 3 and 2
  }
}

}  // namespace
}  // namespace plume::test
