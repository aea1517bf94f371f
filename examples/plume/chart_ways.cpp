#include "chart_ways.h"

#include <fmt/format.h>

#include "plume/lib/planner.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/tiles.h"
#include "stopwatch.h"

namespace plume::command {
namespace {

constexpr double kUsualEnd = 1e-4;  // of rays: what RenderSettings begin with

// 1e-4, not 1.0e-04.
std::string short_number(double value) {
  std::string text = fmt::format("{:.1e}", value);
  if (const auto at = text.find(".0e"); at != std::string::npos) text.erase(at, 2);
  if (const auto at = text.find("e-0"); at != std::string::npos) text.erase(at + 2, 1);
  return text;
}

std::string order_name(const RenderSettings& settings) {
  const std::string to = " to " + short_number(settings.scalar_tolerance);
  switch (settings.order) {
    case ScalarOrder::linear:
      return "order 1";
    case ScalarOrder::quadratic:
      return "order 2" + to;
    case ScalarOrder::cubic:
      return "order 3" + to;
    case ScalarOrder::adaptive:
      return "adaptive" + to;
  }
  return {};
}

std::string integrator_name(const IntegratorSettings& integrator) {
  switch (integrator.kind) {
    case IntegratorKind::closed_form:
      return "closed form";
    case IntegratorKind::midpoint:
      return fmt::format("{} sample{}", integrator.samples, integrator.samples > 1 ? "s" : "");
    case IntegratorKind::table:
      return fmt::format("table {0}x{0}x{1}", integrator.table.scalar_count,
                         integrator.table.length_count);
    case IntegratorKind::second_order_table:
      return fmt::format("table2 {}^3x{}", integrator.second_order_table.scalar_count,
                         integrator.second_order_table.length_count);
    case IntegratorKind::reference:
      return "quadrature to " + short_number(integrator.tolerance);
  }
  return {};
}

bool would_take_packets(const Scene& scene, const RenderSettings& settings) {
  return has_packets(scene) && settings.integrator.kind == IntegratorKind::closed_form &&
         has_packets_of_order(scene, settings);
}

// Collects settings, each once.
class Ways {
 public:
  Ways(const Scene& scene, const RenderSettings& base) : scene_(scene), base_(base) {
    base_.early_termination = kUsualEnd;
  }

  void order(ScalarOrder order, double to) {
    base_.order = order;
    base_.scalar_tolerance = to;
  }
  void closed_form(double end, bool ray_by_ray = false) {
    RenderSettings settings = base_;
    settings.early_termination = end;
    settings.scalar_twin = ray_by_ray;
    if (ray_by_ray && !would_take_packets(scene_, settings)) return;
    add(settings);
  }
  void samples(int count) {
    RenderSettings settings = base_;
    settings.integrator.kind = IntegratorKind::midpoint;
    settings.integrator.samples = count;
    add(settings);
  }
  void table(int scalars, int lengths) {
    RenderSettings settings = base_;
    settings.integrator.kind = IntegratorKind::table;
    settings.integrator.table.scalar_count = scalars;
    settings.integrator.table.length_count = lengths;
    add(settings);
  }
  void second_order_table(int scalars, int lengths) {
    RenderSettings settings = base_;
    settings.integrator.kind = IntegratorKind::second_order_table;
    settings.integrator.second_order_table.scalar_count = scalars;
    settings.integrator.second_order_table.length_count = lengths;
    add(settings);
  }
  void quadrature(double tolerance, double end) {
    RenderSettings settings = base_;
    settings.integrator.kind = IntegratorKind::reference;
    settings.integrator.tolerance = tolerance;
    settings.early_termination = end;
    add(settings);
  }
  std::vector<ChartWay> take() { return std::move(ways_); }

 private:
  void add(const RenderSettings& settings) { ways_.push_back(way_of(scene_, settings)); }

