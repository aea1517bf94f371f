#include "plume/lib/render_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plume/lib/render_modes.h"

namespace plume {

bool is_classified(const Scene& scene, const RenderSettings& settings) {
  return !scene.classification().is_plain_volume() &&
         (settings.mode == Mode::volume || settings.mode == Mode::depth);
}

bool has_linear_cells(const Scene& scene) {
  return scene.field().association == Association::cell ||
         std::string(scene.form()) == "tetrahedra";
}

bool is_blurred(const Scene& scene, const RenderSettings& settings) {
  return settings.mode == Mode::volume && scene.classification().volume &&
         (settings.integrator.kind == IntegratorKind::table ||
          settings.integrator.kind == IntegratorKind::second_order_table);
}

bool is_linear(const Scene& scene, const RenderSettings& settings) {
  return settings.order == ScalarOrder::linear || has_linear_cells(scene);
}

namespace {

const char* describe_order(ScalarOrder order) {
  switch (order) {
    case ScalarOrder::linear:
      break;
    case ScalarOrder::quadratic:
      return "order 2: quadratic, by one value inside of each cell";
    case ScalarOrder::cubic:
      return "order 3: cubic, by two values inside of each cell";
    case ScalarOrder::adaptive:
      return "adaptive: cut until cubics follow the cells' interpolation";
  }
  return "linear between a cell's faces";
}

void describe_surfaces(const Scene& scene, const RenderSettings& settings,
                       std::vector<std::string>& plan) {
  const Classification& classification = scene.classification();
  if (!classification.intervals.empty()) {
    std::vector<std::string> ranges;
    for (const IntervalVolume& interval : classification.intervals)
      ranges.push_back(fmt::format("[{:g}, {:g}]", interval.low, interval.high));
    plan.push_back(fmt::format(
        "intervals: {}, {}, monotone along each ray, {}", fmt::join(ranges, " "),
        settings.interval_way == IntervalWay::split ? "split in data space" : "from tables",
        settings.interval_form == IntervalForm::exponential ? "exponential" : "linear"));
  }
  if (!classification.isosurfaces.empty()) {
    std::vector<std::string> values;
    for (const Isosurface& surface : classification.isosurfaces)
      values.push_back(fmt::format("{:g}", surface.value));
    plan.push_back(fmt::format("isosurfaces: {}, {}", fmt::join(values, " "),
                               settings.interval_way == IntervalWay::table ? "from tables"
                               : is_linear(scene, settings)
                                   ? "in closed form"
                                   : "by isolated roots of each cell's polynomial"));
  }
}

}  // namespace

std::optional<std::string> describe_table(const Integrator& integrator) {
  return std::visit(
      [](const auto& chosen) -> std::optional<std::string> {
        if constexpr (requires { chosen.report(); }) {
          const TableReport& report = chosen.report();
          if (report.bytes == 0) return "table: none, as there is nothing to tabulate";
          return fmt::format(
              "table: {:.1f} MB, built in {:.0f} ms, error {:.1g} at most and {:.1g} RMS of 4096 "
              "segments spread over it",
              static_cast<double>(report.bytes) * 1e-6, 1e3 * report.build_seconds,
              report.largest_error, report.rms_error);
        }
        return std::nullopt;
      },
      integrator);
}

std::vector<std::string> describe_plan(const Scene& scene, const RenderSettings& settings) {
  std::vector<std::string> plan;
  const std::string form = scene.form();
  plan.push_back(fmt::format(
      "walk: {} ({})", form,
      form == "tetrahedra"         ? "all cells are tetrahedra: the scalar is linear in each"
      : form == "grid"             ? "one curvilinear grid: neighbours follow from the indices"
      : form == "rectilinear grid" ? "cuboids between planes: nothing is stored but the scalars"
                                   : "mixed cells: faces and their two sides are stored"));
  if (scene.cell_data_averaged())
    plan.push_back("cell data: averaged to the points, weighted by 1 / distance");
  plan.push_back(fmt::format("scalar: {}, {}", scene.field().name,
                             scene.field().association == Association::cell
                                 ? "constant in each cell, as the field is cell-centred"
                             : form == "tetrahedra" ? "linear between a cell's faces"
                                                    : describe_order(settings.order)));
  if (!settings.clip_planes.empty())
    plan.push_back(fmt::format("clip planes: {}, where rays are cut", settings.clip_planes.size()));
  if (scene.surface_triangle_count() > 0)
    plan.push_back(
        fmt::format("opaque surfaces: {} triangles; rays end there, and are walked one by one",
                    scene.surface_triangle_count()));
  if (settings.mode != Mode::volume) {
    plan.push_back(is_classified(scene, settings) ? "first hit of an isosurface or interval"
                                                  : in_words(settings.mode).cost);
  } else if (!scene.classification().volume) {
    plan.push_back("volume: none");
  } else {
    constexpr const char* kNames[] = {"midpoint", "table", "closed form", "table of second order",
                                      "reference"};
    plan.push_back(fmt::format("integrator: {} ({} knots)",
                               kNames[static_cast<int>(settings.integrator.kind)],
                               scene.transfer_function().knots.size()));
  }
  if (is_classified(scene, settings)) describe_surfaces(scene, settings, plan);
  if (settings.lighting)
    plan.push_back(is_classified(scene, settings)
                       ? fmt::format("light: {} on isosurfaces{}, by gradients at the points",
                                     settings.lighting->lights.size(),
                                     settings.lighting->intervals ? " and intervals" : "")
                       : "light: nothing to light, as there are no isosurfaces and intervals");
  return plan;
}

}  // namespace plume
