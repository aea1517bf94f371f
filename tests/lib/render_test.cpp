// Modes, channels, cameras and what render() promises besides pictures.

#include "plume/lib/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "hwy/targets.h"
#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/tests/reference/box_chord.h"
#include "plume/traverse/frame_lanes.h"
#include "plume/traverse/packets.h"

namespace plume::test {
namespace {

const char* const kForms[] = {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear"};

// x + 2y + 3z along a ray.
double linear_at(const Ray& ray, double t) {
  double s = 0;
  for (std::size_t a = 0; a < 3; ++a)
    s += (static_cast<double>(a) + 1) * (ray.origin[a] + t * ray.direction[a]);
  return s;
}

struct Shot {
  Scene scene;
  Camera camera;
  RenderSettings settings;

  explicit Shot(const std::string& form)
      : scene(generate(form, {5, 0.2, 3}), {{"linear", {}}, true}),
        camera(fitted_camera(scene.bounds(), {-0.5, 0.4, -0.77})) {
    settings.width = 40;
    settings.height = 30;
    scene.set_transfer_function({{{0, {1, {1, 1, 1}}}, {6, {2, {1, 0, 0}}}}});
  }

  // Calls check(pixel index, ray, span) for rays that clearly hit the box or clearly miss it.
  template <class Check>
  void for_each_ray(const Check& check) const {
    const PixelRays rays(camera, settings.width, settings.height);
    for (int y = 0; y < settings.height; ++y)
      for (int x = 0; x < settings.width; ++x) {
        const Ray ray = rays(x + 0.5, y + 0.5);
        const auto span = reference::box_span({0, 0, 0}, {1, 1, 1}, ray.origin, ray.direction);
        if (std::abs(span[1] - span[0]) < 1e-4) continue;
        check(static_cast<std::size_t>(y * settings.width + x), ray, span);
      }
  }
};

TEST(Render, IntegralOfALinearFieldIsExact) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Shot shot(form);
    shot.settings.mode = Mode::integral;
    const Image image = render(shot.scene, shot.camera, shot.settings).image;
    const Channel* integral = image.channel("integral");
    ASSERT_NE(integral, nullptr);
    shot.for_each_ray([&](std::size_t i, const Ray& ray, const std::array<double, 2>& span) {
      const double length = std::max(0.0, span[1] - span[0]);
      const double expected =
          length > 0 ? 0.5 * (linear_at(ray, span[0]) + linear_at(ray, span[1])) * length : 0;
      ASSERT_NEAR(integral->values[i], expected, 1e-5) << "pixel " << i;
    });
  }
}

TEST(Render, MaximumOfALinearFieldIsAtAnEndOfTheRay) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Shot shot(form);
    shot.settings.mode = Mode::maximum;
    const Image image = render(shot.scene, shot.camera, shot.settings).image;
    const Channel* maximum = image.channel("maximum");
    ASSERT_NE(maximum, nullptr);
    shot.for_each_ray([&](std::size_t i, const Ray& ray, const std::array<double, 2>& span) {
      if (span[1] < span[0]) {
        ASSERT_TRUE(std::isnan(maximum->values[i]));
        ASSERT_EQ(image.rgba[4 * i + 3], 0);
        return;
      }
      const double expected = std::max(linear_at(ray, span[0]), linear_at(ray, span[1]));
      ASSERT_NEAR(maximum->values[i], expected, 1e-5) << "pixel " << i;
      const Optics optics = shot.scene.transfer_function().at(maximum->values[i]);
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(image.rgba[4 * i + c], optics.color[c]);
    });
  }
}

