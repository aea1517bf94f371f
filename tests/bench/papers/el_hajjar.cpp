// El Hajjar et al., "Second Order Pre-Integrated Volume Rendering", figures 7 to 9.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/preint/preintegrated_table.h"
#include "plume/preint/second_order_table.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/papers/paper_tables.h"
#include "plume/tests/bench/papers/stand_in_fields.h"
#include "plume/tests/bench/picture_error.h"
#include "plume/tests/bench/timing.h"
#include "plume/tests/bench/trilinear_field.h"

namespace plume::bench {
namespace {

constexpr int kPoints = 64;

// One of the three pictures of a figure.
struct Picture {
  int order, step;  // step in voxels
  const char* fps;  // theirs
};
struct Figure {
  const char* name;
  StandInField field;
  std::array<Picture, 3> pictures;
};

// Three humps, in a haze: the paper shows surfaces in its pictures and does not print its
// functions.
TransferFunction humps(double per_length) {
  TransferFunction made{{{0, {0, {0.2f, 0.2f, 0.4f}}}}};
  const std::array<std::pair<float, std::array<float, 3>>, 3> at{
      {{0.25f, {0.1f, 0.4f, 1}}, {0.5f, {0.2f, 0.9f, 0.3f}}, {0.78f, {1, 0.5f, 0.1f}}}};
  for (const auto& [scalar, color] : at) {
    made.knots.push_back({scalar - 0.06f, {0.005f, color}});
    made.knots.push_back({scalar, {0.25f, color}});
    made.knots.push_back({scalar + 0.06f, {0.005f, color}});
  }
  made.knots.push_back({1, {0.1f, {1, 0.9f, 0.8f}}});
  for (auto& knot : made.knots) knot.optics.extinction *= static_cast<float>(per_length);
  return made;
}

// The picture's rays where they are in the field, in voxels, cut to whole slabs.
std::vector<FieldRay> rays_of(const Camera& camera, int size, double slab) {
  const PixelRays pixel_rays(camera, size, size);
  std::vector<FieldRay> made;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const Ray ray = pixel_rays(x + 0.5, y + 0.5);
      double in = 0, out = std::numeric_limits<double>::infinity();
      for (std::size_t a = 0; a < 3; ++a) {
        const double low = -ray.origin[a] / ray.direction[a];
        const double high = (1 - ray.origin[a]) / ray.direction[a];
        in = std::max(in, std::min(low, high));
        out = std::min(out, std::max(low, high));
      }
      const double length = slab * std::floor((kPoints - 1) * (out - in) / slab);
      if (!(length > 0)) continue;
      FieldRay one{{}, ray.direction, length};
      for (std::size_t a = 0; a < 3; ++a)
        one.origin[a] = (kPoints - 1) * (ray.origin[a] + in * ray.direction[a]);
      made.push_back(one);
    }
  return made;
}

using Row = std::vector<std::string>;

std::string figure(const Figure& figure, const PaperOptions& options) {
  const int size = options.quick ? 16 : 256;
  const int step = figure.pictures[0].step;
  const Mesh grid = stand_in_grid(figure.field, {kPoints, kPoints, kPoints});
  const TrilinearField field(kPoints, [&](const std::array<double, 3>& p) {
    return figure.field({p[0] / (kPoints - 1), p[1] / (kPoints - 1), p[2] / (kPoints - 1)});
  });
  const TransferFunction function = humps(1);
  Scene scene(grid);
  scene.set_transfer_function(humps(kPoints - 1));
  Camera camera = named_view("iso", scene.bounds());
  orbit(camera, 3, 2);

  const auto rays = rays_of(camera, size, 2 * step);
  const AdaptiveIntegrator adaptive(function);
  constexpr std::size_t kStride = 7;  // of the rays whose error is measured
  std::vector<std::array<double, 4>> right;
  for (std::size_t r = 0; r < rays.size(); r += kStride)
    right.push_back(exact_color(field, rays[r], voxel_borders(rays[r], kPoints), adaptive));

  std::vector<Row> rows{
      {"picture", "paper: FPS", "x (a)", "here: fps", "x (a)", "RMS error", "largest"}};
  std::vector<std::function<void()>> tasks;
  std::vector<Compositor> sums(rays.size());
  const auto at = [&](const FieldRay& ray, double t) {
    return static_cast<float>(field(ray.at(t)));
  };
  std::vector<PreintegratedTable> first;
  std::vector<SecondOrderTable> second;
  first.reserve(2);
  second.reserve(1);
  for (std::size_t p = 0; p < 3; ++p) {
    const Picture& picture = figure.pictures[p];
    const float d = static_cast<float>(picture.step);
    if (picture.order == 1) {
      const PreintegratedTable& table = first.emplace_back(
          function, TableSettings{options.quick ? 64 : 256, 2, std::array{0.0f, 1.0f}, {}, d});
      tasks.emplace_back([&, d] {
        for (std::size_t r = 0; r < rays.size(); ++r) {
          Compositor sum;
          const int samples = static_cast<int>(rays[r].length / d + 0.5);
          float front = at(rays[r], 0);
          for (int i = 1; i <= samples; ++i) {
            const float back = at(rays[r], i * static_cast<double>(d));
            sum.add(table.integrate(front, back, d));
            front = back;
          }
          sums[r] = sum;
        }
      });
    } else {
      const SecondOrderTable& table = second.emplace_back(
          function,
          SecondOrderTableSettings{options.quick ? 24 : 128, 2, std::array{0.0f, 1.0f}, {}, 2 * d});
      tasks.emplace_back([&, d] {
        for (std::size_t r = 0; r < rays.size(); ++r) {
          Compositor sum;
          const int slabs = static_cast<int>(rays[r].length / (2 * d) + 0.5);
          float front = at(rays[r], 0);
          for (int i = 0; i < slabs; ++i) {
            const float middle = at(rays[r], (2 * i + 1) * static_cast<double>(d));
            const float back = at(rays[r], (2 * i + 2) * static_cast<double>(d));
            sum.add(table.integrate(ScalarPolynomial::quadratic(front, middle, back), 2 * d));
            front = back;
          }
          sums[r] = sum;
        }
      });
    }
    tasks.back()();
    ColorError error;
    for (std::size_t r = 0; r < rays.size(); r += kStride)
      error.add(color_of(sums[r]), right[r / kStride]);
    rows.push_back({fmt::format("({}) order {}, every {} voxel{}", "abc"[p], picture.order,
                                picture.step, picture.step > 1 ? "s" : ""),
                    picture.fps, "", "", "", fmt::format("{:.1e}", error.rms()),
                    fmt::format("{:.1e}", error.largest)});
  }
  RenderSettings exact;
  exact.width = exact.height = size;
  exact.tolerance = Tolerance{0};
  const Image truth = render(scene, camera, exact).image;
  for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic}) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.threads = 1;
    settings.order = order;
    settings.early_termination = 0;
    const PictureError error = picture_error(render(scene, camera, settings).image, truth);
    tasks.emplace_back([&scene, &camera, settings] { render(scene, camera, settings); });
    rows.push_back({order == ScalarOrder::linear ? "Plume, voxel by voxel, order 1, packets"
                                                 : "Plume, voxel by voxel, order 3, ray by ray",
                    "", "", "", "", fmt::format("{:.1e}", error.rms),
                    fmt::format("{:.1e}", error.largest)});
  }
  const auto seconds = take_turns(tasks, options.rounds);
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    Row& row = rows[t + 1];
    row[3] = fmt::format("{:.2f}", 1 / median(seconds[t]));
    row[4] = fmt::format("{:.2f}", median(seconds[0]) / median(seconds[t]));
    if (t < 3)
      row[2] = fmt::format("{:.2f}",
                           std::stod(figure.pictures[t].fps) / std::stod(figure.pictures[0].fps));
  }
  return fmt::format(
             R"(The captions of the figure's pictures. Paper: nVIDIA GeForce 7800GTX (and Athlon64 3200+), sampled from a 3D texture;
the size of its pictures and its transfer functions are not given. Here: one thread of the processor, {0} x {0} pixels,
view iso. {1}: a stand-in, {2}^3 points.

(a), (b), (c): samples at even steps of a trilinear field, tables of first (256^2 entries) and second order (128^3; the
paper's has 256^3) of a constant length, written as plainly as the paper describes them. Errors are of linear RGBA,
against adaptive quadrature along the same rays, cut to whole slabs; the paper shows its errors as pictures alone.
Plume renders the same grid from voxel to voxel, integrated in closed form; its error is that of the whole picture
against `--tolerance 0`. Its packets of order 1 are vectorised and (a) to (c) are not, so that times compare these three
with each other, and Plume's as a user has it. Frames: of a thread's time on the processor, medians.

)",
             size, figure.name, kPoints) +
         markdown_table(rows);
}

}  // namespace

std::string el_hajjar_figure_7(const PaperOptions& options) {
  return figure({"Neghip*", neghip_field, {{{1, 2, "54.0"}, {1, 1, "29.4"}, {2, 2, "84.2"}}}},
                options);
}
std::string el_hajjar_figure_8(const PaperOptions& options) {
  return figure({"Fuel*", fuel_field, {{{1, 2, "44.7"}, {1, 1, "23.8"}, {2, 2, "75.0"}}}}, options);
}
std::string el_hajjar_figure_9(const PaperOptions& options) {
  return figure(
      {"Bucky Ball*", bucky_ball_field, {{{1, 4, "80.0"}, {1, 1, "24.6"}, {2, 4, "111.3"}}}},
      options);
}

}  // namespace plume::bench
