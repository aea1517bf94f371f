/// What the families share: grids of points in a box, random displacements, fields.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/mesh/explicit_cells.h"

namespace plume::datasets {

using Point = std::array<double, 3>;

/// A number in [-1, 1), a function of its arguments alone and the same on every machine: one step
/// of splitmix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
double random_offset(std::uint64_t seed, std::uint64_t item, int axis);

/// A box cut into cells[0] x cells[1] x cells[2] cuboids; point (i, j, k) comes i fastest.
struct Box {
  std::array<int, 3> cells{1, 1, 1};
  Point low{0, 0, 0};
  Point high{1, 1, 1};

  static Box unit(int size) { return {{size, size, size}, {0, 0, 0}, {1, 1, 1}}; }

  std::size_t point_count() const {
    return (static_cast<std::size_t>(cells[0]) + 1) * (static_cast<std::size_t>(cells[1]) + 1) *
           (static_cast<std::size_t>(cells[2]) + 1);
  }
  std::int32_t point(int i, int j, int k) const {
    return i + (cells[0] + 1) * (j + (cells[1] + 1) * k);
  }
  /// The eight corners of a cuboid in VTK's order for a hexahedron.
  std::array<std::int32_t, 8> corners(int i, int j, int k) const {
    return {point(i, j, k),
            point(i + 1, j, k),
            point(i + 1, j + 1, k),
            point(i, j + 1, k),
            point(i, j, k + 1),
            point(i + 1, j, k + 1),
            point(i + 1, j + 1, k + 1),
            point(i, j + 1, k + 1)};
  }
};

/// size, or the default where it is 0.
inline int size_or(const GenerateOptions& options, int otherwise) {
  return options.size > 0 ? options.size : otherwise;
}

/// Throws Error where so many points cannot be numbered with 32 bits.
void require_int32_ids(double point_count, int size);

/// The box's points: those inside displaced by up to `jitter` edges along each axis and clamped
/// into the box, those on its boundary exactly on it. Appends x, y, z to `points`.
void append_box_points(const Box& box, double jitter, std::uint64_t seed,
                       std::vector<float>& points);

/// The unit cube's points, size + 1 along each edge. Throws Error where 32-bit ids do not suffice.
std::vector<float> unit_box_points(int size, const GenerateOptions& options);

/// Calls f(i, j, k) for each cuboid of the box, i fastest.
template <class F>
void for_each_cuboid(const Box& box, F&& f) {
  for (int k = 0; k < box.cells[2]; ++k) {
    for (int j = 0; j < box.cells[1]; ++j) {
      for (int i = 0; i < box.cells[0]; ++i) f(i, j, k);
    }
  }
}

/// Appends the six tetrahedra of a cuboid around its diagonal 0-6, given its corners.
void append_kuhn_tetrahedra(const std::array<std::int32_t, 8>& corners,
                            std::vector<std::int32_t>& connectivity);

/// Appends the two wedges of a cuboid, cut along its corners' diagonals 0-2 and 4-6.
void append_wedges(const std::array<std::int32_t, 8>& corners,
                   std::vector<std::int32_t>& connectivity);

/// Adds a point field whose value is f(x, y, z), in single precision.
template <class F>
void add_point_field(Mesh& mesh, std::string name, F&& f) {
  std::vector<float> values(mesh.point_count());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(f(point_at(mesh, i)));
  mesh.fields.push_back({std::move(name), Association::point, 1, Array::own(std::move(values))});
}

inline double distance(const Point& a, const Point& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]));
}

/// Adds `linear`, `radius` (distance to `center`) and `waves`; `radius` becomes the active field.
void add_box_fields(Mesh& mesh, const Point& center = {0.5, 0.5, 0.5});

/// Adds the cell field `cell_radius`: distance of the mean of the cell's points to (1/2, 1/2, 1/2).
/// For a curvilinear grid, or for explicit cells of one type with a fixed number of points and
/// 32-bit ids.
void add_cell_radius(Mesh& mesh);

/// Cells of one type with a fixed number of points.
Cells cells_of(CellType type, std::vector<std::int32_t> connectivity);

}  // namespace plume::datasets