TEST(Render, MinimumAndAverageOfALinearFieldAreTheEndsOfTheRayAndTheirMean) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Shot shot(form);
    shot.settings.mode = Mode::minimum;
    const Image least = render(shot.scene, shot.camera, shot.settings).image;
    shot.settings.mode = Mode::average;
    const RenderResult average = render(shot.scene, shot.camera, shot.settings);
    float low = 1e9f, high = -1e9f;
    shot.for_each_ray([&](std::size_t i, const Ray& ray, const std::array<double, 2>& span) {
      if (span[1] < span[0]) {
        ASSERT_TRUE(std::isnan(least.channel("minimum")->values[i]));
        ASSERT_TRUE(std::isnan(average.image.channel("average")->values[i]));
        ASSERT_EQ(average.image.rgba[4 * i + 3], 0);
        return;
      }
      const double first = linear_at(ray, span[0]), last = linear_at(ray, span[1]);
      ASSERT_NEAR(least.channel("minimum")->values[i], std::min(first, last), 1e-5);
      const float value = average.image.channel("average")->values[i];
      ASSERT_NEAR(value, (first + last) / 2, 1e-5) << "pixel " << i;
      low = std::min(low, value);
      high = std::max(high, value);
      const Optics optics = shot.scene.transfer_function().at(value);
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(average.image.rgba[4 * i + c], optics.color[c]);
    });
    ASSERT_TRUE(average.statistics.values);
    EXPECT_LE((*average.statistics.values)[0], low);
    EXPECT_GE((*average.statistics.values)[1], high);
  }
}

TEST(Render, OpticalDepthAndCellCountAreTheChannelsOfThoseNames) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Shot shot(form);
    shot.settings.channels = {"optical_depth", "cell_count"};
    const Image channels = render(shot.scene, shot.camera, shot.settings).image;
    shot.settings.channels.clear();
    RenderSettings settings_by_ray = shot.settings;
    settings_by_ray.scalar_twin = true;
    for (const auto& [mode, name] :
         {std::pair{Mode::optical_depth, "optical_depth"}, {Mode::cell_count, "cell_count"}}) {
      shot.settings.mode = mode;
      const Image image = render(shot.scene, shot.camera, shot.settings).image;
      // Further channels are made ray by ray; this one by packets, in single precision.
      const float bound = mode == Mode::optical_depth ? 1e-5f : 0;
      for (std::size_t i = 0; i < image.channel(name)->values.size(); ++i)
        ASSERT_NEAR(image.channel(name)->values[i], channels.channel(name)->values[i],
                    bound * (1 + channels.channel(name)->values[i]))
            << name;
      settings_by_ray.mode = mode;
      const Image by_ray = render(shot.scene, shot.camera, settings_by_ray).image;
      EXPECT_EQ(by_ray.channel(name)->values, channels.channel(name)->values) << name;
      float greatest = 0;
      for (const float value : image.channel(name)->values) greatest = std::max(greatest, value);
      ASSERT_GT(greatest, 0);
      for (std::size_t i = 0; i < image.channel(name)->values.size(); ++i)
        ASSERT_EQ(image.rgba[4 * i], image.channel(name)->values[i] / greatest);
    }
  }
}

TEST(Render, DepthIsTheDistanceToTheFirstContribution) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Shot shot(form);
    shot.settings.mode = Mode::depth;
    const Image image = render(shot.scene, shot.camera, shot.settings).image;
    shot.for_each_ray([&](std::size_t i, const Ray&, const std::array<double, 2>& span) {
      const float depth = image.channel("depth")->values[i];
      if (span[1] < span[0])
        ASSERT_TRUE(std::isinf(depth));
      else
        ASSERT_NEAR(depth, span[0], 1e-5) << "pixel " << i;
    });
  }
}

