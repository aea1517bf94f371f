#include "plume/mesh/explicit_cells.h"

#include <algorithm>

#include "plume/mesh/cell_faces.h"

namespace plume {

CellReader::CellReader(const Mesh& mesh) : mesh_(mesh), size_(mesh.cell_count()) {}

CellType CellReader::type(std::size_t cell) const {
  if (mesh_.is_grid()) return CellType::hexahedron;
  const Array& types = mesh_.cells.types;
  return static_cast<CellType>(types.at<int>(types.size() == 1 ? 0 : cell));
}

bool CellReader::hidden(std::size_t cell) const {
  return !mesh_.hidden_cells.empty() && mesh_.hidden_cells.at<int>(cell) != 0;
}

std::uint32_t CellReader::id(std::size_t i) const {
  return mesh_.cells.connectivity.at<std::uint32_t>(i);
}

void CellReader::points(std::size_t cell, std::vector<std::uint32_t>& ids) const {
  ids.clear();
  if (mesh_.is_grid()) {
    const auto ni = static_cast<std::size_t>(mesh_.dimensions[0]);
    const auto nj = static_cast<std::size_t>(mesh_.dimensions[1]);
    const std::size_t i = cell % (ni - 1);
    const std::size_t j = cell / (ni - 1) % (nj - 1);
    const std::size_t k = cell / (ni - 1) / (nj - 1);
    const std::size_t base = i + ni * (j + nj * k);
    for (const std::size_t step : {std::size_t{0}, std::size_t{1}, 1 + ni, ni, ni * nj, 1 + ni * nj,
                                   1 + ni + ni * nj, ni + ni * nj})
      ids.push_back(static_cast<std::uint32_t>(base + step));
    return;
  }
  const CellType t = type(cell);
  std::size_t begin, end;
  if (mesh_.cells.offsets.empty()) {
    const auto count = static_cast<std::size_t>(points_per_cell(t));
    begin = cell * count;
    end = begin + count;
  } else {
    begin = mesh_.cells.offsets.at<std::size_t>(cell);
    end = mesh_.cells.offsets.at<std::size_t>(cell + 1);
  }
  for (std::size_t i = begin; i < end; ++i) ids.push_back(id(i));
}

void CellReader::faces(std::size_t cell, std::vector<std::uint32_t>& sizes,
                       std::vector<std::uint32_t>& ids) const {
  sizes.clear();
  ids.clear();
  const CellType t = type(cell);
  if (t == CellType::polyhedron) {
    const Array& stream = mesh_.cells.polyhedron_faces;
    std::size_t at = mesh_.cells.polyhedron_locations.at<std::size_t>(cell);
    const auto count = stream.at<std::size_t>(at++);
    for (std::size_t f = 0; f < count; ++f) {
      const auto size = stream.at<std::uint32_t>(at++);
      sizes.push_back(size);
      for (std::uint32_t p = 0; p < size; ++p) ids.push_back(stream.at<std::uint32_t>(at++));
    }
    return;
  }
  std::vector<std::uint32_t> corner;
  points(cell, corner);
  for (const FaceLoop& loop : faces_of(t)) {
    sizes.push_back(static_cast<std::uint32_t>(loop.size));
    for (int p = 0; p < loop.size; ++p)
      ids.push_back(corner[static_cast<std::size_t>(loop.points[static_cast<std::size_t>(p)])]);
  }
}

std::array<double, 3> point_at(const Mesh& mesh, std::size_t point) {
  if (mesh.is_rectilinear()) {
    const auto ni = static_cast<std::size_t>(mesh.dimensions[0]);
    const auto nj = static_cast<std::size_t>(mesh.dimensions[1]);
    return {mesh.axes[0].at<double>(point % ni), mesh.axes[1].at<double>(point / ni % nj),
            mesh.axes[2].at<double>(point / ni / nj)};
  }
  return mesh.points.visit([point](auto values) {
    return std::array<double, 3>{static_cast<double>(values[3 * point]),
                                 static_cast<double>(values[3 * point + 1]),
                                 static_cast<double>(values[3 * point + 2])};
  });
}

double signed_volume(const Mesh& mesh, std::span<const std::uint32_t> sizes,
                     std::span<const std::uint32_t> ids) {
  if (ids.empty()) return 0;
  const auto origin = point_at(mesh, ids[0]);
  auto from_origin = [&](std::uint32_t id) {
    auto p = point_at(mesh, id);
    for (std::size_t a = 0; a < 3; ++a) p[a] -= origin[a];
    return p;
  };
  double six_volumes = 0;
  std::size_t at = 0;
  for (const std::uint32_t size : sizes) {
    for (std::uint32_t i = 1; i + 1 < size; ++i) {
      const auto a = from_origin(ids[at]);
      const auto b = from_origin(ids[at + i]);
      const auto c = from_origin(ids[at + i + 1]);
      six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                     a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    at += size;
  }
  return six_volumes / 6;
}

}  // namespace plume
