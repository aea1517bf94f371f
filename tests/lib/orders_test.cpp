// Pictures of orders 2 and 3: what they gain, and that nothing but the mesh and the field counts.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/tests/reference/box_chord.h"

namespace plume::test {
namespace {

using Point = std::array<double, 3>;

template <class Map, class Function>
Mesh with(Mesh mesh, const Map& map, const Function& of) {
  std::vector<double> points, values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    const Point moved = map(point_at(mesh, p));
    points.insert(points.end(), moved.begin(), moved.end());
    values.push_back(of(point_at(mesh, p)));
  }
  mesh.points = Array::own(std::move(points));
  mesh.fields = {{"value", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "value";
  return mesh;
}

Point same(const Point& p) { return p; }
// Trilinear, with maxima along rays in any direction.
double product(const Point& p) { return p[0] * (1.1 - p[1]) * (p[2] + 0.2); }
double wave(const Point& p) { return std::sin(7 * p[0] + 2) * std::cos(5 * p[1] - 6 * p[2]); }

RenderSettings settings_of(ScalarOrder order, Mode mode = Mode::volume) {
  RenderSettings settings;
  settings.width = settings.height = 40;
  settings.order = order;
  settings.mode = mode;
  return settings;
}

constexpr ScalarOrder kHigher[] = {ScalarOrder::quadratic, ScalarOrder::cubic};

// A turn by 1 radian about (1, 2, 2) / 3, after Rodrigues.
Point turned(const Point& p) {
  const Point axis{1.0 / 3, 2.0 / 3, 2.0 / 3};
  const double c = std::cos(1.0), s = std::sin(1.0);
  const double along = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
  const Point cross{axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2],
                    axis[0] * p[1] - axis[1] * p[0]};
  Point result;
  for (std::size_t a = 0; a < 3; ++a)
    result[a] = c * p[a] + s * cross[a] + (1 - c) * along * axis[a];
  return result;
}

TEST(Orders, AMovedTurnedOrScaledMeshLooksTheSame) {
  for (const char* form :
       {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-wedges", "box-polyhedra", "twisted"})
    for (const ScalarOrder order :
         {ScalarOrder::linear, ScalarOrder::quadratic, ScalarOrder::cubic}) {
      auto picture = [&](double scale, double offset, bool turn) {
        auto map = [&](const Point& p) {
          Point q = turn ? turned(p) : p;
          for (double& x : q) x = x * scale + offset;
          return q;
        };
        const Mesh mesh = with(generate(form, {4, 0.2, 3}), map, wave);
        Scene scene(mesh);
        const float thick = static_cast<float>(1 / scale);
        scene.set_transfer_function(
            {{{-1, {thick, {1, 0, 0}}}, {0, {3 * thick, {0, 1, 1}}}, {1, {thick, {1, 1, 0}}}}});
        Camera camera = named_view("iso", {{0, 0, 0}, {1, 1, 1}});
        camera.position = map(camera.position);
        camera.focal_point = map(camera.focal_point);
        if (turn) camera.view_up = turned(camera.view_up);
        return render(scene, camera, settings_of(order)).image;
      };
      const Image plain = picture(1, 0, false);
      struct Motion {
        double scale, offset;
        bool turn;
      };
      for (const Motion& m : {Motion{1e-6, 0, false}, Motion{1e6, 0, false}, Motion{1, 1e3, false},
                              Motion{1, 0, true}, Motion{1e6, 0, true}}) {
        const Image other = picture(m.scale, m.offset, m.turn);
        for (std::size_t i = 0; i < plain.rgba.size(); ++i)
          ASSERT_NEAR(plain.rgba[i], other.rgba[i], 1e-4)
              << form << " order " << static_cast<int>(order) << ' ' << m.scale << ' ' << m.offset
              << ' ' << m.turn << ' ' << i;
      }
    }
}

Point along(const Ray& ray, double t) {
  return {ray.origin[0] + t * ray.direction[0], ray.origin[1] + t * ray.direction[1],
          ray.origin[2] + t * ray.direction[2]};
}

// The product is a cubic along a ray, for which Gauss' rule of two points is exact.
double integral_of_product(const Ray& ray, const std::array<double, 2>& span) {
  const double middle = 0.5 * (span[0] + span[1]), half = 0.5 * (span[1] - span[0]);
  double sum = 0;
  for (const double side : {-1.0, 1.0})
    sum += product(along(ray, middle + side * half / std::sqrt(3.0)));
  return sum * half;
}

TEST(Orders, IntegralsAndMaximaOfATrilinearFieldAreExactByOrderThree) {
  const Scene scene(with(generate("box-hexahedra", {2, 0, 1}), same, product));
  const Camera camera = named_view("iso", scene.bounds());
  const PixelRays rays(camera, 40, 40);
  std::array<double, 4> off_integral{}, off_maximum{};
  for (const ScalarOrder order :
       {ScalarOrder::linear, ScalarOrder::quadratic, ScalarOrder::cubic}) {
    const auto k = static_cast<std::size_t>(order);
    const Image integral = render(scene, camera, settings_of(order, Mode::integral)).image;
    const Image maximum = render(scene, camera, settings_of(order, Mode::maximum)).image;
    for (std::size_t i = 0; i < 1600; ++i) {
      const Ray ray = rays(static_cast<double>(i % 40) + 0.5, static_cast<double>(i / 40) + 0.5);
      const auto span = reference::box_span({0, 0, 0}, {1, 1, 1}, ray.origin, ray.direction);
      if (span[1] - span[0] < 1e-4) continue;
      off_integral[k] = std::max(off_integral[k], std::abs(integral.channels[0].values[i] -
                                                           integral_of_product(ray, span)));
      double greatest = 0;
      for (int step = 0; step <= 2000; ++step) {
        const double t = span[0] + (span[1] - span[0]) * step / 2000;
        greatest = std::max(greatest, product(along(ray, t)));
      }
      off_maximum[k] = std::max(off_maximum[k], std::abs(maximum.channels[0].values[i] - greatest));
    }
  }
  EXPECT_LT(off_integral[3], 1e-6);
  EXPECT_LT(off_maximum[3], 3e-6);   // of which the oracle's steps are 1e-6
  EXPECT_LT(off_integral[2], 1e-6);  // Simpson's rule is exact for cubics
  EXPECT_LT(off_maximum[2], off_maximum[1]);
  EXPECT_GT(off_integral[1], 1e-2);
  EXPECT_GT(off_maximum[1], 1e-2);
}

TEST(Orders, AFewCellsShowWhatManyDo) {
  // The same trilinear field however fine the grid.
  auto picture = [](int size, ScalarOrder order) {
    Scene scene(with(generate("box-hexahedra", {size, 0, 1}), same, product));
    scene.set_transfer_function({{{0, {0, {0, 0, 1}}},
                                  {0.2f, {6, {1, 0, 0}}},
                                  {0.3f, {1, {1, 1, 0}}},
                                  {1, {9, {1, 1, 1}}}}});
    RenderSettings settings = settings_of(order);
    settings.early_termination = 0;
    return render(scene, named_view("iso", {{0, 0, 0}, {1, 1, 1}}), settings).image;
  };
  const Image truth = picture(96, ScalarOrder::cubic);
  std::array<double, 4> worst{};
  for (const ScalarOrder order :
       {ScalarOrder::linear, ScalarOrder::quadratic, ScalarOrder::cubic}) {
    const Image coarse = picture(2, order);
    for (std::size_t i = 0; i < truth.rgba.size(); ++i)
      worst[static_cast<std::size_t>(order)] =
          std::max(worst[static_cast<std::size_t>(order)],
                   static_cast<double>(std::abs(coarse.rgba[i] - truth.rgba[i])));
  }
  EXPECT_GT(worst[1], 5e-2);
  EXPECT_LT(worst[2], worst[1] / 2);
  EXPECT_LT(worst[3], 1e-3);
}

// A cell that is opaque in its middle alone, of which its faces tell nothing.
TEST(Orders, SeeWhatIsInTheMiddleOfACell) {
  // 1 at two opposite corners, 0 at the others: along x = y, z = 1/2 the scalar is
  // (x^2 + (1 - x)^2) / 2, which is below 3/8 where |x - 1/2| < sqrt(1/8).
  auto corners = [](const Point& p) { return p[0] == p[1] && p[0] == p[2] ? 1.0 : 0.0; };
  Scene scene(with(generate("box-hexahedra", {1, 0, 1}), same, corners));
  scene.set_transfer_function({{{0, {5, {1, 1, 1}}}, {0.375f, {5, {1, 1, 1}}}, {0.375f, {0, {}}}}});
  Camera camera;
  camera.position = {-1, -1, 0.5};
  camera.focal_point = {0.5, 0.5, 0.5};
  camera.view_up = {0, 0, 1};
  RenderSettings settings = settings_of(ScalarOrder::linear, Mode::depth);
  settings.width = settings.height = 1;
  EXPECT_TRUE(std::isinf(render(scene, camera, settings).image.channels[0].values[0]));
  const double expected = (1.5 - std::sqrt(0.125)) * std::sqrt(2.0);
  for (const ScalarOrder order : kHigher) {
    settings.order = order;
    settings.mode = Mode::depth;
    // On a chord of the parabola, which is off by at most 1e-4 where the slope is 1/2.
    EXPECT_NEAR(render(scene, camera, settings).image.channels[0].values[0], expected, 2e-3);
    settings.mode = Mode::volume;
    EXPECT_NEAR(render(scene, camera, settings).image.rgba[3],
                -std::expm1(-5 * 2 * std::sqrt(0.125) * std::sqrt(2.0)), 1e-3);
  }
}

TEST(Orders, ChangeNothingWhereCellsAreLinearOrConstant) {
  const Mesh tetrahedra = generate("box-tetrahedra", {4, 0.2, 1});
  const Mesh grid = generate("box-hexahedra", {4, 0.2, 1});
  for (const auto& [mesh, field] :
       {std::pair{&tetrahedra, "radius"}, std::pair{&grid, "cell_radius"}}) {
    const Scene scene(*mesh, {{field, {}}, false});
    const Camera camera = named_view("iso", scene.bounds());
    for (const Mode mode : {Mode::volume, Mode::maximum, Mode::minimum, Mode::average,
                            Mode::integral, Mode::optical_depth, Mode::depth, Mode::cell_count}) {
      const Image linear = render(scene, camera, settings_of(ScalarOrder::linear, mode)).image;
      for (const ScalarOrder order : kHigher)
        ASSERT_EQ(render(scene, camera, settings_of(order, mode)).image.rgba, linear.rgba) << field;
    }
  }
}

TEST(Orders, AreTheSameForAnyNumberOfThreads) {
  const Scene scene(generate("box-mixed", {4, 0.2, 1}));
  const Camera camera = named_view("iso", scene.bounds());
  RenderSettings settings = settings_of(ScalarOrder::cubic);
  settings.channels = {"depth", "optical_depth", "cell_id"};
  settings.threads = 1;
  const Image one = render(scene, camera, settings).image;
  settings.threads = 2;
  const Image two = render(scene, camera, settings).image;
  EXPECT_EQ(one.rgba, two.rgba);
  // Optical depth in linear parts is the picture's own.
  for (std::size_t i = 0; i < 1600; ++i)
    ASSERT_NEAR(one.rgba[4 * i + 3], -std::expm1(-one.channels[1].values[i]), 1e-5);
}

TEST(Orders, AreSaidInThePlanAndRefusedWhereThereIsNone) {
  const Scene grid(generate("box-hexahedra", {2, 0, 1}));
  const Scene tetrahedra(generate("box-tetrahedra", {2, 0, 1}));
  const Camera camera = named_view("iso", grid.bounds());
  auto plan = [&](const Scene& scene, ScalarOrder order) {
    std::string lines;
    for (const std::string& line : render(scene, camera, settings_of(order)).statistics.plan)
      lines += line + "\n";
    return lines;
  };
  EXPECT_NE(plan(grid, ScalarOrder::linear).find("linear between"), std::string::npos);
  EXPECT_NE(plan(grid, ScalarOrder::quadratic).find("order 2: quadratic"), std::string::npos);
  EXPECT_NE(plan(grid, ScalarOrder::cubic).find("order 3: cubic"), std::string::npos);
  EXPECT_EQ(plan(tetrahedra, ScalarOrder::cubic), plan(tetrahedra, ScalarOrder::linear));
  for (const int wrong : {0, 5}) try {
      plan(grid, static_cast<ScalarOrder>(wrong));
      FAIL() << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()),
                "order " + std::to_string(wrong) +
                    ": it must be 1 (linear), 2 (quadratic), 3 (cubic) or 4 (adaptive)");
    }
}

}  // namespace
}  // namespace plume::test
