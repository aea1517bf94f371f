#include "plume/lib/color_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plume/lib/color_space.h"
#include "plume/lib/srgb.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

using Color = std::array<double, 3>;

void expect_color(const Color& got, const Color& wanted, double tolerance) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], wanted[c], tolerance) << "channel " << c;
}

/// The map's display colours (black to white by default) with opacity points.
ColorMap map_of(std::vector<ColorMap::OpacityPoint> opacities,
                std::vector<ColorMap::ColorPoint> colors = {{0, {0, 0, 0}}, {1, {1, 1, 1}}}) {
  ColorMap map;
  map.name = "test";
  map.colors = std::move(colors);
  map.opacities = std::move(opacities);
  return map;
}

double opacity_at(const TransferFunction& function, double x, double unit_distance = 1) {
  const double extinction = static_cast<double>(function.at(static_cast<float>(x)).extinction);
  return -std::expm1(-extinction * unit_distance);
}

template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Srgb, IsTheStandardsCurve) {
  EXPECT_EQ(srgb_to_linear(0), 0);
  EXPECT_EQ(srgb_to_linear(1), 1);
  EXPECT_NEAR(srgb_to_linear(0.5), 0.21404114, 1e-8);
  EXPECT_NEAR(linear_to_srgb(0.5), 0.73535698, 1e-8);
  EXPECT_NEAR(linear_to_srgb(0.0031308), 0.040449936, 1e-9);
  for (double x = 0; x <= 1; x += 1.0 / 64) EXPECT_NEAR(linear_to_srgb(srgb_to_linear(x)), x, 1e-7);
}

// By hand from each space's definition; below "VTK", what vtkColorTransferFunction of VTK 9.1
// gives.
TEST(ColorSpace, MidpointsOfEachSpace) {
  using Space = ColorMap::Space;
  const Color red{1, 0, 0}, yellow{1, 1, 0}, green{0, 1, 0}, blue{0, 0, 1};
  expect_color(interpolate(Space::rgb, red, green, 0.25), {0.75, 0.25, 0}, 1e-12);
  expect_color(interpolate(Space::hsv, red, green, 0.5), yellow, 1e-12);
  expect_color(interpolate(Space::hsv, blue, red, 0.5), green, 1e-12);
  expect_color(interpolate(Space::hsv, {0.5, 0, 0}, {1, 1, 1}, 0.5), {0.75, 0.375, 0.375}, 1e-12);
  // L = 50, a = b = 0, luminance 0.1842.
  const double gray = linear_to_srgb(std::pow(66.0 / 116, 3));
  expect_color(interpolate(Space::lab, {0, 0, 0}, {1, 1, 1}, 0.5), {gray, gray, gray}, 1e-3);
  expect_color(interpolate(Space::step, red, green, 0.01), green, 0);
  // VTK.
  expect_color(interpolate(Space::lab, red, blue, 0.5), {0.790313, 0, 0.535188}, 1e-6);
  expect_color(interpolate(Space::lab, {0.1, 0.8, 0.3}, {0.9, 0.2, 0.55}, 0.25),
               {0.493766, 0.698186, 0.377129}, 1e-6);
  const Color cool{0x3b / 255.0, 0x4c / 255.0, 0xc0 / 255.0};
  const Color warm{0xb4 / 255.0, 0x04 / 255.0, 0x26 / 255.0};
  expect_color(interpolate(Space::diverging, cool, warm, 0.25), {0.553318, 0.688635, 0.995188},
               1e-6);
  expect_color(interpolate(Space::diverging, cool, warm, 0.75), {0.958418, 0.603116, 0.481685},
               1e-6);
  expect_color(interpolate(Space::diverging, {0.1, 0.8, 0.3}, {0.5, 0.5, 0.5}, 0.5),
               {0.564749, 0.770279, 0.566967}, 1e-6);
}

TEST(ColorSpace, EndsAreTheGivenColours) {
  const Color a{0.1, 0.8, 0.3}, b{0.9, 0.2, 0.55};
  for (auto space : {ColorMap::Space::rgb, ColorMap::Space::hsv, ColorMap::Space::lab,
                     ColorMap::Space::diverging}) {
    expect_color(interpolate(space, a, b, 0), a, 1e-3);
    expect_color(interpolate(space, a, b, 1), b, 1e-3);
  }
}

