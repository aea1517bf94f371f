// Meshes that are in one place, beside quadrature of the sum of their optics, and formulas.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/tests/lib/several_scenes.h"
#include "plume/tests/reference/adaptive_quadrature.h"
#include "plume/tests/reference/box_chord.h"

namespace plume::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Boxes of analytic fields, for the oracle.
struct Box {
  std::string form;
  double scale;
  Point at;
  double (*field)(const Point&);
  TransferFunction look;
};

double falling(const Point& p) { return 4 - 2 * p[0] + p[1] - p[2]; }
double slanted(const Point& p) { return 2 + p[0] - p[1]; }

std::vector<Box> boxes() {
  return {
      {"box-tetrahedra", 1, {0, 0, 0}, linear, *volume_alone().volume},
      {"box-mixed",
       0.8,
       {0.5, 0.3, 0.2},
       falling,
       {{{1, {0, {1, 1, 0}}}, {3, {3, {0, 1, 1}}}, {5, {0.5f, {1, 0, 1}}}}}},
      {"box-rectilinear",
       0.5,
       {0.6, 0.4, 0.5},
       slanted,
       {{{1, {2, {0, 0, 0}}}, {2, {0.1f, {1, 1, 1}}}, {2, {3, {0, 1, 0}}}, {4, {1, {1, 0, 0}}}}}}};
}

Mesh made(const Box& box) {
  const Mesh mesh = generate(box.form, {5, 0.2, 7});
  if (!mesh.is_rectilinear()) return with(moved(mesh, box.scale, box.at), box.field);
  Mesh grid = mesh;
  for (std::size_t a = 0; a < 3; ++a) {
    std::vector<double> axis;
    for (std::size_t i = 0; i < mesh.axes[a].size(); ++i)
      axis.push_back(box.scale * mesh.axes[a].at<double>(i) + box.at[a]);
    grid.axes[a] = Array::own(std::move(axis));
  }
  return with(grid, box.field);
}

Scenes scenes_of(const std::vector<Box>& list) {
  Scenes scenes;
  for (const Box& box : list) {
    SceneOptions options;
    options.name = box.form;
    Classification look;
    look.volume = box.look;
    scenes.add(made(box), options, look);
  }
  return scenes;
}

// Extinction and extinction times colour at a scalar, in double: rounded to a float, scalars beside
// a step would be on either side of it.
std::array<double, 4> optics_at(const TransferFunction& look, double scalar) {
  const auto& knots = look.knots;
  std::size_t above = 0;
  while (above < knots.size() && knots[above].scalar <= scalar) ++above;
  const auto& a = knots[above == 0 ? 0 : above - 1];
  const auto& b = knots[above == knots.size() ? above - 1 : above];
  const double width = static_cast<double>(b.scalar) - a.scalar;
  const double share = width > 0 ? (scalar - a.scalar) / width : 0;
  auto mix = [&](double from, double to) { return from + share * (to - from); };
  std::array<double, 4> optics{mix(a.optics.extinction, b.optics.extinction)};
  for (std::size_t c = 0; c < 3; ++c)
    optics[c + 1] = optics[0] * mix(a.optics.color[c], b.optics.color[c]);
  return optics;
}

struct Part {
  const Box* box;
  double from, to;
};

