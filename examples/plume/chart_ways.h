/// All ways in which a scene can be rendered, for a chart of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plume/lib/plume.h"

namespace plume::command {

/// What a way's point on the chart is coloured by.
enum class WayKind {
  closed_form,
  ray_by_ray,
  samples,
  table,
  second_order_table,
  quadrature,
  other_walker
};

/// For legends.
const char* name_of(WayKind kind);

/// Settings, and what to call them.
///
/// Names are made of parts, separated by "; ". Those that every mesh has: the integrator ("closed
/// form", "4 samples", "table 128x128x32", "table2 40^3x24", "quadrature"); "ray by ray" where
/// packets of rays would serve; "end 1e-2", the transmittance at which rays end, or "whole rays"
/// (1e-4 where nothing is said). Where cells are not linear, first the order of the scalar: "order
/// 1", "order 2 to 1e-3" (as closely as its linear parts follow it), "adaptive to 1e-5"; and for
/// curvilinear grids "Plücker walker" and "hybrid walker" (chart_walkers.h).
struct ChartWay {
  std::string name;
  WayKind kind = WayKind::closed_form;
  RenderSettings settings;
  /// Chosen by the planner, for this tolerance; planning took so long, milliseconds.
  std::optional<double> tolerance;
  double planning = 0;
  /// Makes the picture where it is not render() that does.
  std::function<Image(const RenderSettings&)> draw;
};

/// The name of these settings, and their kind.
ChartWay way_of(const Scene& scene, const RenderSettings& settings);

/// Every order, integrator and table size that fits the scene's mesh, as changes to `base` (size,
/// threads), whose mode must be volume; "the reference" is the last. With `quick`, about one of
/// each integrator and order.
std::vector<ChartWay> chart_ways(const Scene& scene, const RenderSettings& base, bool quick);

/// What the planner chooses for 1e-2, 1e-3 and 1e-4.
std::vector<ChartWay> planned_ways(const Scene& scene, const Camera& camera,
                                   const RenderSettings& base);

}  // namespace plume::command
