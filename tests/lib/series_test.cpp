// What pictures of a series share: the range of colours, and of shades of gray.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/lib/render_modes.h"

namespace plume::test {
namespace {

Mesh street(double time) { return generate("vortex-street", {.size = 8, .time = time}); }

RenderSettings small(Mode mode) {
  RenderSettings settings;
  settings.width = 40;
  settings.height = 30;
  settings.mode = mode;
  return settings;
}

TEST(Series, GrayRangeGivesANumberTheSameShadeInEveryPicture) {
  for (const Mode mode : {Mode::integral, Mode::optical_depth, Mode::depth, Mode::cell_count}) {
    SCOPED_TRACE(in_words(mode).name);
    for (const double time : {0.0, 2.0}) {
      const Scene scene(street(time), {.field = {"velocity", {}}});
      const Camera camera = named_view("iso", scene.bounds());
      RenderSettings settings = small(mode);
      const RenderResult fitted = render(scene, camera, settings);
      ASSERT_TRUE(fitted.statistics.values && fitted.statistics.gray_range);
      const auto [least, greatest] = *fitted.statistics.values;
      const auto [from, to] = *fitted.statistics.gray_range;
      EXPECT_EQ(from, mode == Mode::depth ? least : std::min(least, 0.0f));
      EXPECT_EQ(to, greatest);

      // From a value that some pixels are below to one that some are above.
      const float low = 0.7f * least + 0.3f * greatest, high = 0.2f * least + 0.8f * greatest;
      settings.gray_range = {low, high};
      const RenderResult fixed = render(scene, camera, settings);
      EXPECT_EQ(fixed.statistics.values, fitted.statistics.values);
      EXPECT_EQ(fixed.statistics.gray_range, settings.gray_range);
      const auto& numbers = fixed.image.channel(in_words(mode).channel)->values;
      int ends = 0;
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const float* pixel = &fixed.image.rgba[4 * i];
        if (pixel[3] == 0) continue;
        float shade = std::clamp((numbers[i] - low) / (high - low), 0.0f, 1.0f);
        ends += shade == 0 || shade == 1 ? 1 : 0;
        if (mode == Mode::depth) shade = 1 - shade;
        for (int c = 0; c < 3; ++c) EXPECT_EQ(pixel[c], shade);
      }
      EXPECT_GT(ends, 0);
    }
  }
}

TEST(Series, ModesWithColoursHaveNoShades) {
  const Scene scene(street(0));
  for (const Mode mode : {Mode::volume, Mode::maximum, Mode::average}) {
    const RenderResult result = render(scene, named_view("iso", scene.bounds()), small(mode));
    EXPECT_FALSE(result.statistics.gray_range);
  }
}

TEST(Series, GrayRangeMustBeOne) {
  const Scene scene(street(0));
  RenderSettings settings = small(Mode::integral);
  for (const std::array<float, 2> range : {std::array{1.0f, 1.0f}, {2.0f, 1.0f}, {NAN, 1.0f}}) {
    settings.gray_range = range;
    EXPECT_THROW(render(scene, named_view("iso", scene.bounds()), settings), Error);
  }
}

TEST(Series, ColorRangeIsWhatTheDefaultMapRunsOver) {
  const Scene own(street(0));
  EXPECT_GT(own.default_color_map().colors.front().x, own.field().low);
  const Scene told(street(0), {.color_range = {{-10.0, 20.0}}});
  const ColorMap& map = told.default_color_map();
  EXPECT_DOUBLE_EQ(map.colors.front().x, -10);
  EXPECT_DOUBLE_EQ(map.colors.back().x, 20);
  // What this step does not reach is as opaque as anything is; what most of it is, the least.
  const auto opacity_at = [&](double x) {
    const auto nearest = std::min_element(
        map.opacities.begin(), map.opacities.end(),
        [&](const auto& a, const auto& b) { return std::abs(a.x - x) < std::abs(b.x - x); });
    return nearest->opacity;
  };
  for (const auto& point : map.opacities) {
    EXPECT_LE(point.opacity, opacity_at(15));
    EXPECT_GE(point.opacity, opacity_at(0));
  }
  EXPECT_LT(opacity_at(0), 0.1);
}

TEST(Series, ColorRangeMakesAMapEvenOfAConstantFirstStep) {
  Mesh mesh = street(0);
  mesh.fields = {
      {"p", Association::point, 1, Array::own(std::vector<float>(mesh.point_count(), 1.0f))}};
  const Scene scene(mesh, {.color_range = {{0.0, 4.0}}});
  EXPECT_DOUBLE_EQ(scene.default_color_map().colors.back().x, 4);
  EXPECT_GT(scene.default_unit_distance(), 0);
}

}  // namespace
}  // namespace plume::test
