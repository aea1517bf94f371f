#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "plume/preint/adaptive_integrator.h"
#include "plume/preint/compositing.h"
#include "plume/preint/preintegrated_table.h"
#include "plume/preint/second_order_table.h"
#include "plume/tests/bench/integrator_errors.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/timing.h"
#include "plume/tests/bench/trilinear_field.h"
#include "plume/tests/preint/transfer_functions.h"

namespace plume::bench {
namespace {

constexpr int kSize = 64;

// Two waves of ten and fourteen voxels across each other, in [0.01, 0.99].
double smooth_field(const std::array<double, 3>& p) {
  const double r = std::hypot(p[0] - 31.5, p[1] - 28.0, p[2] - 35.0);
  const double q = std::hypot(p[0] - 20.0, p[1] - 40.0, p[2] - 30.0);
  return 0.5 + 0.25 * std::sin(0.63 * r) + 0.24 * std::cos(0.45 * q + 0.1 * p[2]);
}

constexpr double kRayLength = 32;  // voxels

// Rays of that length around the middle of the field.
std::vector<FieldRay> rays(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<FieldRay> list;
  for (int i = 0; i < count; ++i) {
    FieldRay ray;
    double length = 0;
    for (double& x : ray.direction) x = normal(random);
    for (const double x : ray.direction) length += x * x;
    for (std::size_t a = 0; a < 3; ++a) {
      ray.direction[a] /= std::sqrt(length);
      ray.origin[a] = 31.5 + 4 * normal(random) - kRayLength / 2 * ray.direction[a];
      ray.origin[a] = std::clamp(ray.origin[a], 15.0, 48.0);
    }
    ray.length = kRayLength;
    list.push_back(ray);
  }
  return list;
}

// Sixteenths of a voxel, between which a cubic is the smooth field to 1e-6.
std::vector<double> fine_places() {
  std::vector<double> places;
  for (int i = 0; i <= 16 * static_cast<int>(kRayLength); ++i) places.push_back(i / 16.0);
  return places;
}

using Rows = std::vector<std::vector<std::string>>;

// Samples at even steps: tables of a constant length, 2D and 3D. scalar_at(ray, t) is the scalar at
// a distance t along a ray; as many rays as `right` has.
template <class ScalarAt>
void by_step(const ScalarAt& scalar_at, const std::vector<std::array<double, 4>>& right,
             const TransferFunction& function, bool quick, Rows& rows) {
  double last_second = 0;
  std::size_t row = 0;
  for (const int samples : {8, 16, 32, 64, 128}) {
    if (quick && samples > 32) break;
    const double step = kRayLength / samples;
    const PreintegratedTable first(function,
                                   {256, 2, std::array{0.0f, 1.0f}, {}, static_cast<float>(step)});
    const SecondOrderTable second(
        function, {quick ? 32 : 96, 2, std::array{0.0f, 1.0f}, {}, static_cast<float>(2 * step)});
    ColorError of_first, of_second;
    for (std::size_t r = 0; r < right.size(); ++r) {
      const auto at = [&](int i) { return static_cast<float>(scalar_at(r, i * step)); };
      Compositor by_first, by_second;
      for (int i = 0; i < samples; ++i)
        by_first.add(first.integrate(at(i), at(i + 1), static_cast<float>(step)));
      for (int i = 0; i < samples; i += 2)
        by_second.add(second.integrate(ScalarPolynomial::quadratic(at(i), at(i + 1), at(i + 2)),
                                       static_cast<float>(2 * step)));
      of_first.add(color_of(by_first), right[r]);
      of_second.add(color_of(by_second), right[r]);
    }
    if (rows.size() <= ++row) rows.push_back({fmt::format("{:g}", step)});
    for (const ColorError& error : {of_first, of_second})
      rows[row].push_back(fmt::format("{:.1e}", error.rms()));
    rows[row].push_back(row == 1 ? "" : fmt::format("{:.2f}", last_second / of_first.rms()));
    last_second = of_second.rms();
  }
}

// Samples at the voxels' borders and between, as walkers give them.
std::string by_voxel(const TrilinearField& field, const std::vector<FieldRay>& list,
                     const std::vector<std::array<double, 4>>& right,
                     const TransferFunction& function, bool quick) {
  const ClosedForm closed_form(function);
  const AdaptiveIntegrator adaptive(function);
  const SecondOrderTable table(
      function, {quick ? 16 : 40, 24, std::array{0.0f, 1.0f}, std::array{1e-3f, 2.0f}});
  Rows rows{{"in each voxel", "samples a voxel", "RMS", "largest"}};
  const auto add_row = [&](const std::string& name, int samples, const auto& add) {
    ColorError error;
    for (std::size_t r = 0; r < list.size(); ++r) {
      const auto places = voxel_borders(list[r], kSize);
      Compositor sum;
      for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        const double from = places[i], width = places[i + 1] - from;
        add(
            sum, [&](double u) { return static_cast<float>(field(list[r].at(from + u * width))); },
            static_cast<float>(width));
      }
      error.add(color_of(sum), right[r]);
    }
    rows.push_back({name, std::to_string(samples), fmt::format("{:.1e}", error.rms()),
                    fmt::format("{:.1e}", error.largest)});
  };
  for (const int parts : {1, 2, 4, 8})
    add_row(
        fmt::format("closed form, {} linear part{}", parts, parts > 1 ? "s" : ""), parts,
        [&](Compositor& sum, const auto& at, float length) {
          for (int i = 0; i < parts; ++i)
            sum.add(closed_form.integrate(at(static_cast<double>(i) / parts), at((i + 1.0) / parts),
                                          length / static_cast<float>(parts)));
        });
  const auto quadratic = [](const auto& at) {
    return ScalarPolynomial::quadratic(at(0), at(0.5), at(1));
  };
  add_row(fmt::format("table of second order, {}^3 x 24", quick ? 16 : 40), 2,
          [&](Compositor& sum, const auto& at, float length) {
            sum.add(table.integrate(quadratic(at), length));
          });
  add_row("reference, quadratic", 2, [&](Compositor& sum, const auto& at, float length) {
    sum.add(adaptive.integrate(quadratic(at), length));
  });
  return markdown_table(rows);
}

// Rays along which the scalar is one polynomial of degree 2 from end to end, in [0, 1].
std::vector<ScalarPolynomial> quadratic_rays(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<ScalarPolynomial> list;
  while (list.size() < count) {
    const auto scalar = ScalarPolynomial::quadratic(unit(random), unit(random), unit(random));
    bool inside = true;
    for (int i = 0; i <= 64; ++i) {
      const double s = scalar(i / 64.0);
      inside = inside && s >= 0 && s <= 1;
    }
    if (inside) list.push_back(scalar);
  }
  return list;
}

std::string along_rays(const TransferFunction& function, const IntegratorBenchOptions& options) {
  // 64^3 points, as are El Hajjar's.
  const TrilinearField trilinear(kSize, smooth_field);
  const AdaptiveIntegrator reference(function);
  const auto list = rays(std::max(8, options.segments / 14), options.seed);
  std::vector<std::array<double, 4>> of_smooth, of_trilinear;
  for (const FieldRay& ray : list) {
    of_smooth.push_back(exact_color(smooth_field, ray, fine_places(), reference));
    of_trilinear.push_back(exact_color(trilinear, ray, voxel_borders(ray, kSize), reference));
  }
  const auto quadratics = quadratic_rays(list.size(), options.seed);
  std::vector<std::array<double, 4>> of_quadratics;
  for (const ScalarPolynomial& scalar : quadratics) {
    const PreciseColor color = reference.integrate_precisely(scalar, kRayLength);
    of_quadratics.push_back({color.rgb[0], color.rgb[1], color.rgb[2], color.alpha});
  }
  Rows rows{{"step, voxels", "quadratic: first order", "second", "second at twice the step : first",
             "smooth: first order", "second", "second at twice the step : first",
             "trilinear: first order", "second", "second at twice the step : first"}};
  by_step([&](std::size_t r, double t) { return quadratics[r](t / kRayLength); }, of_quadratics,
          function, options.quick, rows);
  by_step([&](std::size_t r, double t) { return smooth_field(list[r].at(t)); }, of_smooth, function,
          options.quick, rows);
  by_step([&](std::size_t r, double t) { return trilinear(list[r].at(t)); }, of_trilinear, function,
          options.quick, rows);
  return "### Second order against first, by step: RMS error of a ray\n\n" + markdown_table(rows) +
         "\n### Second order against first, voxel by voxel: error of a ray\n\n" +
         by_voxel(trilinear, list, of_trilinear, function, options.quick);
}

// Quadratic segments, half of them with a middle up to 0.1 off the line between the ends.
std::string single_segments(const TransferFunction& function,
                            const IntegratorBenchOptions& options) {
  struct Curved {
    ScalarPolynomial scalar;
    float length;
  };
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Curved> list;
  for (int i = 0; i < options.segments; ++i) {
    const float s_in = unit(random), s_out = unit(random);
    const float middle =
        i % 2 == 0 ? unit(random)
                   : std::clamp((s_in + s_out) / 2 + 0.2f * (unit(random) - 0.5f), 0.0f, 1.0f);
    list.push_back({ScalarPolynomial::quadratic(s_in, middle, s_out),
                    tests::random_length(random, 1e-3f, 10)});
  }
  const AdaptiveIntegrator reference(function);
  std::vector<std::array<double, 4>> right;
  for (const Curved& one : list) {
    const PreciseColor color = reference.integrate_precisely(one.scalar, one.length);
    right.push_back({color.rgb[0], color.rgb[1], color.rgb[2], color.alpha});
  }
  Rows rows{{"integrator", "RMS", "largest", "ns", "MB", "built in, ms"}};
  std::vector<std::function<void()>> tasks;
  std::vector<Compositor> sums(list.size());
  const auto add_row = [&](const std::string& name, const auto& integrate, double bytes,
                           double seconds) {
    ColorError error;
    const auto all = [&list, &sums, integrate] {
      for (std::size_t i = 0; i < list.size(); ++i) sums[i] = integrate(list[i]);
    };
    all();
    for (std::size_t i = 0; i < list.size(); ++i) error.add(color_of(sums[i]), right[i]);
    tasks.push_back(all);
    rows.push_back({name, fmt::format("{:.1e}", error.rms()), fmt::format("{:.1e}", error.largest),
                    "", bytes > 0 ? fmt::format("{:.1f}", bytes * 1e-6) : "",
                    bytes > 0 ? fmt::format("{:.0f}", 1e3 * seconds) : ""});
  };
  const ClosedForm closed_form(function);
  for (const int parts : {1, 2, 4, 8, 32})
    add_row(
        fmt::format("closed form, {} linear part{}", parts, parts > 1 ? "s" : ""),
        [&closed_form, parts](const Curved& one) {
          Compositor sum;
          for (int i = 0; i < parts; ++i)
            sum.add(closed_form.integrate(
                static_cast<float>(one.scalar(static_cast<double>(i) / parts)),
                static_cast<float>(one.scalar((i + 1.0) / parts)),
                one.length / static_cast<float>(parts)));
          return sum;
        },
        0, 0);
  const auto whole = [](const auto& integrator) {
    return [&integrator](const Curved& one) {
      Compositor sum;
      sum.add(integrator.integrate(one.scalar, one.length));
      return sum;
    };
  };
  // Not moved once somebody refers to them.
  std::vector<SecondOrderTable> tables;
  for (const auto& [scalars, lengths] : {std::pair{16, 12}, {24, 16}, {40, 24}, {64, 32}}) {
    if (options.quick && scalars > 24) break;
    tables.emplace_back(function, SecondOrderTableSettings{scalars, lengths, std::array{0.0f, 1.0f},
                                                           std::array{1e-3f, 10.0f}});
  }
  const std::array<const char*, 4> names{"16^3 x 12", "24^3 x 16", "40^3 x 24", "64^3 x 32"};
  for (std::size_t i = 0; i < tables.size(); ++i)
    add_row(fmt::format("table of second order, {}", names[i]), whole(tables[i]),
            static_cast<double>(tables[i].report().bytes), tables[i].report().build_seconds);
  add_row("reference, 1e-9", whole(reference), 0, 0);
  const auto seconds = take_turns(tasks, options.rounds);
  for (std::size_t i = 0; i < tasks.size(); ++i)
    rows[i + 1][3] =
        fmt::format("{:.0f}", 1e9 * median(seconds[i]) / static_cast<double>(list.size()));
  return markdown_table(rows);
}

}  // namespace

std::string second_order_errors(const IntegratorBenchOptions& options) {
  const TransferFunction function = tests::smooth_function();
  TransferFunction per_voxel = function;  // some 32 voxels are not opaque
  for (auto& knot : per_voxel.knots) knot.optics.extinction *= 0.02f;
  return along_rays(per_voxel, options) + "\n### Single quadratic segments\n\n" +
         single_segments(function, options);
}

}  // namespace plume::bench