// What the boxes that are on parts of a ray look like, all at once, by quadrature of the sum.
reference::Radiance seen(const std::vector<Part>& parts, const Ray& ray, double from, double to) {
  auto place = [&](double t) {
    Point p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = ray.origin[a] + (from + t) * ray.direction[a];
    return p;
  };
  reference::Medium medium;
  medium.length = to - from;
  auto sum_at = [&](double t) {
    std::array<double, 4> sum{};
    for (const Part& part : parts) {
      if (!(from + t > part.from && from + t < part.to)) continue;
      const auto optics = optics_at(part.box->look, part.box->field(place(t)));
      for (std::size_t i = 0; i < 4; ++i) sum[i] += optics[i];
    }
    return sum;
  };
  medium.extinction = [&](double t) { return sum_at(t)[0]; };
  medium.color = [&](double t) {
    const auto sum = sum_at(t);
    std::array<double, 3> color{0, 0, 0};
    for (std::size_t c = 0; c < 3; ++c) color[c] = sum[0] > 0 ? sum[c + 1] / sum[0] : 0;
    return color;
  };
  for (const Part& part : parts) {
    medium.break_points.push_back(part.from - from);
    medium.break_points.push_back(part.to - from);
    const double first = part.box->field(place(0)), slope = part.box->field(place(1)) - first;
    for (const auto& knot : part.box->look.knots)
      medium.break_points.push_back((knot.scalar - first) / slope);
  }
  std::erase_if(medium.break_points,
                [&](double t) { return !(t > 0 && t < medium.length) || !std::isfinite(t); });
  return reference::integrate(medium, 1e-7);
}

// `hidden(part, parts before it)` may shorten what is seen of a box.
template <class Settle>
void expect_as_the_oracle(const std::vector<Box>& list, const Image& image, const Camera& camera,
                          const Settle& settle) {
  const PixelRays rays(camera, image.width, image.height);
  int compared = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Ray ray = rays(x + 0.5, y + 0.5);
      std::vector<Part> parts;
      double from = kInfinity, to = -kInfinity;
      for (const Box& box : list) {
        Point high = box.at;
        for (double& h : high) h += box.scale;
        const auto span = reference::box_span(box.at, high, ray.origin, ray.direction);
        if (!(span[1] - span[0] > 0)) continue;
        settle(parts, Part{&box, span[0], span[1]});
        from = std::min(from, span[0]);
        to = std::max(to, span[1]);
      }
      if (parts.size() < 2) continue;
      const auto expected = seen(parts, ray, from, to);
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(image.pixel(x, y)[c], expected.rgb[c], kBound) << x << ' ' << y;
      ASSERT_NEAR(image.pixel(x, y)[3], expected.alpha, kBound) << x << ' ' << y;
      ++compared;
    }
  EXPECT_GT(compared, 200);
}

TEST(SeveralScenes, WhereTheyOverlapExtinctionAndEmissionAddUp) {
  const std::vector<Box> list = boxes();
  const Scenes scenes = scenes_of(list);
  const Camera camera = askew(visible_bounds(scenes.pointers()));
  const RenderResult result = render(scenes.pointers(), camera, exact(32));
  EXPECT_GT(result.statistics.rays_overlapping, 100u);
  expect_as_the_oracle(list, result.image, camera,
                       [](std::vector<Part>& parts, const Part& part) { parts.push_back(part); });
}

TEST(SeveralScenes, OfWhichTheFirstCountsHideTheOthersWhereItIs) {
  const std::vector<Box> all = boxes();
  const std::vector<Box> list{all[1], all[0]};
  const Scenes scenes = scenes_of(list);
  const Camera camera = askew(visible_bounds(scenes.pointers()));
  RenderSettings settings = exact(40);
  settings.overlap = Overlap::first;
  const RenderResult result = render(scenes.pointers(), camera, settings);
  // A box leaves at most one piece before the other and one behind.
  auto settle = [](std::vector<Part>& parts, const Part& part) {
    if (parts.empty()) return parts.push_back(part);
    const Part first = parts.front();
    const Part before{part.box, part.from, std::min(part.to, first.from)};
    const Part behind{part.box, std::max(part.from, first.to), part.to};
    if (before.to > before.from) parts.push_back(before);
    if (behind.to > behind.from) parts.push_back(behind);
  };
  expect_as_the_oracle(list, result.image, camera, settle);
}

