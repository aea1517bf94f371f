/// The faces of a mesh's cells as the oracle of line lengths takes them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plume/mesh/explicit_cells.h"
#include "plume/tests/reference/line_lengths.h"
#include "plume/tests/traverse/mesh_spots.h"

namespace plume::test {

/// The faces of all cells, quadrilaterals as they are; none of hidden cells.
inline std::vector<reference::CellLoops> loops_of(const Mesh& mesh) {
  const CellReader reader(mesh);
  std::vector<reference::CellLoops> cells(reader.size());
  std::vector<std::uint32_t> sizes, ids;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (reader.hidden(c)) continue;
    reader.faces(c, sizes, ids);
    std::size_t at = 0;
    for (const std::uint32_t size : sizes) {
      auto& loop = cells[c].emplace_back();
      for (std::uint32_t i = 0; i < size; ++i) loop.push_back(point_at(mesh, ids[at++]));
    }
  }
  return cells;
}

/// The faces of a grid's visible cells cut into triangles, from the corner of lowest index to the
/// opposite.
inline std::vector<reference::CellLoops> triangles_of(const Mesh& mesh) {
  std::vector<reference::CellLoops> cells(mesh.cell_count());
  const CellReader reader(mesh);
  const auto [ni, nj, nk] = mesh.dimensions;
  std::size_t cell = 0;
  for (std::int64_t k = 0; k + 1 < nk; ++k)
    for (std::int64_t j = 0; j + 1 < nj; ++j)
      for (std::int64_t i = 0; i + 1 < ni; ++i, ++cell)
        for (int axis = 0; axis < 3 && !reader.hidden(cell); ++axis)
          for (int side = 0; side < 2; ++side) {
            auto corner = [&](int b, int c) {
              std::array<std::int64_t, 3> at{i, j, k};
              at[static_cast<std::size_t>(axis)] += side;
              at[static_cast<std::size_t>((axis + 1) % 3)] += b;
              at[static_cast<std::size_t>((axis + 2) % 3)] += c;
              return point_at(mesh, static_cast<std::size_t>(at[0] + ni * (at[1] + nj * at[2])));
            };
            const Place p = corner(0, 0), r = corner(1, 1);
            const Place q = side == 1 ? corner(1, 0) : corner(0, 1);
            const Place s = side == 1 ? corner(0, 1) : corner(1, 0);
            cells[cell].push_back({p, q, r});
            cells[cell].push_back({p, r, s});
          }
  return cells;
}

}  // namespace plume::test
