#include "plume/mesh/mesh.h"

#include "plume/mesh/error.h"

namespace plume {

int points_per_cell(CellType type) {
  switch (type) {
    case CellType::tetrahedron:
      return 4;
    case CellType::voxel:
      return 8;
    case CellType::hexahedron:
      return 8;
    case CellType::wedge:
      return 6;
    case CellType::pyramid:
      return 5;
    case CellType::pentagonal_prism:
      return 10;
    case CellType::hexagonal_prism:
      return 12;
    case CellType::polyhedron:
      break;
  }
  return 0;
}

const char* cell_type_name(CellType type) {
  switch (type) {
    case CellType::tetrahedron:
      return "tetrahedron";
    case CellType::voxel:
      return "voxel";
    case CellType::hexahedron:
      return "hexahedron";
    case CellType::wedge:
      return "wedge";
    case CellType::pyramid:
      return "pyramid";
    case CellType::pentagonal_prism:
      return "pentagonal prism";
    case CellType::hexagonal_prism:
      return "hexagonal prism";
    case CellType::polyhedron:
      break;
  }
  return "polyhedron";
}

bool is_volume_cell_type(int vtk_type) {
  return (vtk_type >= 10 && vtk_type <= 16) || vtk_type == 42;
}

std::size_t Mesh::point_count() const {
  if (!is_rectilinear()) return points.size() / 3;
  std::size_t count = 1;
  for (const auto n : dimensions) count *= n > 0 ? static_cast<std::size_t>(n) : 0;
  return count;
}

std::size_t Mesh::cell_count() const {
  if (is_grid()) {
    std::size_t count = 1;
    for (const auto n : dimensions) count *= n > 1 ? static_cast<std::size_t>(n - 1) : 0;
    return count;
  }
  if (!cells.offsets.empty()) return cells.offsets.size() - 1;
  if (cells.types.empty()) return 0;
  const int corners = points_per_cell(static_cast<CellType>(cells.types.at<int>(0)));
  return corners > 0 ? cells.connectivity.size() / static_cast<std::size_t>(corners) : 0;
}

}  // namespace plume
