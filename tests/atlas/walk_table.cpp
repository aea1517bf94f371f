#include "walk_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "old_methods.h"
#include "our_walks.h"
#include "vtk_samples.h"

namespace plume::atlas {
namespace {

template <class Of>
std::vector<std::string> in_order(const std::vector<WalkRow>& rows, const Of& of) {
  std::vector<std::string> names;
  for (const WalkRow& row : rows)
    if (const std::string name = of(row);
        !name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  return names;
}

std::string counts(const Tally& t, bool knows_cells) {
  return fmt::format("{} | {} | {} | {} | {} | {} | {} | {}", t.rays, t.lost, t.looping, t.gaps,
                     t.overlaps, knows_cells ? std::to_string(t.wrong_cells) : "-",
                     shown_error(t.chord_error), knows_cells ? shown_error(t.integral_error) : "-");
}

constexpr const char* kColumns =
    "rays | lost | looping | gaps | overlaps | wrong cells | chord error | integral error |\n";

}  // namespace

std::vector<WalkRow> run_walks() {
  std::vector<WalkRow> rows;
  for (const AtlasScene& scene : atlas_scenes())
    for (const SceneMesh& mesh : scene.meshes) {
      const Judge judge(mesh, scene.oracle);
      auto add = [&](const MethodWalks& walks) {
        rows.push_back({scene.group, scene.name, mesh.cells, walks.method, walks.ours,
                        walks.promised, judge.knows_cells(), judge(walks)});
      };
      for (const MethodWalks& walks : our_walks(mesh)) add(walks);
      // Grids are hexahedra to old methods; VTK has a locator of its own for rectilinear ones, and
      // looks for points in polyhedra by a way of its own that takes minutes.
      const bool grid = mesh.cells == "rectilinear" || mesh.cells == "grid";
      if (!grid)
        for (const MethodWalks& walks : old_walks(mesh)) add(walks);
      if (!grid && mesh.cells != "polyhedra") add(vtk_walks(mesh));
    }
  return rows;
}

std::string shown_error(double error) {
  if (error == 0) return "0";
  if (!std::isfinite(error)) return "not a number";
  return fmt::format("1e{}", static_cast<int>(std::ceil(std::log10(error))));
}

std::string walker_table(const std::vector<WalkRow>& rows) {
  std::string table =
      fmt::format("| walker | scenes | {}|---|---|---|---|---|---|---|---|---|---|\n", kColumns);
  for (const std::string& name :
       in_order(rows, [](const WalkRow& r) { return r.ours ? r.method : std::string(); })) {
    Tally sum;
    std::vector<std::string> scenes;
    for (const WalkRow& row : rows) {
      if (row.method != name) continue;
      sum.add(row.tally);
      if (std::find(scenes.begin(), scenes.end(), row.scene) == scenes.end())
        scenes.push_back(row.scene);
    }
    table += fmt::format("| {} | {} | {} |\n", name, scenes.size(), counts(sum, true));
  }
  return table;
}

std::string scene_table(const std::vector<WalkRow>& rows) {
  const auto old =
      in_order(rows, [](const WalkRow& r) { return r.ours ? std::string() : r.method; });
  std::string table = "| | scene | Plume |", rule = "|---|---|---|";
  for (const std::string& name : old) {
    table += fmt::format(" {} |", name);
    rule += "---|";
  }
  table += fmt::format("\n{}\n", rule);
  std::string group;
  for (const std::string& name : in_order(rows, [](const WalkRow& r) { return r.scene; })) {
    std::map<std::string, Tally> by;
    std::string of_group;
    for (const WalkRow& row : rows) {
      if (row.scene != name) continue;
      of_group = row.group;
      if (!row.ours)
        by[row.method].add(row.tally);
      else if (row.promised)
        by["Plume"].add(row.tally);
    }
    auto shown = [&](const std::string& method) {
      const auto found = by.find(method);
      return found == by.end() ? std::string("")
                               : fmt::format("{} of {}", found->second.failed, found->second.rays);
    };
    table +=
        fmt::format("| {} | {} | {} |", of_group == group ? "" : of_group, name, shown("Plume"));
    group = of_group;
    for (const std::string& method : old) table += fmt::format(" {} |", shown(method));
    table += "\n";
  }
  return table;
}

std::string full_table(const std::vector<WalkRow>& rows) {
  std::string table = fmt::format(
      "| scene | mesh | method | {}|---|---|---|---|---|---|---|---|---|---|---|\n", kColumns);
  std::string scene, cells;
  for (const WalkRow& row : rows) {
    const bool new_scene = row.scene != scene;
    table += fmt::format("| {} | {} | {} | {} |\n", new_scene ? row.scene : "",
                         new_scene || row.cells != cells ? row.cells : "", row.method,
                         counts(row.tally, row.knows_cells));
    scene = row.scene;
    cells = row.cells;
  }
  return table;
}

std::vector<std::string> problems_of(const std::vector<WalkRow>& rows) {
  std::vector<std::string> problems;
  std::map<std::string, std::uint64_t> old_failures, our_rays;
  Tally of_others;
  for (const WalkRow& row : rows) {
    if (!row.ours) {
      old_failures[row.method] += row.tally.failed;
      of_others.add(row.tally);
      continue;
    }
    our_rays[row.method] += row.tally.rays;
    // A surface that is there to compare with promises no more than that no ray is lost.
    const Tally& t = row.tally;
    const std::uint64_t failures = row.promised ? t.failed : t.lost + t.looping + t.gaps;
    if (failures > 0)
      problems.push_back(fmt::format("{} on '{}', {}: {}", row.method, row.scene, row.cells,
                                     counts(t, row.knows_cells)));
  }
  for (const auto& [method, rays] : our_rays)
    if (rays == 0) problems.push_back(method + " walked no ray");
  for (const auto& [method, failures] : old_failures)
    if (failures == 0)
      problems.push_back(method + " fails nowhere: the scenes are too easy to tell methods apart");
  const Tally& t = of_others;
  if (t.lost == 0 || t.looping == 0 || t.gaps == 0 || t.overlaps == 0 || t.wrong_cells == 0)
    problems.push_back("a column that is zero for everyone shows nothing: " + counts(t, true));
  return problems;
}

}  // namespace plume::atlas
