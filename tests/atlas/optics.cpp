#include "optics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/preint/compositing.h"
#include "plume/tests/reference/adaptive_quadrature.h"
#include "plume/tests/reference/box_chord.h"

namespace plume::atlas {
namespace {

constexpr int kSize = 24;
using Pixel = std::array<double, 4>;

struct Function {
  const char* name;
  TransferFunction function;
  /// The largest error that is promised of the closed form (closed_form_scenes_test.cpp).
  double promised = 1e-5;
  /// The same of packets, whose scalars are in single precision.
  double promised_of_packets = 1e-5;
};

// Over the scalars 0 to 6 of the field "linear", in a unit cube.
std::vector<Function> functions() {
  return {
      {"eight knots (the control)",
       {{{0, {0, {0, 0, 1}}},
         {1, {0.5f, {0, 1, 1}}},
         {2, {2, {0, 1, 0}}},
         {2.5f, {1, {1, 1, 0}}},
         {3.5f, {3, {1, 0, 0}}},
         {4, {0.2f, {1, 0, 1}}},
         {5, {4, {1, 1, 1}}},
         {6, {1, {0.2f, 0.2f, 0.2f}}}}}},
      {"a step",
       {{{0, {0, {1, 0, 0}}}, {3, {0, {1, 0, 0}}}, {3, {20, {0, 1, 0}}}, {6, {20, {0, 0, 1}}}}}},
      {"a spike, 1/20 of a table's entry",
       {{{0, {0.1f, {0, 0, 1}}},
         {3.1f, {0.1f, {0, 0, 1}}},
         {3.101f, {4000, {1, 0.5f, 0}}},
         {3.102f, {0.1f, {0, 0, 1}}},
         {6, {0.1f, {0, 0, 1}}}}},
       1e-5,
       // A scalar of 3 is rounded to 2.4e-7; the ray passes that in a quarter of it, and the
       // extinction is 4000.
       2.4e-4},
      {"an optical depth of 1e6",
       {{{0, {0, {1, 0, 0}}},
         {2, {0, {1, 1, 0}}},
         {2, {1e6f, {0, 1, 0}}},
         {4, {1e6f, {0, 0, 1}}},
         {6, {0, {1, 1, 1}}}}}},
  };
}

double scalar_on(const Ray& ray, double t) {
  double s = 0;
  for (std::size_t a = 0; a < 3; ++a)
    s += (static_cast<double>(a) + 1) * (ray.origin[a] + t * ray.direction[a]);
  return s;
}

// Largest difference, or NaN where a pixel is that.
class Worst {
 public:
  void take(const float* rgba, const Pixel& wanted) {
    for (std::size_t c = 0; c < 4; ++c) {
      const double difference = std::abs(static_cast<double>(rgba[c]) - wanted[c]);
      if (std::isnan(difference))
        error_ = difference;
      else if (!std::isnan(error_))
        error_ = std::max(error_, difference);
    }
  }
  double error() const { return error_; }

