#include "plume/tests/bench/result_table.h"

#include <fmt/format.h>

#include <array>

namespace plume::bench {
namespace {

std::string with_commas(std::size_t number) {
  if (number < 1000) return fmt::format("{}", number);
  return fmt::format("{},{:03}", with_commas(number / 1000), number % 1000);
}

std::string table_of(Family family, const std::vector<WalkerResult>& results) {
  const bool grids = family == Family::hexahedra;
  std::string text = fmt::format(
      "\n{}, one thread, first hits not included; medians, mean of four views.\nViews, "
      "rounds: range of the ratio from one to the next.\n\n",
      grids ? "Hexahedra" : "Tetrahedra");
  text += fmt::format("{:<21}{:>12}  {:<13}{:<13}{:>10}{:>9}{:>12}{:>11}{:>14}{:>14}{:>9}\n",
                      "mesh", "cells", "mode", "walker", "M cells/s", "ns/cell",
                      grids ? "bytes/point" : "bytes/cell", grids ? "x hybrid" : "x Plücker",
                      "views", "rounds", "x walk");
  auto range = [](const std::array<double, 2>& of) {
    return fmt::format("{:.2f}-{:.2f}", of[0], of[1]);
  };
  const WalkerResult* previous = nullptr;
  for (const WalkerResult& r : results) {
    if (r.family != family) continue;
    const bool new_mesh = !previous || previous->mesh != r.mesh;
    const bool new_mode = new_mesh || previous->mode != r.mode;
    if (new_mesh && previous) text += "\n";
    text += fmt::format(
        "{:<21}{:>12}  {:<13}{:<13}{:>10.1f}{:>9.2f}{:>12.2f}{:>11.2f}{:>14}{:>14}{:>9.2f}\n",
        new_mesh ? r.mesh : "", new_mesh ? with_commas(r.mesh_cells) : "",
        new_mode ? mode_name(r.mode) : "", r.walker, r.million_cells_per_second,
        1e3 / r.million_cells_per_second, grids ? r.bytes_per_point : r.bytes_per_cell, r.ratio,
        range(r.ratio_of_views), range(r.ratio_of_rounds), r.ratio_to_walk);
    previous = &r;
  }
  if (!previous) return {};
  return text;
}

}  // namespace

std::string result_table(const std::vector<WalkerResult>& results) {
  return table_of(Family::tetrahedra, results) + table_of(Family::hexahedra, results);
}

std::string cells_table(const std::vector<CellsResult>& results) {
  if (results.empty()) return {};
  std::string text =
      "\nThe unit cube in cells of one kind, one thread, first hits not included; medians, four "
      "views.\nns/face: time by the number of faces of the cells that are met, against a "
      "tetrahedron's "
      "by the\nscalar walker and by packets. A cell's time is that of a face that is crossed; x "
      "crossed: against\na tetrahedron's by packets.\n\n";
  text += fmt::format("{:<16}{:>9}  {:<10}{:<13}{:>9}{:>11}{:>9}{:>9}{:>10}{:>10}{:>12}\n", "mesh",
                      "cells", "mode", "walker", "ns/cell", "faces/cell", "ns/face", "x scalar",
                      "x packets", "x crossed", "bytes/cell");
  for (const CellsResult& r : results)
    text += fmt::format(
        "{:<16}{:>9}  {:<10}{:<13}{:>9.1f}{:>11.2f}{:>9.2f}{:>9.2f}{:>10.1f}{:>10.1f}"
        "{:>12.1f}\n",
        r.mesh, with_commas(r.mesh_cells), mode_name(r.mode), r.walker, r.ns_per_cell,
        r.faces_per_cell, r.ns_per_face, r.to_tet_walker, r.to_tet_packets,
        r.crossed_to_tet_packets, r.bytes_per_cell);
  return text;
}

}  // namespace plume::bench