TEST(SeveralScenes, LookTheSameInAnyOrder) {
  for (const bool opaque : {false, true}) {
    std::vector<Box> list = boxes();
    if (opaque)
      for (Box& box : list)
        for (auto& knot : box.look.knots) knot.optics.extinction *= 20;
    const Scenes scenes = scenes_of(list);
    const Camera camera = askew(visible_bounds(scenes.pointers()));
    RenderSettings settings = exact(48);
    for (const double early : {0.0, 1e-3}) {
      settings.early_termination = early;
      auto order = scenes.pointers();
      std::sort(order.begin(), order.end());
      const Image image = render(order, camera, settings).image;
      while (std::next_permutation(order.begin(), order.end()))
        EXPECT_EQ(render(order, camera, settings).image.rgba, image.rgba);
    }
  }
}

TEST(SeveralScenes, EachOfHalfTheExtinctionAreTheOneOfAllOfIt) {
  for (const char* form : kForms) {
    SCOPED_TRACE(form);
    const Mesh mesh = with(generate(form, {4, 0.2, 3}), wavy);
    Scene whole(mesh);
    whole.set_classification(volume_alone());
    Classification half = volume_alone();
    for (auto& knot : half.volume->knots) knot.optics.extinction /= 2;
    Scenes twice;
    twice.add(mesh, {}, half);
    twice.add(mesh, {}, half);
    const Camera camera = askew(whole.bounds());
    EXPECT_LE(worst_difference(render(whole, camera, exact(40)).image,
                               render(twice.pointers(), camera, exact(40)).image),
              2e-6);
    RenderSettings first = exact(40);
    first.overlap = Overlap::first;
    EXPECT_LE(worst_difference(render(twice.all[0], camera, exact(40)).image,
                               render(twice.pointers(), camera, first).image),
              2e-6);
  }
}

TEST(SeveralScenes, OfConstantFieldsAreWhatAFormulaSays) {
  auto box = [](double x) {
    return with(moved(generate("box-tetrahedra", {3, 0.2, 3}), 1, {x, 0, 0}),
                [](const Point&) { return 1.0; });
  };
  Classification red, blue;
  red.volume = TransferFunction{{{0, {2, {1, 0, 0}}}}};
  blue.volume = TransferFunction{{{0, {3, {0, 0, 1}}}}};
  Scenes scenes;
  scenes.add(box(0), {}, red);
  scenes.add(box(0.5), {}, blue);
  Camera camera;
  camera.position = {-3, 0.43, 0.52};
  camera.focal_point = {0.5, 0.43, 0.52};
  camera.parallel = true;
  camera.parallel_scale = 0.2;
  RenderSettings settings = exact(16);
  settings.channels = {"depth", "optical_depth"};
  const Image image = render(scenes.pointers(), camera, settings).image;
  const double before = std::exp(-1.0), both = std::exp(-2.5);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      ASSERT_NEAR(image.pixel(x, y)[0], 1 - before + before * 0.4 * (1 - both), 1e-6);
      ASSERT_NEAR(image.pixel(x, y)[2],
                  before * 0.6 * (1 - both) + before * both * (1 - std::exp(-1.5)), 1e-6);
      ASSERT_NEAR(image.pixel(x, y)[3], 1 - std::exp(-5.0), 1e-6);
      ASSERT_NEAR(image.channels[0].values[0], 3, 1e-6);
      ASSERT_NEAR(image.channels[1].values[0], 5, 1e-5);
    }
}

TEST(SeveralScenes, EndEarlyWithinTheBound) {
  std::vector<Box> list = boxes();
  for (Box& box : list)
    for (auto& knot : box.look.knots) knot.optics.extinction *= 10;
  const Scenes scenes = scenes_of(list);
  const Camera camera = askew(visible_bounds(scenes.pointers()));
  const RenderResult all = render(scenes.pointers(), camera, exact(40));
  RenderSettings settings = exact(40);
  settings.early_termination = 1e-2;
  const RenderResult early = render(scenes.pointers(), camera, settings);
  EXPECT_LT(early.statistics.cells_visited, all.statistics.cells_visited * 3 / 4);
  const double off = worst_difference(all.image, early.image);
  EXPECT_LE(off, 1e-2 + kBound);
  EXPECT_GT(off, 0);
}

}  // namespace
}  // namespace plume::test