 private:
  double error_ = 0;
};

RenderSettings settings_of(IntegratorKind kind, bool scalar) {
  RenderSettings settings;
  settings.width = settings.height = kSize;
  settings.early_termination = 0;
  settings.integrator.kind = kind;
  settings.scalar_twin = scalar;
  return settings;
}

// The textbook's ray marching: 200 samples a diagonal, each for its step.
Pixel marched(const TransferFunction& function, double from, double to, double step,
              const std::function<double(double)>& scalar) {
  Pixel rgba{0, 0, 0, 0};
  double left = 1;
  for (double t = from + 0.5 * step; t < to; t += step) {
    const Optics optics = function.at(static_cast<float>(scalar(t)));
    const double alpha = 1 - std::exp(-static_cast<double>(optics.extinction) * step);
    for (std::size_t c = 0; c < 3; ++c)
      rgba[c] += left * alpha * static_cast<double>(optics.color[c]);
    left *= 1 - alpha;
  }
  rgba[3] = 1 - left;
  return rgba;
}

Camera askew(const Bounds& bounds) {
  Camera camera = fitted_camera(bounds, {-0.7, 0.4, -0.59});
  camera.view_angle = 35;
  return camera;
}

template <class Visit>
void for_each_pixel(const Camera& camera, const Visit& visit) {
  const PixelRays rays(camera, kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) visit(rays(x + 0.5, y + 0.5), x, y);
}

// 1e-7 and less is single precision: not to be told apart on a page.
std::string shown(double error) {
  if (std::isnan(error)) return "not a number";
  if (error < 1e-5)
    return fmt::format("below 1e{}",
                       static_cast<int>(std::ceil(std::log10(std::max(error, 1e-7)))));
  return fmt::format("{:.1g}", error);
}

}  // namespace

std::vector<OpticsRow> run_transfer_functions() {
  struct Way {
    const char* name;
    RenderSettings settings;
    bool promises;
  };
  const std::vector<Way> ways{
      {"midpoint of each segment", settings_of(IntegratorKind::midpoint, true), false},
      {"pre-integrated table", settings_of(IntegratorKind::table, true), false},
      {"closed form", settings_of(IntegratorKind::closed_form, true), true},
      {"closed form, packets", settings_of(IntegratorKind::closed_form, false), true},
      {"adaptive reference", settings_of(IntegratorKind::reference, true), true}};
  std::vector<Scene> scenes;
  for (const char* form : {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-rectilinear"})
    scenes.emplace_back(generate(form, {6, 0.2, 4}), SceneOptions{{"linear", {}}});
  const Bounds box = scenes[0].bounds();
  const Camera camera = askew(box);

  std::vector<OpticsRow> rows;
  for (const Function& function : functions()) {
    std::vector<Pixel> truth;
    Worst steps;
    for_each_pixel(camera, [&](const Ray& ray, int, int) {
      Pixel& wanted = truth.emplace_back(Pixel{0, 0, 0, 0});
      const auto span = reference::box_span(box.low, box.high, ray.origin, ray.direction);
      if (!(span[1] > span[0])) return;
      const auto c = reference::integrate_linear(function.function, scalar_on(ray, span[0]),
                                                 scalar_on(ray, span[1]), span[1] - span[0], 1e-9);
      wanted = {c.rgb[0], c.rgb[1], c.rgb[2], c.alpha};
      const Pixel march = marched(function.function, span[0], span[1], box.diagonal() / 200,
                                  [&](double t) { return scalar_on(ray, t); });
      float rgba[4];
      for (std::size_t i = 0; i < 4; ++i) rgba[i] = static_cast<float>(march[i]);
      steps.take(rgba, wanted);
    });
    rows.push_back({function.name, "four", "fixed steps", false, 0, steps.error()});
    for (const Way& way : ways) {
      Worst worst;
      for (Scene& scene : scenes) {
        scene.set_transfer_function(function.function);
        const Image image = render(scene, camera, way.settings).image;
        for_each_pixel(camera, [&](const Ray&, int x, int y) {
          worst.take(image.pixel(x, y), truth[static_cast<std::size_t>(y * kSize + x)]);
        });
      }
      rows.push_back(
          {function.name, "four", way.name, way.promises, function.promised, worst.error()});
    }
  }
  return rows;
}

std::vector<OpticsRow> run_turning_points() {
  // Values at the corners of one cell such that the scalar goes up, down and up along the diagonal
  // from corner 0 to corner 7: a Bernstein polynomial of coefficients 0, 2, -1, 1.
  Mesh mesh = generate("box-rectilinear", {1, 0, 1});
  const std::array<float, 4> by_distance{0, 2, -1, 1};
  std::vector<float> values;
  for (std::size_t p = 0; p < 8; ++p)
    values.push_back(by_distance[(p & 1) + (p >> 1 & 1) + (p >> 2 & 1)]);
  mesh.fields = {{"turning", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "turning";
  Scene scene(mesh);
  TransferFunction function;
  function.knots = {{-1, {0, {0, 0, 1}}},
                    {0.3f, {1, {0, 1, 0}}},
                    {0.45f, {9, {1, 1, 0}}},
                    {0.6f, {2, {1, 0, 0}}},
                    {2, {5, {1, 1, 1}}}};
  scene.set_transfer_function(function);
  Camera camera = fitted_camera(scene.bounds(), {1, 1, 1});
  camera.parallel = true;
  camera.parallel_scale = 0.3;

  auto scalar = [&](const Ray& ray, double t) {
    std::array<double, 3> p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = ray.origin[a] + t * ray.direction[a];
    double s = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      double weight = 1;
      for (std::size_t a = 0; a < 3; ++a) weight *= (c >> a & 1) != 0 ? p[a] : 1 - p[a];
      s += weight * static_cast<double>(by_distance[(c & 1) + (c >> 1 & 1) + (c >> 2 & 1)]);
    }
    return s;
  };
  std::vector<Pixel> truth;
  for_each_pixel(camera, [&](const Ray& ray, int, int) {
    const auto span =
        reference::box_span(scene.bounds().low, scene.bounds().high, ray.origin, ray.direction);
    Pixel& wanted = truth.emplace_back(Pixel{0, 0, 0, 0});
    if (!(span[1] > span[0])) return;
    reference::Medium medium;
    medium.length = span[1] - span[0];
    auto at = [&, ray, span](double t) { return scalar(ray, span[0] + t); };
    medium.extinction = [&, at](double t) {
      return static_cast<double>(function.at(static_cast<float>(at(t))).extinction);
    };
    medium.color = [&, at](double t) {
      const auto& c = function.at(static_cast<float>(at(t))).color;
      return std::array<double, 3>{static_cast<double>(c[0]), static_cast<double>(c[1]),
                                   static_cast<double>(c[2])};
    };
    // Where the scalar passes through a knot: found by bisection between a thousand places.
    for (const auto& knot : function.knots)
      for (int i = 0; i < 1000; ++i) {
        double low = medium.length * i / 1000, high = medium.length * (i + 1) / 1000;
        auto above = [&](double t) { return at(t) >= static_cast<double>(knot.scalar); };
        if (above(low) == above(high)) continue;
        const bool rises = above(high);
        for (int step = 0; step < 60; ++step) {
          const double middle = 0.5 * (low + high);
          (above(middle) == rises ? high : low) = middle;
        }
        medium.break_points.push_back(low);
      }
    const auto c = reference::integrate(medium, 1e-6);
    wanted = {c.rgb[0], c.rgb[1], c.rgb[2], c.alpha};
  });

  std::vector<OpticsRow> rows;
  struct Way {
    const char* name;
    IntegratorKind kind;
    ScalarOrder order;
    /// Nothing where the scalar is not followed.
    std::optional<double> promised;
  };
  // Linear parts are within 1e-4 of the field's range of 3; extinction changes by 53 a unit of
  // scalar at the most, over a length of 1.7. The reference takes the cubic as it is.
  for (const Way& way :
       {Way{"closed form, order 1", IntegratorKind::closed_form, ScalarOrder::linear, {}},
        Way{"closed form, order 2", IntegratorKind::closed_form, ScalarOrder::quadratic, {}},
        Way{"closed form, order 3", IntegratorKind::closed_form, ScalarOrder::cubic, 3e-3},
        Way{"table of second order, order 3",
            IntegratorKind::second_order_table,
            ScalarOrder::cubic,
            {}},
        Way{"adaptive reference, order 3", IntegratorKind::reference, ScalarOrder::cubic, 1e-5}}) {
    RenderSettings settings = settings_of(way.kind, true);
    settings.order = way.order;
    const Image image = render(scene, camera, settings).image;
    Worst worst;
    for_each_pixel(camera, [&](const Ray&, int x, int y) {
      worst.take(image.pixel(x, y), truth[static_cast<std::size_t>(y * kSize + x)]);
    });
    rows.push_back({"two turning points in one cell", "one cell", way.name,
                    way.promised.has_value(), way.promised.value_or(0), worst.error()});
  }
  return rows;
}

std::string optics_table(const std::vector<OpticsRow>& rows) {
  std::string table = "| scene | method | largest error of a pixel |\n|---|---|---|\n";
  std::string scene;
  for (const OpticsRow& row : rows) {
    table += fmt::format("| {} | {} | {} |\n", row.scene == scene ? "" : row.scene, row.method,
                         shown(row.error));
    scene = row.scene;
  }
  return table;
}

std::vector<std::string> problems_of(const std::vector<OpticsRow>& rows) {
  std::vector<std::string> problems;
  bool old_fails = false;
  for (const OpticsRow& row : rows) {
    if (row.ours && !(row.error <= row.promised))
      problems.push_back(fmt::format("{}, {}: off by {:g}, promised {:g}", row.scene, row.method,
                                     row.error, row.promised));
    old_fails = old_fails || (!row.ours && !(row.error < 0.1));
  }
  if (!old_fails) problems.push_back("no other integrator is off by more than 0.1");
  return problems;
}

}  // namespace plume::atlas
