// Opaque things in front of, inside and behind a volume.

#include "plume/lib/opaque_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/mesh/error.h"

namespace plume::test {
namespace {

constexpr float kExtinction = 2;
constexpr std::array<float, 3> kRed{0.8f, 0.1f, 0.2f};

// A rectangle across z that covers x < 0.6 of a picture along z.
OpaqueSurface plate(double z) {
  OpaqueSurface surface;
  surface.points = {{-1, -1, z}, {0.6, -1, z}, {0.6, 2, z}, {-1, 2, z}};
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  surface.color = kRed;
  return surface;
}

// The unit box, evenly white, seen along -z; surfaces keep their colours.
struct Shot {
  Scene scene;
  Camera camera;
  RenderSettings settings;

  explicit Shot(const std::string& form) : scene(generate(form, {4, 0.1, 3}), {{"linear", {}}}) {
    camera.position = {0.5, 0.5, 5};
    camera.focal_point = {0.5, 0.5, 0.5};
    camera.parallel = true;
    camera.parallel_scale = 0.4;  // all of the picture shows the box
    settings.width = settings.height = 40;
    settings.early_termination = 0;
    settings.lighting = Lighting{{}, 1, 0, 0, 1, false};
    scene.set_transfer_function({{{0, {kExtinction, {1, 1, 1}}}}});
  }
  Image picture() const { return render(scene, camera, settings).image; }
  // Pixels well to the left and well to the right of the plate's edge.
  void for_each_pixel(const std::function<void(std::size_t, bool)>& check) const {
    const PixelRays rays(camera, settings.width, settings.height);
    for (int y = 0; y < settings.height; ++y)
      for (int x = 0; x < settings.width; ++x) {
        const double place = rays(x + 0.5, y + 0.5).origin[0];
        if (std::abs(place - 0.6) > 1e-4)
          check(static_cast<std::size_t>(y * settings.width + x), place < 0.6);
      }
  }
};

const char* const kForms[] = {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear"};

Shot lit_by_itself(const char* form) {
  Shot shot(form);
  shot.settings.lighting.reset();
  return shot;
}

TEST(OpaqueSurface, HidesWhatIsBehindIt) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Shot shot(form);
    shot.settings.lighting.reset();
    const Image without = shot.picture();
    for (const double z : {1.5, 0.7, 0.21, -0.5}) {
      SCOPED_TRACE(z);
      shot.scene.remove_surfaces();
      shot.scene.add_surface(plate(z));
      const Image image = shot.picture();
      const double clear = std::exp(-kExtinction * std::min(1.0, std::max(0.0, 1 - z)));
      shot.for_each_pixel([&](std::size_t i, bool covered) {
        const float* rgba = &image.rgba[4 * i];
        if (!covered) {
          for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(rgba[c], without.rgba[4 * i + c]);
          return;
        }
        // The headlight meets the plate head-on: ambient and diffuse add up to 1.
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(rgba[c], (1 - clear) + clear * (kRed[c] + 0.25), 1e-5);
        ASSERT_EQ(rgba[3], 1);
      });
    }
  }
}

TEST(OpaqueSurface, TheNearestOfSeveralIsSeen) {
  Shot shot = lit_by_itself("box-tetrahedra");
  shot.scene.add_surface(plate(0.7));
  const Image one = shot.picture();
  OpaqueSurface behind = plate(0.4);
  behind.color = {0, 1, 0};
  shot.scene.add_surface(behind);
  EXPECT_EQ(shot.picture().rgba, one.rgba);
  shot.scene.remove_surfaces();
  EXPECT_EQ(shot.scene.surface_triangle_count(), 0u);
  shot.scene.add_surface(behind);
  shot.scene.add_surface(plate(0.7));
  EXPECT_EQ(shot.picture().rgba, one.rgba);
}

TEST(OpaqueSurface, IsSeenInDepthAndEndsTheRaysOfOtherModes) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Shot shot = lit_by_itself(form);
    shot.scene.set_transfer_function({{{0, {0, {1, 1, 1}}}}});  // nothing but the plate
    shot.scene.add_surface(plate(0.3));
    shot.settings.mode = Mode::depth;
    shot.settings.channels = {"depth"};
    const Image depth = shot.picture();
    shot.settings.channels = {};
    shot.settings.mode = Mode::integral;
    const Image integral = shot.picture();
    shot.for_each_pixel([&](std::size_t i, bool covered) {
      if (covered)
        ASSERT_NEAR(depth.channel("depth")->values[i], 5 - 0.3, 1e-5);
      else
        ASSERT_TRUE(std::isinf(depth.channel("depth")->values[i]));
      ASSERT_EQ(depth.rgba[4 * i + 3], covered ? 1 : 0);
    });
    // x + 2 y + 3 z from z = 1 to the plate, or to z = 0.
    const PixelRays rays(shot.camera, 40, 40);
    shot.for_each_pixel([&](std::size_t i, bool covered) {
      const auto at = rays(static_cast<int>(i) % 40 + 0.5, static_cast<int>(i) / 40 + 0.5).origin;
      const double end = covered ? 0.3 : 0;
      const double expected = (at[0] + 2 * at[1]) * (1 - end) + 1.5 * (1 - end * end);
      ASSERT_NEAR(integral.channel("integral")->values[i], expected, 2e-5);
    });
  }
}