TEST(Render, DepthIsWhereExtinctionBeginsInsideOfACell) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Shot shot(form);
    // Nothing above 3.3; below it a ramp, or a step. Along these rays the scalar falls.
    if (form[4] == 't')
      shot.scene.set_transfer_function({{{0, {2, {1, 0, 0}}}, {3.3f, {0, {1, 1, 1}}}}});
    else
      shot.scene.set_transfer_function({{{3.3f, {2, {1, 0, 0}}}, {3.3f, {0, {1, 1, 1}}}}});
    shot.settings.mode = Mode::depth;
    const Image image = render(shot.scene, shot.camera, shot.settings).image;
    int inside = 0;
    shot.for_each_ray([&](std::size_t i, const Ray& ray, const std::array<double, 2>& span) {
      const float depth = image.channel("depth")->values[i];
      if (span[1] < span[0]) return;
      const double first = linear_at(ray, span[0]), last = linear_at(ray, span[1]);
      if (last > 3.3 + 1e-4) {
        ASSERT_TRUE(std::isinf(depth));
      } else if (first > 3.3 + 1e-4 && last < 3.3 - 1e-2) {
        ++inside;
        const double expected = span[0] + (first - 3.3) / (first - last) * (span[1] - span[0]);
        ASSERT_NEAR(depth, expected, 2e-5) << "pixel " << i;
      }
    });
    EXPECT_GT(inside, 20);
  }
}

TEST(Render, ChannelsHoldWhatTheyAreNamedFor) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    Shot shot(form);
    shot.settings.channels = {"depth", "optical_depth", "cell_id", "cell_count"};
    const RenderResult result = render(shot.scene, shot.camera, shot.settings);
    const Image& image = result.image;
    double cells = 0;
    for (const float count : image.channel("cell_count")->values) cells += count;
    EXPECT_EQ(cells, static_cast<double>(result.statistics.cells_visited));
    shot.for_each_ray([&](std::size_t i, const Ray& ray, const std::array<double, 2>& span) {
      const float cell = image.channel("cell_id")->values[i];
      const float depth = image.channel("optical_depth")->values[i];
      if (span[1] < span[0]) {
        ASSERT_EQ(cell, -1);
        ASSERT_EQ(depth, 0);
        return;
      }
      // The transfer function's extinction is 1 + s / 6.
      const double mean = 1 + (linear_at(ray, span[0]) + linear_at(ray, span[1])) / 12;
      ASSERT_NEAR(depth, mean * (span[1] - span[0]), 1e-5);
      ASSERT_NEAR(image.rgba[4 * i + 3], -std::expm1(-depth), 1e-5);
      // The cell at the ray's entry, found in a different way.
      std::uint32_t first = 0xFFFFFFFFu;
      shot.scene.trace(ray, [&](const Segment& segment) {
        first = segment.cell;
        return false;
      });
      ASSERT_EQ(cell, static_cast<float>(first));
    });
  }
}

TEST(Render, ShowsTheSameForAnyNumberOfThreads) {
  for (const char* form : kForms) {
    Shot shot(form);
    shot.settings.threads = 1;
    const RenderResult one = render(shot.scene, shot.camera, shot.settings);
    shot.settings.threads = 2;
    const RenderResult two = render(shot.scene, shot.camera, shot.settings);
    EXPECT_EQ(one.image.rgba, two.image.rgba) << form;
    EXPECT_EQ(one.statistics.cells_visited, two.statistics.cells_visited) << form;
  }
}

TEST(Render, ReportsProgressAndStopsWhenAsked) {
  Shot shot("box-tetrahedra");
  shot.settings.width = shot.settings.height = 256;
  double last = 0;
  RenderResult whole = render(shot.scene, shot.camera, shot.settings, [&](double share) {
    EXPECT_GT(share, last);
    last = share;
    return true;
  });
  EXPECT_EQ(last, 1);
  EXPECT_FALSE(whole.cancelled);
  int calls = 0;
  const RenderResult stopped = render(shot.scene, shot.camera, shot.settings, [&](double) {
    ++calls;
    return false;
  });
  EXPECT_TRUE(stopped.cancelled);
  EXPECT_EQ(calls, 1);
  EXPECT_LT(stopped.statistics.cells_visited, whole.statistics.cells_visited);
}

