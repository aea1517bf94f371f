#include "plume/tests/bench/papers/thesis_meshes.h"

#include <fmt/format.h>

#include "plume/tests/bench/papers/stand_in_fields.h"

namespace plume::bench {
namespace {

const MeshSource& source_named(Family family, const std::string& name) {
  for (const MeshSource& source : mesh_sources(family))
    if (source.name == name) return source;
  return mesh_sources(family).front();
}

}  // namespace

std::vector<ThesisMesh> thesis_meshes(Family family, bool quick) {
  if (family == Family::hexahedra)
    return {{"Blunt-fin", family, 40960,
             "the same grid of 40 x 32 x 32 points, the density of NASA's data set",
             source_named(family, "blunt-fin").load},
            {"Combustion", family, 47025,
             "the same grid of 57 x 33 x 25 points, the density of VTK's data set",
             source_named(family, "combustor").load}};
  const auto box = [quick](StandInField field, int size) {
    return [=]() -> std::optional<Mesh> { return stand_in_tetrahedra(field, quick ? 6 : size); };
  };
  return {
      {"Blunt-fin", family, 224874, "the same grid, each hexahedron in six tetrahedra",
       source_named(Family::tetrahedra, "blunt-fin").load},
      {"Orbital*", family, 148955,
       "stand-in: hydrogen's 3d orbital on a jittered box of 29^3 cells in six tetrahedra each",
       box(orbital_field, 29)},
      {"Bucky-ball*", family, 176856,
       "stand-in: 60 atoms of a Gaussian each on a jittered box of 31^3 cells in six tetrahedra "
       "each",
       box(bucky_ball_field, 31)}};
}

std::string with_commas(std::size_t number) {
  if (number < 1000) return fmt::format("{}", number);
  return fmt::format("{},{:03}", with_commas(number / 1000), number % 1000);
}

std::vector<std::string> without_data(std::vector<std::string> row, std::size_t columns) {
  if (!row[0].empty()) row[0] += " (absent)";
  row.resize(columns, "-");
  return row;
}

}  // namespace plume::bench
