// Scenes whose pictures are known in closed form, through every form of walkable mesh.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/tests/reference/adaptive_quadrature.h"
#include "plume/tests/reference/box_chord.h"

namespace plume::test {
namespace {

constexpr double kBound = 1e-5;  // linear RGBA, as promised
constexpr double kTau = 1.7;     // extinction per unit length
constexpr std::array<float, 3> kColor{0.9f, 0.5f, 0.2f};

const std::vector<std::string> kForms{"box-tetrahedra", "box-hexahedra",   "box-mixed",
                                      "box-polyhedra",  "box-rectilinear", "box-wedges",
                                      "two-blocks"};

TransferFunction uniform() { return {{{0, {kTau, kColor}}}}; }

RenderSettings exact(int width, int height) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.early_termination = 0;
  return settings;
}

Camera askew(const Bounds& bounds) {
  Camera camera = fitted_camera(bounds, {-0.7, 0.4, -0.59});
  camera.view_angle = 35;
  return camera;
}

// The largest difference of a channel between the picture and `expected(ray)`, over the pixels that
// `counts` accepts.
double worst(const RenderResult& result, const Camera& camera,
             const std::function<std::array<double, 4>(const Ray&)>& expected,
             const std::function<bool(const Ray&)>& counts = {}) {
  const Image& image = result.image;
  const PixelRays rays(camera, image.width, image.height);
  double error = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Ray ray = rays(x + 0.5, y + 0.5);
      if (counts && !counts(ray)) continue;
      const auto wanted = expected(ray);
      for (std::size_t c = 0; c < 4; ++c)
        error = std::max(error, std::abs(image.pixel(x, y)[c] - wanted[c]));
    }
  return error;
}

std::array<double, 4> uniform_color(double length) {
  const double alpha = -std::expm1(-kTau * length);
  return {alpha * kColor[0], alpha * kColor[1], alpha * kColor[2], alpha};
}

TEST(ClosedFormScenes, SlabSeenAlongItsNormal) {
  for (const std::string& form : kForms) {
    SCOPED_TRACE(form);
    Scene scene(generate(form, {6, 0.2, 4}));
    scene.set_transfer_function(uniform());
    Camera camera = named_view("-z", scene.bounds());
    camera.parallel = true;
    camera.parallel_scale = 0.45;  // well inside of the slab's edges
    const RenderResult result = render(scene, camera, exact(64, 64));
    const double thickness = scene.bounds().high[2] - scene.bounds().low[2];
    EXPECT_LE(worst(result, camera, [&](const Ray&) { return uniform_color(thickness); }), kBound);
    EXPECT_EQ(result.statistics.rays_hit, result.statistics.rays);
    EXPECT_EQ(result.statistics.lost_rays, 0u);
  }
}

TEST(ClosedFormScenes, BoxSeenAskew) {
  for (const std::string& form : kForms) {
    SCOPED_TRACE(form);
    Scene scene(generate(form, {6, 0.2, 4}));
    scene.set_transfer_function(uniform());
    const Camera camera = askew(scene.bounds());
    const RenderResult result = render(scene, camera, exact(96, 96));
    const Bounds& box = scene.bounds();
    EXPECT_LE(worst(result, camera,
                    [&](const Ray& ray) {
                      return uniform_color(
                          reference::box_chord(box.low, box.high, ray.origin, ray.direction));
                    }),
              kBound);
  }
}

// The scalar x + 2y + 3z and an extinction that is linear in it: along a ray both are linear, and
// the optical depth is their mean times the length.
TEST(ClosedFormScenes, RampOfExtinction) {
  for (const std::string& form : kForms) {
    SCOPED_TRACE(form);
    Scene scene(generate(form, {6, 0.2, 4}), {{"linear", {}}});
    const float high = scene.field().high, low = scene.field().low;
    TransferFunction ramp;
    ramp.knots = {{low, {0, kColor}}, {high, {3, kColor}}};
    scene.set_transfer_function(ramp);
    const Camera camera = askew(scene.bounds());
    const RenderResult result = render(scene, camera, exact(96, 96));
    const Bounds& box = scene.bounds();
    EXPECT_LE(
        worst(result, camera,
              [&](const Ray& ray) {
                const auto span = reference::box_span(box.low, box.high, ray.origin, ray.direction);
                auto extinction = [&](double t) {
                  double s = 0;
                  for (std::size_t a = 0; a < 3; ++a)
                    s += (static_cast<double>(a) + 1) * (ray.origin[a] + t * ray.direction[a]);
                  return 3 * (s - low) / (high - low);
                };
                const double length = std::max(0.0, span[1] - span[0]);
                const double depth =
                    length > 0 ? 0.5 * (extinction(span[0]) + extinction(span[1])) * length : 0;
                const double alpha = -std::expm1(-depth);
                return std::array<double, 4>{alpha * kColor[0], alpha * kColor[1],
                                             alpha * kColor[2], alpha};
              }),
        kBound);
  }
}

