#include "plume/tests/bench/result_table.h"

#include <fmt/format.h>

#include <array>

#include "plume/tests/bench/thesis_hexahedra.h"

namespace plume::bench {
namespace {

constexpr const char* kThesis = R"(
What the thesis reports, in million tetrahedra a second (G. Marmitt, "Interactive Volume Ray
Tracing", 2008):

  table 6.1, naive and optimised Plücker walk (3 GHz Athlon64, 2 GB memory)
                tests a cell, M cells/s    tests a cell, M cells/s
    Blunt-fin      4.714        9.346         2.669       17.106
    Orbital        4.976        9.615         2.675       17.101
    Bucky-ball     5.373        9.615         2.663       17.612

  table 6.2 (its caption names no hardware; table 6.5, its counterpart for hexahedra, is from the
  same 3 GHz Athlon64, tables 6.3 and 6.4 from 2 GHz Opteron 870)
                 tetrahedra   traversal   iso-surface   semi-transparent
    Blunt-fin      224,874      11.175        5.394          4.189
    Orbital        148,955      10.568        5.379          4.020
    Bucky-ball     176,856      10.514        5.237          4.049

Ratios between its hardware and this are no measure of the method: compare with the column
"x Plücker", the same algorithm written anew and measured here, in the same run.
)";

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
  return text + (grids ? thesis_hexahedra(results) : kThesis);
}

}  // namespace

std::string result_table(const std::vector<WalkerResult>& results) {
  return table_of(Family::tetrahedra, results) + table_of(Family::hexahedra, results);
}

std::string cells_table(const std::vector<CellsResult>& results) {
  if (results.empty()) return {};
  std::string text =
      "\nThe unit cube in cells of one kind, one thread, first hits not included; medians, four "
      "views.\nns/face: time by the number of faces of the cells that are met.\n\n";
  text += fmt::format("{:<16}{:>9}  {:<10}{:<13}{:>9}{:>11}{:>9}{:>9}{:>10}{:>12}\n", "mesh",
                      "cells", "mode", "walker", "ns/cell", "faces/cell", "ns/face", "x scalar",
                      "x packets", "bytes/cell");
  for (const CellsResult& r : results)
    text += fmt::format(
        "{:<16}{:>9}  {:<10}{:<13}{:>9.1f}{:>11.2f}{:>9.2f}{:>9.2f}{:>10.1f}"
        "{:>12.1f}\n",
        r.mesh, with_commas(r.mesh_cells), mode_name(r.mode), r.walker, r.ns_per_cell,
        r.faces_per_cell, r.ns_per_face, r.to_tet_walker, r.to_tet_packets, r.bytes_per_cell);
  return text;
}

}  // namespace plume::bench
