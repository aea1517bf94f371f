// The paper's figures 6 and 7 in numbers: two cells at high magnification, classic volume rendering
// beside ours.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/tests/lib/interval_scenes.h"
#include "plume/tests/reference/adaptive_quadrature.h"

namespace plume::test {
namespace {

// The paper's figures 6 and 7: two cells, seen from very near, a linear field in each whose
// gradient bends where they meet.
struct TwoCells {
  Mesh mesh;
  Camera camera;

  explicit TwoCells(double bend) {
    mesh.points =
        Array::own(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1,
                                       0, 1, 1, 1, 1, 1, 2, 0, 0, 2, 1, 0, 2, 0, 1, 2, 1, 1});
    mesh.cells.types = Array::own(std::vector<std::uint8_t>{12});
    mesh.cells.connectivity =
        Array::own(std::vector<std::int32_t>{0, 1, 3, 2, 4, 5, 7, 6, 1, 8, 9, 3, 5, 10, 11, 7});
    mesh = with(std::move(mesh), [&](const Point& p) {
      return p[2] * (1 + (p[0] > 1 ? bend * (p[0] - 1) : 0)) + 0.1 * p[0];
    });
    // At the border of the cells, from above, a ten thousandth of a cell across.
    camera.position = {1, 0.4321, 3};
    camera.focal_point = {1, 0.4321, 0.5};
    camera.view_up = {0, 1, 0};
    camera.parallel = true;
    camera.parallel_scale = 1e-4;
  }
};

struct Range {
  double low = 1e9, high = -1e9;
  double width() const { return high - low; }
};

Range range_of(const Image& image, std::size_t channel) {
  Range range;
  for (std::size_t i = channel; i < image.rgba.size(); i += 4) {
    range.low = std::min<double>(range.low, image.rgba[i]);
    range.high = std::max<double>(range.high, image.rgba[i]);
  }
  return range;
}

Range alphas(const Image& image) { return range_of(image, 3); }

// The same look as a volume: of that optical depth where the scalar rises by one per length.
TransferFunction as_volume(float low, float high, double optical_depth) {
  const float tau = static_cast<float>(optical_depth / (high - low));
  return {{{low, {0, {}}}, {low, {tau, {0, 1, 0}}}, {high, {tau, {0, 1, 0}}}, {high, {0, {}}}}};
}

// From three sides, as in figure 6, and from ever nearer.
TEST(TwoCells, AFullyCrossedIntervalLooksTheSameHoweverNearAndFromEverySide) {
  const TransferFunction profile{
      {{0, {0.1f, {1, 0, 0}}}, {0.3f, {2, {0, 1, 0}}}, {1, {0.4f, {0, 0, 1}}}}};
  Classification interval;
  interval.intervals = {{0.4f, 0.6f, profile}};
  double worst = 0, classic_worst = 0;
  for (const Point& view : {Point{0, 0, -1}, Point{0.5, 0.3, -1}, Point{-0.6, 0.1, -1}})
    for (const double scale : {1e-4, 1e-2, 0.1})
      for (const bool parallel : {true, false}) {
        TwoCells cells(1.5);
        cells.camera.parallel = parallel;
        cells.camera.parallel_scale = scale;
        for (std::size_t a = 0; a < 3; ++a)
          cells.camera.position[a] = cells.camera.focal_point[a] - 2 * view[a];
        cells.camera.view_angle = 2 * std::atan(scale / 2) * 180 / std::acos(-1);
        Scene scene(cells.mesh);
        for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic}) {
          RenderSettings settings = exact(128);
          settings.order = order;
          scene.set_classification(interval);
          const Image ours = render(scene, cells.camera, settings).image;
          // Every ray comes from above: this is what it sees, wherever.
          const auto expected = reference::integrate_linear(profile, 1, 0, 1);
          for (std::size_t c = 0; c < 4; ++c) {
            const Range range = range_of(ours, c);
            worst = std::max(worst, range.width());
            EXPECT_NEAR(range.low, c < 3 ? expected.rgb[c] : expected.alpha, 1e-6);  // no crack
          }
          scene.set_classification({as_volume(0.4f, 0.6f, expected.optical_depth), {}, {}});
          const Range classic = alphas(render(scene, cells.camera, settings).image);
          classic_worst = std::max(classic_worst, classic.width());
        }
      }
  EXPECT_LT(worst, 1e-5);
  EXPECT_GT(classic_worst, 0.05);
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
  RecordProperty("classic", std::to_string(classic_worst));
}