TEST(Render, AScaledAndMovedMeshLooksTheSame) {
  const Mesh mesh = generate("box-tetrahedra", {5, 0.2, 3});
  auto picture = [&](double scale, double offset) {
    Mesh moved = mesh;
    std::vector<double> points(mesh.points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i] = mesh.points.at<double>(i) * scale + offset;
    moved.points = Array::own(std::move(points));
    const Scene scene(moved, {{"linear", {}}, false});
    RenderSettings settings;
    settings.width = settings.height = 48;
    return render(scene, named_view("iso", scene.bounds()), settings).image;
  };
  const Image plain = picture(1, 0);
  for (const auto& [scale, offset] :
       {std::pair{0x1p-30, 0.0}, {1e-6, 0.0}, {1e6, 0.0}, {1e9, 1e9}, {1.0, 1e6}}) {
    const Image other = picture(scale, offset);
    for (std::size_t i = 0; i < plain.rgba.size(); ++i)
      ASSERT_NEAR(plain.rgba[i], other.rgba[i], 1e-4) << scale << ' ' << offset << ' ' << i;
  }
}

std::string error_of(const RenderSettings& settings, Camera camera) {
  const Scene scene(generate("box-tetrahedra", {2, 0, 1}));
  try {
    render(scene, camera, settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Render, NamesTheSettingThatIsWrong) {
  const Camera camera = named_view("iso", {{0, 0, 0}, {1, 1, 1}});
  RenderSettings settings;
  settings.width = 0;
  EXPECT_EQ(error_of(settings, camera), "a picture of 0x768 pixels: each side must be 1 to 65536");
  settings = {};
  settings.channels = {"colour"};
  EXPECT_NE(error_of(settings, camera).find("no channel 'colour'; there are: depth"),
            std::string::npos);
  settings = {};
  settings.early_termination = 1;
  EXPECT_NE(error_of(settings, camera).find("early termination at 1"), std::string::npos);
  settings = {};
  settings.integrator.kind = IntegratorKind::midpoint;
  settings.integrator.samples = 0;
  EXPECT_NE(error_of(settings, camera).find("0 samples"), std::string::npos);
}

TEST(Camera, NamesWhatMakesNoPicture) {
  Camera camera;
  camera.focal_point = camera.position;
  EXPECT_NE(error_of({}, camera).find("is the focal point"), std::string::npos);
  camera = {};
  camera.view_up = {0, 0, 2};
  EXPECT_NE(error_of({}, camera).find("along the line of sight"), std::string::npos);
  camera = {};
  camera.view_angle = 180;
  EXPECT_NE(error_of({}, camera).find("a view angle of 180 degrees"), std::string::npos);
  camera = {};
  camera.parallel = true;
  camera.parallel_scale = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of({}, camera).find("a parallel scale of nan"), std::string::npos);
  camera = {};
  camera.window_center[1] = std::numeric_limits<double>::infinity();
  EXPECT_NE(error_of({}, camera).find("the window centre (0, inf)"), std::string::npos);
}

TEST(Camera, FitsTheBounds) {
  const Bounds bounds{{-1, 2, 3}, {5, 3, 4}};
  for (const std::string& view : view_names())
    for (const double aspect : {0.5, 1.0, 2.0})
      for (const bool parallel : {false, true}) {
        Camera camera = named_view(view, bounds, aspect);
        camera.parallel = parallel;
        // Every corner is seen: the ray through the picture's edge passes outside of it. Turned
        // around, the corners' places in the picture, from the camera's own axes.
        const PixelRays rays(camera, static_cast<int>(100 * aspect), 100);
        const Ray middle = rays(50 * aspect, 50);
        const Ray right = rays(100 * aspect, 50), top = rays(50 * aspect, 0);
        for (int corner = 0; corner < 8; ++corner) {
          std::array<double, 3> p;
          for (std::size_t a = 0; a < 3; ++a)
            p[a] = (corner >> a & 1) != 0 ? bounds.high[a] : bounds.low[a];
          auto inside = [&](const Ray& edge) {
            // Depth of the corner along the line of sight, and how far the edge's ray is from the
            // middle there, against the corner's own distance in that direction.
            double depth = 0, edge_depth = 0;
            for (std::size_t a = 0; a < 3; ++a) {
              depth += (p[a] - middle.origin[a]) * middle.direction[a];
              edge_depth += edge.direction[a] * middle.direction[a];
            }
            double reach = 0, along = 0;
            for (std::size_t a = 0; a < 3; ++a) {
              const double offset = edge.origin[a] + edge.direction[a] * depth / edge_depth -
                                    middle.origin[a] - middle.direction[a] * depth;
              reach += offset * offset;
              along += offset * (p[a] - middle.origin[a] - middle.direction[a] * depth);
            }
            return std::abs(along) <= reach;
          };
          EXPECT_TRUE(inside(right)) << view << ' ' << aspect << ' ' << parallel;
          EXPECT_TRUE(inside(top)) << view << ' ' << aspect << ' ' << parallel;
        }
      }
}

TEST(Camera, ShowsAPartOfALargerPictureWithItsWindowBesideTheLineOfSight) {
  for (const bool parallel : {false, true}) {
    Camera camera;
    camera.position = {2, 1, 3};
    camera.parallel = parallel;
    // The upper right quarter: half as high, its middle half of its own size off.
    Camera quarter = camera;
    quarter.view_angle =
        2 * std::atan(std::tan(camera.view_angle / 2 * M_PI / 180) / 2) * 180 / M_PI;
    quarter.parallel_scale = camera.parallel_scale / 2;
    quarter.window_center = {1, 1};
    const PixelRays whole(camera, 80, 60), part(quarter, 40, 30);
    for (const auto& [x, y] : {std::pair{0.5, 0.5}, std::pair{39.5, 29.5}, std::pair{12.0, 25.0}}) {
      const Ray expected = whole(40 + x, y), ray = part(x, y);
      for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_NEAR(ray.origin[a], expected.origin[a], 1e-12);
        EXPECT_NEAR(ray.direction[a], expected.direction[a], 1e-12);
      }
    }
  }
}

