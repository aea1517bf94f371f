/// Measures of small meshes, slow and straight from the definitions: for tests.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume::measures {

using Vector = std::array<double, 3>;

inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double determinant(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// A cell as lists of point ids: its points and its faces, their normals outwards.
struct Cell {
  CellType type = CellType::hexahedron;
  std::vector<std::int64_t> points;
  std::vector<std::vector<std::int64_t>> faces;
};

/// VTK's faces, outward normals.
inline const std::vector<std::vector<std::size_t>>& faces_of(CellType type) {
  static const std::map<CellType, std::vector<std::vector<std::size_t>>> all{
      {CellType::tetrahedron, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}}},
      {CellType::hexahedron,
       {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}},
      {CellType::wedge, {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}},
      {CellType::pyramid, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}}};
  return all.at(type);
}

inline std::vector<Cell> cells_of(const Mesh& mesh) {
  std::vector<Cell> cells;
  const auto add = [&](CellType type, std::vector<std::int64_t> points) {
    Cell cell{type, std::move(points), {}};
    for (const auto& face : faces_of(type)) {
      cell.faces.emplace_back();
      for (std::size_t p : face) cell.faces.back().push_back(cell.points[p]);
    }
    cells.push_back(std::move(cell));
  };
  if (mesh.is_grid()) {
    const auto [ni, nj, nk] = mesh.dimensions;
    for (std::int64_t k = 0; k + 1 < nk; ++k) {
      for (std::int64_t j = 0; j + 1 < nj; ++j) {
        for (std::int64_t i = 0; i + 1 < ni; ++i) {
          const std::int64_t p = i + ni * (j + nj * k), q = p + ni * nj;
          add(CellType::hexahedron, {p, p + 1, p + 1 + ni, p + ni, q, q + 1, q + 1 + ni, q + ni});
        }
      }
    }
    return cells;
  }
  const Cells& c = mesh.cells;
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    const auto type = static_cast<CellType>(c.types.at<int>(c.types.size() == 1 ? 0 : i));
    std::size_t first = 0, last = 0;
    if (c.offsets.empty()) {
      const auto n = static_cast<std::size_t>(points_per_cell(type));
      first = i * n;
      last = first + n;
    } else {
      first = c.offsets.at<std::size_t>(i);
      last = c.offsets.at<std::size_t>(i + 1);
    }
    std::vector<std::int64_t> points;
    for (std::size_t at = first; at < last; ++at) {
      points.push_back(c.connectivity.at<std::int64_t>(at));
    }
    if (type != CellType::polyhedron) {
      add(type, std::move(points));
      continue;
    }
    Cell cell{type, std::move(points), {}};
    auto at = c.polyhedron_locations.at<std::size_t>(i);
    const auto faces = c.polyhedron_faces.at<std::size_t>(at++);
    for (std::size_t f = 0; f < faces; ++f) {
      const auto n = c.polyhedron_faces.at<std::size_t>(at++);
      cell.faces.emplace_back();
      for (std::size_t p = 0; p < n; ++p) {
        cell.faces.back().push_back(c.polyhedron_faces.at<std::int64_t>(at++));
      }
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

inline Vector point(const Mesh& mesh, std::int64_t id) {
  if (mesh.is_rectilinear()) {
    Vector p;
    for (std::size_t a = 0; a < 3; ++a) {
      p[a] = mesh.axes[a].at<double>(static_cast<std::size_t>(id % mesh.dimensions[a]));
      id /= mesh.dimensions[a];
    }
    return p;
  }
  const auto i = 3 * static_cast<std::size_t>(id);
  return {mesh.points.at<double>(i), mesh.points.at<double>(i + 1), mesh.points.at<double>(i + 2)};
}

/// Volume within a cell's faces, each fanned around the mean of its points: exact where it is
/// planar, and the same from both sides in any case.
inline double volume(const Mesh& mesh, const Cell& cell) {
  double six = 0;
  const Vector origin = point(mesh, cell.points[0]);
  for (const auto& face : cell.faces) {
    Vector mean{0, 0, 0};
    for (auto id : face) {
      const Vector p = point(mesh, id);
      for (std::size_t a = 0; a < 3; ++a) mean[a] += p[a] / static_cast<double>(face.size());
    }
    for (std::size_t i = 0; i < face.size(); ++i) {
      six += determinant(mean - origin, point(mesh, face[i]) - origin,
                         point(mesh, face[(i + 1) % face.size()]) - origin);
    }
  }
  return six / 6;
}

inline double total_volume(const Mesh& mesh) {
  double sum = 0;
  for (const Cell& cell : cells_of(mesh)) sum += volume(mesh, cell);
  return sum;
}

inline double smallest_volume(const Mesh& mesh) {
  double smallest = 1e300;
  for (const Cell& cell : cells_of(mesh)) smallest = std::min(smallest, volume(mesh, cell));
  return smallest;
}

/// The smallest Jacobian at any corner of any hexahedron.
inline double smallest_jacobian(const Mesh& mesh) {
  // Each corner's neighbours along i, j, k in a right-handed order.
  constexpr std::array<std::array<std::size_t, 4>, 8> corners{{{0, 1, 3, 4},
                                                               {1, 2, 0, 5},
                                                               {2, 3, 1, 6},
                                                               {3, 0, 2, 7},
                                                               {4, 7, 5, 0},
                                                               {5, 4, 6, 1},
                                                               {6, 5, 7, 2},
                                                               {7, 6, 4, 3}}};
  double smallest = 1e300;
  for (const Cell& cell : cells_of(mesh)) {
    for (const auto& c : corners) {
      const Vector p = point(mesh, cell.points[c[0]]);
      smallest = std::min(smallest, determinant(point(mesh, cell.points[c[1]]) - p,
                                                point(mesh, cell.points[c[2]]) - p,
                                                point(mesh, cell.points[c[3]]) - p));
    }
  }
  return smallest;
}

struct FaceCounts {
  std::size_t interior = 0, boundary = 0, mismatched = 0;
};

/// Sorts faces by their sets of points: a face is interior where exactly two cells have it, from
/// opposite sides.
inline FaceCounts count_faces(const Mesh& mesh) {
  std::map<std::vector<std::int64_t>, std::vector<std::vector<std::int64_t>>> shared;
  for (const Cell& cell : cells_of(mesh)) {
    for (const auto& face : cell.faces) {
      auto key = face;
      std::sort(key.begin(), key.end());
      // Start at the smallest id, so that two loops can be compared.
      auto loop = face;
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      shared[key].push_back(loop);
    }
  }
  FaceCounts counts;
  for (const auto& [key, loops] : shared) {
    if (loops.size() == 1) {
      ++counts.boundary;
    } else if (loops.size() == 2) {
      auto reversed = loops[1];
      std::reverse(reversed.begin() + 1, reversed.end());
      ++(reversed == loops[0] ? counts.interior : counts.mismatched);
    } else {
      ++counts.mismatched;
    }
  }
  return counts;
}

/// Area of the boundary: where it equals that of the box, no interior face was taken for boundary.
inline double boundary_area(const Mesh& mesh) {
  std::map<std::vector<std::int64_t>, std::pair<int, double>> areas;
  for (const Cell& cell : cells_of(mesh)) {
    for (const auto& face : cell.faces) {
      Vector normal{0, 0, 0};
      for (std::size_t i = 2; i < face.size(); ++i) {
        const Vector u = point(mesh, face[i - 1]) - point(mesh, face[0]);
        const Vector v = point(mesh, face[i]) - point(mesh, face[0]);
        for (std::size_t a = 0; a < 3; ++a) {
          normal[a] += 0.5 * (u[(a + 1) % 3] * v[(a + 2) % 3] - u[(a + 2) % 3] * v[(a + 1) % 3]);
        }
      }
      auto key = face;
      std::sort(key.begin(), key.end());
      auto& [count, area] = areas[key];
      ++count;
      area = std::hypot(normal[0], normal[1], normal[2]);
    }
  }
  double sum = 0;
  for (const auto& [key, value] : areas) {
    if (value.first == 1) sum += value.second;
  }
  return sum;
}

}  // namespace plume::measures
