#include "render_report.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "console.h"

namespace plume::command {
namespace {

nlohmann::json to_json(const std::vector<Finding>& findings) {
  auto list = nlohmann::json::array();
  for (const Finding& finding : findings) list.push_back(describe(finding));
  return list;
}

nlohmann::json of_tolerance(const RenderSettings& settings, const RenderStatistics& statistics) {
  if (!settings.tolerance) return nullptr;
  return {{"asked", settings.tolerance->max_error},
          {"error_estimate", statistics.error_estimate.value_or(0)},
          {"kept", statistics.keeps_tolerance},
          {"ms_planning", 1e3 * statistics.seconds_planning}};
}

nlohmann::json others(const std::vector<const Scene*>& scenes) {
  auto list = nlohmann::json::array();
  for (std::size_t i = 1; i < scenes.size(); ++i) {
    const ScalarField& field = scenes[i]->field();
    list.push_back({{"mesh", scenes[i]->name()},
                    {"cells", scenes[i]->cell_count()},
                    {"walkable_bytes", scenes[i]->bytes()},
                    {"field", field.name},
                    {"field_range", {field.low, field.high}}});
  }
  return list;
}

}  // namespace

nlohmann::json render_record(const FrameOfSeries& frame, const std::vector<const Scene*>& scenes,
                             const RenderSettings& settings, const RenderArguments& args,
                             const RenderStatistics& statistics, const StageTimes& ms) {
  const Scene& scene = *scenes.front();
  const ScalarField& field = scene.field();
  const double cells = static_cast<double>(scene.cell_count());
  const bool of_cells = field.association == Association::cell || scene.cell_data_averaged();
  return {{"output", frame.output},
          {"step", frame.step},
          {"time", frame.time ? nlohmann::json(*frame.time) : nlohmann::json()},
          {"turn", frame.turn},
          {"mesh_stayed", frame.mesh_stayed},
          {"rays", statistics.rays},
          {"rays_hit", statistics.rays_hit},
          {"entries", statistics.entries},
          {"cells_visited", statistics.cells_visited},
          {"lost_rays", statistics.lost_rays},
          {"rays_in_packets", statistics.rays_in_packets},
          {"rays_searched", statistics.rays_searched},
          {"hierarchy_made", statistics.hierarchy_made},
          {"isosurfaces_crossed", statistics.surfaces},
          {"interval_visits", statistics.visits},
          {"rays_overlapping", statistics.rays_overlapping},
          {"ms",
           {{"read", ms.read},
            {"build", ms.build},
            {"render", ms.render},
            {"write", ms.write},
            {"wait", ms.wait}}},
          {"peak_memory_bytes", peak_memory_bytes()},
          {"bytes_per_cell", static_cast<double>(scene.bytes()) / cells},
          {"walkable_bytes", scene.bytes()},
          {"cells", scene.cell_count()},
          {"points", scene.point_count()},
          {"boundary_faces", scene.boundary_face_count()},
          {"with", others(scenes)},
          {"field", field.name},
          {"field_association", of_cells ? "cell" : "point"},
          {"cell_data", of_cells ? nlohmann::json(args.cell_data) : nlohmann::json()},
          {"field_range", {field.low, field.high}},
          {"values_not_finite", field.not_finite},
          {"size", {settings.width, settings.height}},
          {"values", statistics.values ? nlohmann::json(*statistics.values) : nlohmann::json()},
          {"gray_range",
           statistics.gray_range ? nlohmann::json(*statistics.gray_range) : nlohmann::json()},
          {"order", static_cast<int>(statistics.order)},
          {"tolerance", of_tolerance(settings, statistics)},
          {"plan", statistics.plan},
          {"findings", to_json(scene.findings())}};
}

std::string render_report(std::vector<nlohmann::json> records) {
  if (records.size() == 1) return records[0].dump(2) + "\n";
  return nlohmann::json{{"frames", std::move(records)}}.dump(2) + "\n";
}

}  // namespace plume::command
