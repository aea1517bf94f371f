// Clip planes: what is cut away is not seen, and cut faces look even.

#include "plume/lib/clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/tests/reference/box_chord.h"

namespace plume::test {
namespace {

constexpr double kTau = 1.7;
const char* const kForms[] = {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear",
                              "two-blocks"};

RenderSettings exact(int size) {
  RenderSettings settings;
  settings.width = settings.height = size;
  settings.early_termination = 0;
  return settings;
}

std::array<double, 3> at(const Ray& ray, double t) {
  return {ray.origin[0] + t * ray.direction[0], ray.origin[1] + t * ray.direction[1],
          ray.origin[2] + t * ray.direction[2]};
}

bool kept(const std::array<double, 3>& p, const std::vector<ClipPlane>& planes) {
  for (const auto& [point, normal] : planes) {
    double height = 0;
    for (std::size_t a = 0; a < 3; ++a) height += normal[a] * (p[a] - point[a]);
    if (height < 0) return false;
  }
  return true;
}

TEST(Clip, KeepsOfARayWhatIsOnTheRightSideOfAllPlanes) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  auto vector = [&] { return std::array<double, 3>{any(random), any(random), any(random)}; };
  int cut = 0, gone = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<ClipPlane> planes(static_cast<std::size_t>(i % 5));
    for (ClipPlane& plane : planes) plane = {vector(), vector()};
    Ray ray{vector(), vector()};
    ray.t_min = -3;
    ray.t_max = 3;
    Ray clipped = ray;
    const bool left = clip(clipped, planes);
    gone += left ? 0 : 1;
    cut += left && clipped.t_min > -3 && clipped.t_max < 3 ? 1 : 0;
    for (int k = -300; k <= 300; ++k) {
      const double t = k / 100.0;
      const bool inside = left && clipped.t_min <= t && t <= clipped.t_max;
      if (left && (std::abs(t - clipped.t_min) < 1e-9 || std::abs(t - clipped.t_max) < 1e-9))
        continue;
      ASSERT_EQ(inside, kept(at(ray, t), planes)) << i << ' ' << t;
    }
  }
  EXPECT_GT(cut, 100);
  EXPECT_GT(gone, 100);
}

TEST(Clip, ARayAlongAPlaneIsKeptInItAndOnTheRightSide) {
  for (const double y : {-1.0, 0.0, 1.0}) {
    Ray ray{{0, y, 0}, {1, 0, 0}};
    EXPECT_EQ(clip(ray, {{{5, 0, 7}, {0, 2, 0}}}), y >= 0);
  }
}

TEST(Clip, NamesWhatIsWrong) {
  EXPECT_FALSE(problem_of({{1, 2, 3}, {0, 0, 1e-9}}));
  EXPECT_NE(problem_of({{1, 2, 3}, {0, 0, 0}})->find("0,0,0"), std::string::npos);
  EXPECT_TRUE(problem_of({{1, 2, std::nan("")}, {0, 0, 1}}));
  EXPECT_TRUE(problem_of({{1, 2, 3}, {0, HUGE_VAL, 1}}));
  Scene scene(generate("box-tetrahedra", {2, 0, 1}));
  RenderSettings settings = exact(4);
  settings.clip_planes = {{{0, 0, 0}, {0, 0, 0}}};
  EXPECT_THROW(render(scene, named_view("iso", scene.bounds()), settings), Error);
}

TEST(Clip, ABoxOfAVolumeIsSeenAsThatBox) {
  const Bounds box{{0.2, 0.31, 0.15}, {0.7, 0.88, 0.66}};
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Scene scene(generate(form, {6, 0.2, 4}));
    scene.set_transfer_function({{{0, {kTau, {0.5f, 1, 0.25f}}}}});
    RenderSettings settings = exact(64);
    settings.clip_planes = planes_of_box(box);
    const Camera camera = fitted_camera({{0, 0, 0}, {1, 1, 1}}, {-0.7, 0.4, -0.59});
    const RenderResult result = render(scene, camera, settings);
    settings.mode = Mode::integral;
    const Image integral = render(scene, camera, settings).image;
    const PixelRays rays(camera, 64, 64);
    int hit = 0;
    for (std::size_t i = 0; i < 64 * 64; ++i) {
      const Ray ray = rays(static_cast<double>(i % 64) + 0.5, static_cast<double>(i / 64) + 0.5);
      const double chord = reference::box_chord(box.low, box.high, ray.origin, ray.direction);
      ASSERT_NEAR(result.image.rgba[4 * i + 3], -std::expm1(-kTau * chord), 1e-5);
      ASSERT_EQ(integral.channels[0].values[i] > 0, chord > 0);
      hit += chord > 0 ? 1 : 0;
    }
    EXPECT_GT(hit, 300);
    EXPECT_EQ(result.statistics.lost_rays, 0u);
  }
}

// The radius about the centre, cut a little behind it: along each ray it grows from the cut on.
// Wherever the cut goes through the interval, that is seen whole.
TEST(Clip, CutFacesOfAnIntervalLookEven) {
  for (const char* form : {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear"}) {
    SCOPED_TRACE(form);
    Scene scene(generate(form, {8, 0.2, 4}), {{"radius", {}}});
    const float low = 0.3f, high = 0.6f;
    scene.set_classification({{}, {{low, high, even_profile(0.5f, {1, 1, 1})}}, {}});
    RenderSettings settings = exact(96);
    settings.clip_planes = {{{0.5, 0.56, 0.5}, {0, 3, 0}}};
    settings.channels = {"depth", "isovalue"};
    Camera camera = named_view("+y", scene.bounds());
    camera.parallel = true;
    const RenderResult result = render(scene, camera, settings);
    const PixelRays rays(camera, 96, 96);
    int on_cut = 0;
    for (std::size_t i = 0; i < 96 * 96; ++i) {
      Ray ray = rays(static_cast<double>(i % 96) + 0.5, static_cast<double>(i / 96) + 0.5);
      const double depth = result.image.channel("depth")->values[i];
      const double s = result.image.channel("isovalue")->values[i];
      if (!std::isfinite(depth)) continue;
      const auto place = at(ray, depth);
      ASSERT_TRUE(kept({place[0], place[1] + 1e-5, place[2]}, settings.clip_planes));
      clip(ray, settings.clip_planes);
      if (std::abs(depth - ray.t_min) > 1e-5 || s <= low || s >= high) continue;
      ++on_cut;
      ASSERT_NEAR(result.image.rgba[4 * i + 3], 0.5, 1e-6) << i;
    }
    EXPECT_GT(on_cut, 300);
  }
}

}  // namespace
}  // namespace plume::test