TEST(ColorMap, OpacityBecomesExtinction) {
  const TransferFunction f = to_transfer_function(map_of({{0, 0.5}, {1, 0.5}}), 0.25, 3);
  ASSERT_EQ(f.problem(), std::nullopt);
  // -ln(1/2) / 0.25 * 3
  EXPECT_FLOAT_EQ(f.at(0.5f).extinction, 8.317766f);
}

TEST(ColorMap, OpaqueIsADepthOfTwentyFourHalvings) {
  const TransferFunction f = to_transfer_function(map_of({{0, 1}, {1, 1}}), 1);
  EXPECT_FLOAT_EQ(f.at(0.5f).extinction, 16.635532f);  // 24 ln 2
}

TEST(ColorMap, WithoutOpacityPointsItRamps) {
  const TransferFunction f = to_transfer_function(map_of({}), 1);
  for (double x : {0.0, 0.2, 0.5, 0.9}) EXPECT_NEAR(opacity_at(f, x), x, 1e-3);
}

TEST(ColorMap, ColoursBecomeLinear) {
  const TransferFunction f = to_transfer_function(map_of({{0, 0}, {1, 1}}), 1);
  for (double x : {0.0, 0.02, 0.25, 0.5, 1.0}) {
    EXPECT_NEAR(static_cast<double>(f.at(static_cast<float>(x)).color[1]), srgb_to_linear(x), 1e-3);
  }
}

// The bound of the header, everywhere and not only halfway between knots; the map evaluated anew.
TEST(ColorMap, ResamplingKeepsItsBound) {
  for (const std::string& name : preset_names()) {
    for (double unit_distance : {0.01, 1.0, 50.0}) {
      for (double scale : {1.0, 20.0}) {
        const ColorMap map = rescaled(*preset(name), -3, 5);
        const TransferFunction f = to_transfer_function(map, unit_distance, scale);
        ASSERT_EQ(f.problem(), std::nullopt);
        EXPECT_LT(f.knots.size(), 1000u);
        for (int i = 0; i <= 20000; ++i) {
          const float x = static_cast<float>(-3 + 8.0 * i / 20000);
          const double t = (static_cast<double>(x) + 3) / 8;
          const auto after =
              std::upper_bound(map.colors.begin(), map.colors.end(), static_cast<double>(x),
                               [](double value, const auto& p) { return value < p.x; });
          const auto b = after == map.colors.end() ? after - 1 : after;
          const Color srgb =
              interpolate(map.space, (b - 1)->srgb, b->srgb,
                          (static_cast<double>(x) - (b - 1)->x) / (b->x - (b - 1)->x));
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_NEAR(static_cast<double>(f.at(x).color[c]), srgb_to_linear(srgb[c]), 1e-3)
                << name << " at " << x;
          }
          ASSERT_NEAR(opacity_at(f, static_cast<double>(x), unit_distance / scale),
                      std::min(t, 1 - 0x1p-24), 1e-3)
              << name << " at " << x;
        }
      }
    }
  }
}

// By hand from vtkPiecewiseFunction's definition: at the midpoint, half; a quarter of the way to a
// midpoint of 0.25, s = 0.125.
TEST(ColorMap, MidpointMovesTheHalf) {
  const TransferFunction f = to_transfer_function(map_of({{0, 0, 0.25, 0}, {1, 0.8}}), 1);
  EXPECT_NEAR(opacity_at(f, 0.25), 0.4, 1e-3);
  EXPECT_NEAR(opacity_at(f, 0.0625), 0.1, 1e-3);
  EXPECT_NEAR(opacity_at(f, 0.625), 0.6, 1e-3);
}