TEST(OpaqueSurface, ADepthLimitEndsRaysWhereAHostProgramHasDrawn) {
  Shot shot = lit_by_itself("box-tetrahedra");
  const double distance = 5 - 0.35;
  shot.settings.depth_limit.assign(1600, std::numeric_limits<float>::infinity());
  shot.for_each_pixel([&](std::size_t i, bool covered) {
    if (covered) shot.settings.depth_limit[i] = static_cast<float>(distance);
  });
  const Image image = shot.picture();
  shot.for_each_pixel([&](std::size_t i, bool covered) {
    ASSERT_NEAR(image.rgba[4 * i + 3], -std::expm1(-kExtinction * (covered ? 0.65 : 1)), 1e-5);
  });
  // A window sees its part of the limits.
  shot.settings.window = PixelWindow{7, 3, 20, 30};
  const Image part = shot.picture();
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 20; ++x) ASSERT_EQ(part.pixel(x, y)[3], image.pixel(x + 7, y + 3)[3]);
  shot.settings.depth_limit.pop_back();
  EXPECT_THROW(shot.picture(), Error);
}

TEST(OpaqueSurface, ColoursAndNormalsOfPointsAreInterpolated) {
  Shot shot = lit_by_itself("box-tetrahedra");
  shot.scene.set_transfer_function({{{0, {0, {1, 1, 1}}}}});
  OpaqueSurface surface = plate(0.5);
  surface.point_colors = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  surface.point_normals.assign(4, {0.6f, 0, 0.8f});
  shot.scene.add_surface(surface);
  const Image image = shot.picture();
  const PixelRays rays(shot.camera, 40, 40);
  const double highlight = 0.25 * std::pow(0.8, 30);  // the half vector is the headlight's own
  shot.for_each_pixel([&](std::size_t i, bool covered) {
    if (!covered) return;
    const auto at = rays(static_cast<int>(i) % 40 + 0.5, static_cast<int>(i) / 40 + 0.5).origin;
    const double shade = 0.2 + 0.8 * 0.8;
    ASSERT_NEAR(image.rgba[4 * i], shade * (at[0] + 1) / 1.6 + highlight, 1e-5);
    ASSERT_NEAR(image.rgba[4 * i + 1], shade * (at[1] + 1) / 3 + highlight, 1e-5);
    ASSERT_NEAR(image.rgba[4 * i + 2], highlight, 1e-5);
  });
}

TEST(OpaqueSurface, OfTheSideOfAGridIsWhereTheGridEnds) {
  for (const char* form : {"box-hexahedra", "box-rectilinear"}) {
    const Mesh mesh = generate(form, {4, 0.1, 3});
    for (int side = 0; side < 6; ++side) {
      const OpaqueSurface surface = side_of_grid(mesh, side);
      EXPECT_FALSE(surface.problem());
      EXPECT_EQ(surface.triangles.size(), 32u);
      const auto axis = static_cast<std::size_t>(side / 2);
      for (const auto& point : surface.points) EXPECT_EQ(point[axis], side % 2);
      for (const auto& normal : surface.point_normals) EXPECT_NEAR(std::abs(normal[axis]), 1, 1e-6);
    }
    EXPECT_THROW(side_of_grid(mesh, 6), Error);
  }
  EXPECT_THROW(side_of_grid(generate("box-tetrahedra", {2, 0, 1}), 0), Error);
}

TEST(OpaqueSurface, SaysWhatIsWrong) {
  Scene scene(generate("box-tetrahedra", {1, 0, 1}));
  auto refused = [&](const std::function<void(OpaqueSurface&)>& spoil, const std::string& words) {
    OpaqueSurface surface = plate(0);
    spoil(surface);
    try {
      scene.add_surface(surface);
      ADD_FAILURE() << "taken: " << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused([](auto& s) { s.points[2][1] = std::nan(""); }, "point 2");
  refused([](auto& s) { s.triangles[1][2] = 4; }, "triangle 1 of the surface has point 4");
  refused([](auto& s) { s.point_colors.resize(3); }, "3 colours for 4 points");
  refused([](auto& s) { s.point_normals.resize(5); }, "5 normals for 4 points");
  refused([](auto& s) { s.color[1] = -1; }, "colour");
  EXPECT_EQ(scene.surface_triangle_count(), 0u);
  scene.add_surface(plate(3));
  EXPECT_EQ(scene.visible_bounds().high[2], 3);
  EXPECT_EQ(scene.bounds().high[2], 1);
}

}  // namespace
}  // namespace plume::test