  const Scene& scene_;
  RenderSettings base_;
  std::vector<ChartWay> ways_;
};

// Of all meshes. Where the scalar is linear in cells, the end of rays is most of the error, and
// else least.
void add_linear(Ways& ways, bool linear_cells, bool quick) {
  ways.order(ScalarOrder::linear, 1e-4);
  for (const double end : {1e-1, 1e-2, 1e-3, kUsualEnd, 1e-5, 0.0}) {
    const bool telling = linear_cells || end >= 1e-2;
    if (end != kUsualEnd && end != 0 && (quick || !telling)) continue;
    ways.closed_form(end);
    if (end <= kUsualEnd) ways.closed_form(end, true);
  }
  for (const int count : {1, 2, 4, 8, 16, 32})
    if (!quick || count == 1 || count == 4) ways.samples(count);
  for (const int scalars : {32, 64, 128, 256})
    if (!quick || scalars == 64) ways.table(scalars, 32);
  if (!quick) {
    ways.table(128, 8);
    ways.table(256, 128);
  }
  ways.quadrature(AdaptiveIntegrator::default_tolerance, kUsualEnd);
}

void add_curved(Ways& ways, ScalarOrder order, bool quick) {
  for (const double to : {1e-2, 1e-3, 1e-4, 1e-5}) {
    if (quick && to != 1e-4) continue;
    ways.order(order, to);
    ways.closed_form(kUsualEnd);
    if (!quick && to <= 1e-4) ways.closed_form(0);
  }
  ways.order(order, 1e-4);
  if (quick) return;
  for (const int count : {1, 4}) ways.samples(count);
  for (const int scalars : {64, 128}) ways.table(scalars, 32);
  ways.quadrature(1e-4, kUsualEnd);  // of curves as they are, without linear parts
}

}  // namespace

const char* name_of(WayKind kind) {
  switch (kind) {
    case WayKind::closed_form:
      return "closed form";
    case WayKind::ray_by_ray:
      return "closed form, ray by ray";
    case WayKind::samples:
      return "samples";
    case WayKind::table:
      return "pre-integrated table";
    case WayKind::second_order_table:
      return "second-order table";
    case WayKind::quadrature:
      return "adaptive quadrature";
    case WayKind::other_walker:
      return "the thesis' walkers";
  }
  return "";
}

ChartWay way_of(const Scene& scene, const RenderSettings& settings) {
  ChartWay way;
  way.settings = settings;
  if (!has_linear_cells(scene)) way.name = order_name(settings) + "; ";
  way.name += integrator_name(settings.integrator);
  const bool ray_by_ray = settings.scalar_twin && would_take_packets(scene, settings);
  if (ray_by_ray) way.name += "; ray by ray";
  if (settings.early_termination == 0)
    way.name += "; whole rays";
  else if (settings.early_termination != kUsualEnd)
    way.name += "; end " + short_number(settings.early_termination);
  switch (settings.integrator.kind) {
    case IntegratorKind::closed_form:
      way.kind = ray_by_ray ? WayKind::ray_by_ray : WayKind::closed_form;
      break;
    case IntegratorKind::midpoint:
      way.kind = WayKind::samples;
      break;
    case IntegratorKind::table:
      way.kind = WayKind::table;
      break;
    case IntegratorKind::second_order_table:
      way.kind = WayKind::second_order_table;
      break;
    case IntegratorKind::reference:
      way.kind = WayKind::quadrature;
      break;
  }
  return way;
}

std::vector<ChartWay> chart_ways(const Scene& scene, const RenderSettings& base, bool quick) {
  Ways ways(scene, base);
  add_linear(ways, has_linear_cells(scene), quick);
  if (!has_linear_cells(scene)) {
    add_curved(ways, ScalarOrder::quadratic, quick);
    for (const int scalars : {12, 24, 40})
      if (!quick || scalars == 12) ways.second_order_table(scalars, 24);
    add_curved(ways, ScalarOrder::cubic, quick);
    for (const double to : {1e-3, 1e-4, 1e-5, 1e-6}) {
      if (quick && to != 1e-4) continue;
      ways.order(ScalarOrder::adaptive, to);
      ways.closed_form(to >= 1e-4 ? kUsualEnd : 0);
      if (!quick) ways.quadrature(to, to >= 1e-4 ? kUsualEnd : 0);
    }
  } else if (!quick) {
    ways.quadrature(1e-6, 0);
  }
  std::vector<ChartWay> made = ways.take();
  made.push_back(way_of(scene, reference_settings(base)));
  made.back().name = "the reference";
  return made;
}

std::vector<ChartWay> planned_ways(const Scene& scene, const Camera& camera,
                                   const RenderSettings& base) {
  std::vector<ChartWay> ways;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    RenderSettings settings = base;
    settings.tolerance = Tolerance{tolerance};
    Stopwatch watch;
    const RenderSettings plan = plan_for(scene, camera, settings).settings;
    ways.push_back(way_of(scene, plan));
    ways.back().planning = watch.lap();
    ways.back().name = fmt::format("tolerance {}: {}", short_number(tolerance), ways.back().name);
    ways.back().tolerance = tolerance;
  }
  return ways;
}

}  // namespace plume::command