// A transfer function with knots inside, colour and extinction both varying, against quadrature in
// double along the whole ray.
TEST(ClosedFormScenes, RampThroughKnots) {
  for (const std::string& form : kForms) {
    SCOPED_TRACE(form);
    Scene scene(generate(form, {5, 0.2, 4}), {{"linear", {}}});
    TransferFunction bumpy;
    bumpy.knots = {{0, {0, {0, 0, 1}}},      {1.5f, {0.2f, {0, 1, 0}}}, {2, {9, {1, 1, 0}}},
                   {2.1f, {0, {1, 0, 0}}},   {4, {1, {1, 1, 1}}},       {4, {5, {0.2f, 0, 0.4f}}},
                   {6, {0.1f, {0, 0.5f, 1}}}};
    scene.set_transfer_function(bumpy);
    const Camera camera = askew(scene.bounds());
    const RenderResult result = render(scene, camera, exact(32, 32));
    const Bounds& box = scene.bounds();
    EXPECT_LE(
        worst(result, camera,
              [&](const Ray& ray) {
                const auto span = reference::box_span(box.low, box.high, ray.origin, ray.direction);
                if (!(span[1] > span[0])) return std::array<double, 4>{0, 0, 0, 0};
                auto scalar = [&](double t) {
                  double s = 0;
                  for (std::size_t a = 0; a < 3; ++a)
                    s += (static_cast<double>(a) + 1) * (ray.origin[a] + t * ray.direction[a]);
                  return static_cast<float>(s);
                };
                const auto c = reference::integrate_linear(bumpy, scalar(span[0]), scalar(span[1]),
                                                           span[1] - span[0], 1e-9);
                return std::array<double, 4>{c.rgb[0], c.rgb[1], c.rgb[2], c.alpha};
              }),
        kBound);
  }
}

// A ball of constant extinction, its surface made of triangles: the error is the geometry's and
// falls with the square of the cells' size.
TEST(ClosedFormScenes, BallConvergesAtSecondOrder) {
  auto rms_error = [](int size) {
    Scene scene(generate("ball-tetrahedra", {size, 0, 1}));
    scene.set_transfer_function(uniform());
    Camera camera = named_view("+x", Bounds{{-1, -1, -1}, {1, 1, 1}});
    camera.parallel = true;
    camera.parallel_scale = 1;
    const RenderResult result = render(scene, camera, exact(128, 128));
    const PixelRays rays(camera, 128, 128);
    double sum = 0;
    int count = 0;
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 128; ++x) {
        const Ray ray = rays(x + 0.5, y + 0.5);
        const double r2 = ray.origin[1] * ray.origin[1] + ray.origin[2] * ray.origin[2];
        if (r2 > 0.8 * 0.8) continue;  // at the rim the chord's derivative is infinite
        const double alpha = -std::expm1(-kTau * 2 * std::sqrt(1 - r2));
        const double error = result.image.pixel(x, y)[3] - alpha;
        sum += error * error;
        ++count;
      }
    return std::sqrt(sum / count);
  };
  const double coarse = rms_error(8), middle = rms_error(16), fine = rms_error(32);
  EXPECT_LT(coarse, 0.03);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.3);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.3);
}

TEST(Camera, InsideOfTheMeshSeesWhatLiesAhead) {
  for (const std::string& form : kForms) {
    SCOPED_TRACE(form);
    Scene scene(generate(form, {6, 0.2, 4}));
    scene.set_transfer_function(uniform());
    Camera camera;
    const auto center = scene.bounds().center();
    camera.position = {center[0] + 0.11, center[1] - 0.07, center[2] + 0.13};
    camera.focal_point = {center[0] + 1, center[1] + 0.2, center[2] - 0.3};
    camera.view_angle = 90;
    const RenderResult result = render(scene, camera, exact(64, 64));
    const Bounds& box = scene.bounds();
    EXPECT_LE(worst(result, camera,
                    [&](const Ray& ray) {
                      const auto span =
                          reference::box_span(box.low, box.high, ray.origin, ray.direction);
                      return uniform_color(span[1]);
                    }),
              kBound);
  }
}

}  // namespace
}  // namespace plume::test