TEST(ColorMap, SharpnessFlattensTheEnds) {
  const TransferFunction f = to_transfer_function(map_of({{0, 0, 0.5, 0.5}, {1, 1}}), 1);
  // t = 0.25: s = 0.5 * 0.5^6 = 1/128; 3 s^2 - 2 s^3 + 0.5 (2 s^3 - 3 s^2 + s) = 0.00399756
  EXPECT_NEAR(opacity_at(f, 0.25), 0.003998, 1e-3);
  EXPECT_NEAR(opacity_at(f, 0.5), 0.5, 1e-3);
  // t = 0.45: s = 0.5 * 0.9^6 = 0.2657205; by the same formula 0.2200
  EXPECT_NEAR(opacity_at(f, 0.45), 0.219958, 1e-3);
}

TEST(ColorMap, FullSharpnessIsAStepAtTheMidpoint) {
  const TransferFunction f = to_transfer_function(map_of({{0, 0.1, 0.25, 1}, {1, 0.7}}), 1);
  ASSERT_EQ(f.problem(), std::nullopt);
  EXPECT_NEAR(opacity_at(f, std::nextafter(0.25f, 0.0f)), 0.1, 1e-6);
  EXPECT_NEAR(opacity_at(f, 0.25), 0.7, 1e-6);
  EXPECT_NEAR(opacity_at(f, 0.9), 0.7, 1e-6);
}

TEST(ColorMap, StepColoursJumpAtThePoints) {
  ColorMap map = map_of({{0, 0.5}, {2, 0.5}}, {{0, {1, 0, 0}}, {1, {0, 1, 0}}, {2, {0, 0, 1}}});
  map.space = ColorMap::Space::step;
  const TransferFunction f = to_transfer_function(map, 1);
  EXPECT_EQ(f.at(0.5f).color, (std::array<float, 3>{0, 1, 0}));
  EXPECT_EQ(f.at(std::nextafter(1.0f, 0.0f)).color, (std::array<float, 3>{0, 1, 0}));
  EXPECT_EQ(f.at(1).color, (std::array<float, 3>{0, 0, 1}));
  EXPECT_EQ(f.knots.size(), 4u);
}

TEST(ColorMap, TwoPointsAtOnePlaceAreAStep) {
  const TransferFunction f = to_transfer_function(
      map_of({{0, 0.2}, {0.5, 0.2}, {0.5, 0.6}, {1, 0.6}},
             {{0, {0, 0, 0}}, {0.5, {0, 0, 0}}, {0.5, {1, 1, 1}}, {1, {1, 1, 1}}}),
      1);
  ASSERT_EQ(f.problem(), std::nullopt);
  EXPECT_NEAR(opacity_at(f, std::nextafter(0.5f, 0.0f)), 0.2, 1e-6);
  EXPECT_NEAR(opacity_at(f, 0.5), 0.6, 1e-6);
  EXPECT_EQ(f.at(std::nextafter(0.5f, 0.0f)).color[0], 0);
  EXPECT_EQ(f.at(0.5f).color[0], 1);
}

TEST(ColorMap, RangesOfColourAndOpacityMayDiffer) {
  const TransferFunction f =
      to_transfer_function(map_of({{2, 0.3}, {3, 0.6}}, {{0, {0, 0, 0}}, {1, {1, 0, 0}}}), 1);
  EXPECT_NEAR(opacity_at(f, 0.5), 0.3, 1e-6);
  EXPECT_NEAR(opacity_at(f, 9), 0.6, 1e-6);
  EXPECT_EQ(f.at(2.5f).color[0], 1);
}

TEST(ColorMap, TinyRangesFarFromZeroStayValid) {
  // Floats are 0.0625 apart here: most of the points fall together.
  const ColorMap map = rescaled(*preset("viridis"), 1e6, 1e6 + 0.25);
  const TransferFunction f = to_transfer_function(map, 1);
  EXPECT_EQ(f.problem(), std::nullopt);
  EXPECT_LE(f.knots.size(), 10u);
}

TEST(ColorMap, RescaledHitsItsEnds) {
  const ColorMap map = rescaled(map_of({{2, 0}, {4, 1}}, {{1, {0, 0, 0}}, {3, {1, 1, 1}}}), 10, 40);
  EXPECT_EQ(map.colors[0].x, 10);
  EXPECT_EQ(map.colors[1].x, 30);
  EXPECT_EQ(map.opacities[0].x, 20);
  EXPECT_EQ(map.opacities[1].x, 40);
  EXPECT_NE(message_of([] { rescaled(*preset("gray"), 2, 2); }).find("[2, 2]"), std::string::npos);
}

