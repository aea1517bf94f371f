// plume info: what is in a mesh file.

#include <fmt/format.h>

#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "console.h"
#include "planned_frames.h"
#include "plume/io/time_series.h"
#include "plume/lib/plume.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/validate.h"

namespace plume::command {
namespace {

using nlohmann::json;

struct InfoArguments {
  std::string mesh, solution;
  std::string time;
  bool merge_points = false, as_json = false;
};

json cells_by_type(const Mesh& mesh) {
  const CellReader cells(mesh);
  std::map<std::string, std::size_t> counts;
  for (std::size_t i = 0; i < cells.size(); ++i) ++counts[cell_type_name(cells.type(i))];
  return counts;
}

json describe_fields(const Mesh& mesh) {
  json list = json::array();
  for (const Field& field : mesh.fields) {
    const ScalarField scalar = select_field(mesh, {field.name, field.association});
    list.push_back({{"name", field.name},
                    {"association", field.association == Association::point ? "point" : "cell"},
                    {"components", field.components},
                    {"range", {scalar.low, scalar.high}},
                    {"not_finite", scalar.not_finite}});
  }
  return list;
}

json describe_mesh(const Mesh& mesh, std::vector<std::string> notices) {
  check_structure(mesh);
  Mesh walked = mesh;
  if (walked.fields.empty())  // the form of the mesh does not depend on the values
    walked.fields.push_back(
        {"none", Association::point, 1, Array::own(std::vector<float>(mesh.point_count(), 0.0f))});
  const Scene scene(walked);
  json problems = json::array();
  for (std::string& notice : notices) problems.push_back(std::move(notice));
  for (const auto& list : {find_poor_cells(mesh), scene.findings()})
    for (const Finding& finding : list) problems.push_back(describe(finding));
  const Bounds& bounds = scene.bounds();
  json info{{"cells", mesh.cell_count()},
            {"cells_by_type", cells_by_type(mesh)},
            {"points", mesh.point_count()},
            {"fields", describe_fields(mesh)},
            {"active_field", mesh.active_field},
            {"bounds", {{"low", bounds.low}, {"high", bounds.high}}},
            {"boundary_faces", scene.boundary_face_count()},
            {"components", scene.connected_part_count()},
            {"problems", problems},
            {"form", scene.form()},
            {"memory_bytes", scene.bytes()}};
  if (mesh.is_grid()) info["dimensions"] = mesh.dimensions;
  return info;
}

void print(const std::string& file, const json& info) {
  auto line = [](const std::string& label, const std::string& text) {
    std::cout << fmt::format("{:<16}{}\n", label, text);
  };
  auto number = [](const json& value) { return with_separators(value.get<std::size_t>()); };
  line("file", file);
  if (info.contains("times")) {
    const json& times = info["times"];
    std::string text = number(times.size());
    if (times.front().is_number() && times.back().is_number())
      text += fmt::format(", time {:g} to {:g}", times.front().get<double>(),
                          times.back().get<double>());
    line("steps", text + fmt::format("; this is step {}", number(info["step"])));
  }
  line("cells", number(info["cells"]));
  for (const auto& [type, count] : info["cells_by_type"].items())
    line("", fmt::format("{} {}", number(count), type));
  if (info.contains("dimensions"))
    line("grid", fmt::format("{} x {} x {} points", info["dimensions"][0].get<int>(),
                             info["dimensions"][1].get<int>(), info["dimensions"][2].get<int>()));
  line("points", number(info["points"]));
  const auto corner = [&](const char* which) {
    const json& c = info["bounds"][which];
    return fmt::format("({:g}, {:g}, {:g})", c[0].get<double>(), c[1].get<double>(),
                       c[2].get<double>());
  };
  line("bounds", corner("low") + " to " + corner("high"));
  line("boundary faces", number(info["boundary_faces"]));
  line("components", number(info["components"]));
  line("memory", fmt::format("{} bytes as walkable {}", number(info["memory_bytes"]),
                             info["form"].get<std::string>()));
  for (const json& field : info["fields"]) {
    std::string text = fmt::format("{} ({} data", field["name"].get<std::string>(),
                                   field["association"].get<std::string>());
    const int components = field["components"];
    if (components > 1) text += fmt::format(", {} components", components);
    text += fmt::format("): {}{:g} to {:g}", components > 1 ? "magnitude " : "",
                        field["range"][0].get<double>(), field["range"][1].get<double>());
    if (field["not_finite"] > 0)
      text += fmt::format(", {} not finite", number(field["not_finite"]));
    if (field["name"] == info["active_field"]) text += ", active";
    line("field", text);
  }
  for (const json& problem : info["problems"]) line("found", problem.get<std::string>());
}

void run(const InfoArguments& args) {
  ReadOptions options;
  options.solution = args.solution;
  options.merge_points = args.merge_points;
  std::vector<std::string> notices;
  const Notice notice = [&](const std::string& line) { notices.push_back(line); };
  TimeSeries series(args.mesh, options, notice);
  const std::vector<std::size_t> steps = parse_steps(args.time, series, args.mesh);
  if (steps.size() != 1)
    throw Error(fmt::format("--time '{}': info is of one step; give its number", args.time));
  const auto [mesh, time] = series.read(steps[0], notice);
  json info;
  try {
    info = describe_mesh(mesh, std::move(notices));
  } catch (const Error& error) {
    throw Error(args.mesh + ": " + error.what());
  }
  if (series.size() > 1) {
    info["step"] = steps[0];
    info["times"] = json::array();
    for (std::size_t step = 0; step < series.size(); ++step) {
      const auto known = step == steps[0] ? time : series.time(step);
      info["times"].push_back(known ? json(*known) : json());
    }
  }
  if (args.as_json)
    std::cout << info.dump(2) << '\n';
  else
    print(args.mesh, info);
}

}  // namespace

void add_info(CLI::App& app) {
  auto args = std::make_shared<InfoArguments>();
  CLI::App* command = app.add_subcommand("info", "Say what is in a mesh file");
  command->add_option("mesh", args->mesh, "The mesh file")->required();
  command->add_option("--solution", args->solution, "Plot3D: the q file of the grid");
  command->add_option("--time,--time-step", args->time,
                      "Which step of several: last, or a number from 0 (last)");
  command->add_flag("--merge-points", args->merge_points,
                    "Merge coincident points of neighbouring blocks");
  command->add_flag("--json", args->as_json, "Print one JSON object");
  command->callback([args] { run(*args); });
}

}  // namespace plume::command
