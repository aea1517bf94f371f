#include "cell_soup.h"

#include <algorithm>
#include <map>

#include "plume/mesh/explicit_cells.h"
#include "plume/mesh/local_frame.h"
#include "plume/mesh/validate.h"

namespace plume::atlas {

CellSoup::CellSoup(const Mesh& mesh) {
  const Bounds bounds = check_structure(mesh);
  for (std::size_t a = 0; a < 3; ++a) size = std::max(size, bounds.high[a] - bounds.low[a]);
  const Field& field = mesh.fields.front();
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    points.push_back(point_at(mesh, p));
    scalars.push_back(field.values.at<double>(p));
  }
  const CellReader reader(mesh);
  cells.resize(reader.size());
  std::map<std::vector<std::uint32_t>, BoundaryTriangle> open;  // faces that wait for a neighbour
  std::vector<std::uint32_t> sizes, ids;
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    if (reader.hidden(c)) continue;
    Cell& cell = cells[c];
    reader.points(c, ids);
    cell.tetrahedron = reader.type(c) == CellType::tetrahedron;
    only_tetrahedra = only_tetrahedra && cell.tetrahedron;
    if (cell.tetrahedron) std::copy_n(ids.begin(), 4, cell.corners.begin());
    for (const std::uint32_t id : ids)
      for (std::size_t a = 0; a < 3; ++a)
        cell.center[a] += points[id][a] / static_cast<double>(ids.size());
    reader.faces(c, sizes, ids);
    std::size_t first = 0;
    for (const std::uint32_t size_of_face : sizes) {
      std::vector<std::uint32_t> loop(
          ids.begin() + static_cast<std::ptrdiff_t>(first),
          ids.begin() + static_cast<std::ptrdiff_t>(first) + size_of_face);
      first += size_of_face;
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      const auto begin = static_cast<std::uint32_t>(cell.triangles.size());
      for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        cell.triangles.push_back({{loop[0], loop[i], loop[i + 1]}, kNobody});
      std::sort(loop.begin(), loop.end());
      const auto [place, is_new] = open.try_emplace(loop, BoundaryTriangle{c, begin});
      if (is_new) continue;
      const auto [other, other_begin] = place->second;
      for (std::size_t i = 0; i + 2 < loop.size(); ++i) {
        cell.triangles[begin + i].neighbor = other;
        cells[other].triangles[other_begin + i].neighbor = c;
      }
      open.erase(place);
    }
  }
  for (std::uint32_t c = 0; c < cells.size(); ++c)
    for (std::uint32_t t = 0; t < cells[c].triangles.size(); ++t)
      if (cells[c].triangles[t].neighbor == kNobody) boundary.push_back({c, t});
}

}  // namespace plume::atlas