TEST(ColorMap, Presets) {
  EXPECT_EQ(preset_names(), (std::vector<std::string>{"cool-warm", "viridis", "inferno", "turbo",
                                                      "gray", "rainbow"}));
  EXPECT_FALSE(preset("no such map").has_value());
  const auto shown = [](const char* name, float x) {
    const Optics optics = to_transfer_function(*preset(name), 1).at(x);
    Color display{};
    for (std::size_t c = 0; c < 3; ++c) {
      display[c] = 255 * linear_to_srgb(static_cast<double>(optics.color[c]));
    }
    return display;
  };
  // Entries of the published tables, numbers 128 (viridis) and 128 (inferno) of 0 to 255, which
  // lie between our points.
  expect_color(shown("viridis", 128 / 255.0f), {0.127568 * 255, 0.566949 * 255, 0.550556 * 255}, 2);
  expect_color(shown("inferno", 128 / 255.0f), {0.735683 * 255, 0.215906 * 255, 0.330245 * 255}, 2);
  expect_color(shown("turbo", 136 / 255.0f), {0.72596 * 255, 0.96470 * 255, 0.20640 * 255}, 1);
  expect_color(shown("rainbow", 0.5f), {0, 255, 0}, 1);
  expect_color(shown("gray", 0.5f), {127.5, 127.5, 127.5}, 0.5);
  // Moreland's table has 221, 221, 221 in the middle.
  expect_color(shown("cool-warm", 0.5f), {221, 221, 221}, 1);
}

TEST(ColorMap, MapsThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ColorMap::ColorPoint> good{{0, {0, 0, 0}}, {1, {1, 1, 1}}};
  struct Case {
    ColorMap map;
    const char* says;
  };
  const Case cases[] = {
      {map_of({}, {}), "0 colour points"},
      {map_of({}, {{0, {0, 0, 0}}}), "1 colour points"},
      {map_of({}, {{1, {0, 0, 0}}, {0, {1, 1, 1}}}), "colour point 1: x must ascend"},
      {map_of({}, {{1, {0, 0, 0}}, {1, {1, 1, 1}}}), "greater than the first"},
      {map_of({}, {{0, {0, 0, 0}}, {0, {0, 0, 0}}, {0, {0, 0, 0}}, {1, {1, 1, 1}}}),
       "colour point 2"},
      {map_of({}, {{0, {0, 0, 0}}, {1, {1, 1.5, 1}}}), "is 1.5"},
      {map_of({}, {{0, {0, 0, 0}}, {nan, {1, 1, 1}}}), "finite"},
      {map_of({{0, 0}}), "1 opacity points"},
      {map_of({{0, 0}, {1, -0.5}}),
       "opacity point 1: opacity must lie within 0 and 1, but is -0.5"},
      {map_of({{0, 0}, {1, nan}}), "opacity must"},
      {map_of({{0, 0, 2, 0}, {1, 1}}), "midpoint"},
      {map_of({{0, 0, 0.5, -1}, {1, 1}}), "sharpness"},
  };
  for (const Case& c : cases) {
    const std::string message = message_of([&] { to_transfer_function(c.map, 1); });
    EXPECT_NE(message.find(c.says), std::string::npos) << message << " lacks " << c.says;
    EXPECT_NE(message.find("'test'"), std::string::npos) << message;
  }
  for (double distance : {0.0, -1.0, nan}) {
    EXPECT_NE(message_of([&] { to_transfer_function(map_of({}), distance); }).find("unit distance"),
              std::string::npos);
  }
  EXPECT_NE(message_of([&] { to_transfer_function(map_of({}), 1, -2); }).find("opacity scale"),
            std::string::npos);
  // 16.6 / 1e-44 is no float.
  EXPECT_NE(message_of([&] { to_transfer_function(map_of({}), 1e-44); }).find("single precision"),
            std::string::npos);
}

}  // namespace
}  // namespace plume
