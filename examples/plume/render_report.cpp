#include "render_report.h"

#include <nlohmann/json.hpp>

#include "console.h"

namespace plume::command {
namespace {

nlohmann::json to_json(const std::vector<Finding>& findings) {
  auto list = nlohmann::json::array();
  for (const Finding& finding : findings) list.push_back(describe(finding));
  return list;
}

}  // namespace

std::string render_report(const Scene& scene, const RenderSettings& settings,
                          const RenderArguments& args, const RenderStatistics& statistics,
                          const StageTimes& ms) {
  const ScalarField& field = scene.field();
  const double cells = static_cast<double>(scene.cell_count());
  const bool of_cells = field.association == Association::cell || scene.cell_data_averaged();
  const nlohmann::json stats{
      {"rays", statistics.rays},
      {"rays_hit", statistics.rays_hit},
      {"entries", statistics.entries},
      {"cells_visited", statistics.cells_visited},
      {"lost_rays", statistics.lost_rays},
      {"rays_in_packets", statistics.rays_in_packets},
      {"isosurfaces_crossed", statistics.surfaces},
      {"interval_visits", statistics.visits},
      {"ms", {{"read", ms.read}, {"build", ms.build}, {"render", ms.render}, {"write", ms.write}}},
      {"peak_memory_bytes", peak_memory_bytes()},
      {"bytes_per_cell", static_cast<double>(scene.bytes()) / cells},
      {"walkable_bytes", scene.bytes()},
      {"cells", scene.cell_count()},
      {"points", scene.point_count()},
      {"boundary_faces", scene.boundary_face_count()},
      {"field", field.name},
      {"field_association", of_cells ? "cell" : "point"},
      {"cell_data", of_cells ? nlohmann::json(args.cell_data) : nlohmann::json()},
      {"field_range", {field.low, field.high}},
      {"values_not_finite", field.not_finite},
      {"size", {settings.width, settings.height}},
      {"values", statistics.values ? nlohmann::json(*statistics.values) : nlohmann::json()},
      {"order", static_cast<int>(statistics.order)},
      {"plan", statistics.plan},
      {"findings", to_json(scene.findings())}};
  return stats.dump(2) + "\n";
}

}  // namespace plume::command