TEST(Camera, MakesSixteenRaysAsItMakesOne) {
  for (const bool parallel : {false, true}) {
    Camera camera{{1.5, -2, 0.7}, {0.1, 0.2, 0.3}, {0, 0.3, 1}};
    camera.parallel = parallel;
    camera.window_center = {0.25, -1.5};
    const PixelRays pixels(camera, 53, 37);
    std::array<double, 16> x{}, y{};
    for (std::size_t i = 0; i < 16; ++i) {
      x[i] = 3.0 * static_cast<double>(i) + 0.5;
      y[i] = static_cast<double>(i * i % 37) + 0.5;
    }
    for (std::int64_t sets = hwy::SupportedTargets(); sets != 0; sets &= sets - 1) {
      limit_packet_instruction_sets(sets & -sets);
      RayLanes rays;
      pixels.set(rays, x, y, 15);
      limit_packet_instruction_sets(0);
      ASSERT_EQ(rays.size, 15u);
      for (std::size_t i = 0; i < rays.size; ++i) {
        const Ray expected = pixels(x[i], y[i]);
        EXPECT_EQ(rays.ray(i).origin, expected.origin) << "ray " << i;
        EXPECT_EQ(rays.ray(i).direction, expected.direction) << "ray " << i;
      }
    }
  }
}

TEST(Camera, OrbitsAndZooms) {
  Camera camera;
  camera.position = {0, -5, 0};
  camera.view_up = {0, 0, 1};
  orbit(camera, 90, 0);
  EXPECT_NEAR(camera.position[0], 5, 1e-12);
  EXPECT_NEAR(camera.position[1], 0, 1e-12);
  orbit(camera, 0, 90);
  EXPECT_NEAR(camera.position[2], 5, 1e-12);
  zoom(camera, 2);
  EXPECT_EQ(camera.view_angle, 15);
  EXPECT_THROW(zoom(camera, 0), Error);
  EXPECT_THROW(named_view("up", {}), Error);
}

}  // namespace
}  // namespace plume::test