TEST(TwoCells, IsosurfacesHaveOneOpacityEach) {
  TwoCells cells(1.5);
  cells.camera.parallel_scale = 0.4;
  Scene scene(cells.mesh);
  Classification surfaces;
  std::vector<TransferFunction::Knot> peaks;  // the same as sharp peaks of a volume
  for (const float value : {0.3f, 0.4f, 0.5f, 0.6f}) {
    surfaces.isosurfaces.push_back({value, 0.3f, {0, 1, 0}});
    peaks.push_back({value - 0.005f, {0, {0, 1, 0}}});
    peaks.push_back({value, {70, {0, 1, 0}}});
    peaks.push_back({value + 0.005f, {0, {0, 1, 0}}});
  }
  scene.set_classification(surfaces);
  const Range ours = alphas(render(scene, cells.camera, exact(256)).image);
  RecordProperty("worst", std::to_string(ours.width() * 1e9) + "e-9");
  EXPECT_LT(ours.width(), 1e-6);
  EXPECT_NEAR(ours.low, 1 - std::pow(0.7, 4), 1e-6);
  scene.set_classification({TransferFunction{peaks}, {}, {}});
  const double classic = alphas(render(scene, cells.camera, exact(256)).image).width();
  EXPECT_GT(classic, 0.1);
  RecordProperty("classic", std::to_string(classic));
}

// Along a row of pixels across the border: the second difference of what is seen.
double bend_of(const Image& image) {
  double worst = 0;
  const int y = image.height / 2;
  for (int x = 1; x + 1 < image.width; ++x)
    worst = std::max(
        worst, static_cast<double>(std::abs(image.pixel(x - 1, y)[3] - 2 * image.pixel(x, y)[3] +
                                            image.pixel(x + 1, y)[3])));
  return worst;
}

TEST(TwoCells, NoBendAtTheBorderOfTheCells) {
  TwoCells cells(1.5);
  cells.camera.parallel_scale = 0.4;
  Scene scene(cells.mesh);
  Classification interval;
  interval.intervals = {{0.4f, 0.6f, even_profile(0.5f, {0, 1, 0})}};
  scene.set_classification(interval);
  const double ours = bend_of(render(scene, cells.camera, exact(256)).image);
  scene.set_classification({as_volume(0.4f, 0.6f, std::log(2)), {}, {}});
  const double classic = bend_of(render(scene, cells.camera, exact(256)).image);
  EXPECT_LT(ours, 1e-6);
  RecordProperty("bend", std::to_string(ours * 1e9) + "e-9");
  RecordProperty("classic", std::to_string(classic));
  // Opacity is 1 - exp(-ln 2 / (1 + 1.5 (x - 1))) beyond x = 1: its slope drops by 0.52, and the
  // border lies between two pixels, each of which sees half of 0.52 times a pixel.
  EXPECT_NEAR(classic, 0.5 * 0.52 * 0.8 / 256, 5e-5);
}

TEST(TwoCells, IsosurfacesAtTheValuesOfVerticesHaveNoSpeckles) {
  // The field is 0, 1, 2, ... in layers: isovalues are all those of vertices, and one is that of
  // whole faces, which lie across every ray.
  for (const char* form : {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear"})
    for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic}) {
      Scene scene(
          with(generate(form, {6, 0, 1}), [](const Point& p) { return std::round(6 * p[2]); }));
      Classification surfaces;
      surfaces.isosurfaces = {{2, 0.5f, {1, 0, 0}}, {3, 0.25f, {0, 1, 0}}};
      scene.set_classification(surfaces);
      Camera camera = named_view("-z", scene.bounds());
      camera.parallel = true;
      camera.parallel_scale = 0.45;
      RenderSettings settings = exact(96);
      settings.order = order;
      const RenderResult result = render(scene, camera, settings);
      const Range opacity = alphas(result.image);
      EXPECT_NEAR(opacity.low, 0.625, 1e-6) << form;
      EXPECT_NEAR(opacity.high, 0.625, 1e-6) << form;
      EXPECT_EQ(result.statistics.surfaces, 2u * 96 * 96);
    }
}

TEST(TwoCells, APlateauAtTheIsovalueHasNoSpeckles) {
  // 0 below, 1 from z = 1/3 to 2/3, above rising or falling: crossed once, or in and out.
  for (const double above : {2.0, 0.0})
    for (const char* form : {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear"}) {
      Scene scene(with(generate(form, {6, 0, 1}), [&](const Point& p) {
        const double layer = std::round(6 * p[2]);
        return layer < 2 ? 0.0 : layer <= 4 ? 1.0 : above;
      }));
      Classification surfaces;
      surfaces.isosurfaces = {{1, 0.5f, {1, 1, 1}}};
      scene.set_classification(surfaces);
      const Camera camera = [&] {
        Camera c = fitted_camera(scene.bounds(), {0.05, 0.03, -1});
        c.parallel = true;
        c.parallel_scale = 0.4;
        return c;
      }();
      const Range opacity = alphas(render(scene, camera, exact(96)).image);
      const double expected = above > 1 ? 0.5 : 0.75;
      EXPECT_NEAR(opacity.low, expected, 1e-6) << form << above;
      EXPECT_NEAR(opacity.high, expected, 1e-6) << form << above;
    }
}

}  // namespace
}  // namespace plume::test
