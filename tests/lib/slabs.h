/// Meshes that rays leave and enter again.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/mesh/explicit_cells.h"

namespace plume::test {

/// A generated box of which every second slab is taken away: rays leave and enter again.
inline Mesh slabs(const std::string& name) {
  Mesh mesh = generate(name, {8, 0.0, 2});
  if (mesh.is_grid()) {
    std::vector<std::uint8_t> hidden;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) hidden.push_back(c % 2 == 1);
    mesh.hidden_cells = Array::own(std::move(hidden));
    return mesh;
  }
  const CellReader cells(mesh);
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int64_t> kept, locations;
  std::vector<std::uint32_t> ids;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    cells.points(c, ids);
    double x = 0;
    for (const std::uint32_t id : ids) x += point_at(mesh, id)[0] / static_cast<double>(ids.size());
    if (static_cast<int>(x * 8) % 2 == 1) continue;
    types.push_back(static_cast<std::uint8_t>(cells.type(c)));
    kept.insert(kept.end(), ids.begin(), ids.end());
    offsets.push_back(static_cast<std::int64_t>(kept.size()));
    if (cells.type(c) == CellType::polyhedron)
      locations.push_back(mesh.cells.polyhedron_locations.at<std::int64_t>(c));
  }
  mesh.cells.types = Array::own(std::move(types));
  mesh.cells.offsets = Array::own(std::move(offsets));
  mesh.cells.connectivity = Array::own(std::move(kept));
  if (!locations.empty()) mesh.cells.polyhedron_locations = Array::own(std::move(locations));
  std::erase_if(mesh.fields, [](const Field& f) { return f.association == Association::cell; });
  return mesh;
}

}  // namespace plume::test
