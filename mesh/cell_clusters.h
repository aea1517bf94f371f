/// Boxes and ranges of the scalar over clusters of cells that are not tetrahedra.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "plume/mesh/cluster_tree.h"
#include "plume/mesh/corner_cells.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"

namespace plume {

/// Cells of a leaf, at the most, and faces at the boundary of one.
inline constexpr std::size_t kClusterSize = 16;
/// Cells along the edges of a grid's leaf.
inline constexpr std::array<std::uint32_t, 3> kGridBlock{4, 2, 2};

/// As CellHierarchy, of a grid (whose leaves are blocks of it) or of cells of any kind (consecutive
/// ones): boxes, ranges, and which cells a ray might not leave behind where it came in. 2.5 to 2.8
/// bytes a cell, and 6.3 a face at the boundary of a grid, 2.3 of one of other cells.
///
/// Of the mesh alone: an isovalue changes nothing in it.
struct CellClusters {
  /// Boxes hold all points of their cells, and so the bilinear patches and the fans between them;
  /// ranges all scalars that are measured on these (widened()). Crooked cells are special.
  ClusterTree cells;
  /// Boxes alone: their ranges mean nothing.
  ClusterTree boundary;
  /// One bit a cell of each leaf. See is_crooked().
  std::vector<std::uint16_t> crooked;
  /// Of a grid: the number of the block that each leaf is. Else empty.
  std::vector<std::uint32_t> blocks;
  /// Of a grid: the faces at the boundary in the order of their leaves, as numbers in the mesh's
  /// list. Else empty: they are in that list's order.
  std::vector<std::uint32_t> faces;

  std::size_t leaf_count() const { return crooked.size(); }
  std::size_t bytes() const {
    return cells.bytes() + boundary.bytes() + crooked.size() * sizeof(std::uint16_t) +
           (blocks.size() + faces.size()) * sizeof(std::uint32_t);
  }
  /// The number in the mesh's list of a face of a leaf of `boundary`.
  std::uint32_t face(std::size_t leaf, std::size_t place) const {
    const std::size_t at = kClusterSize * leaf + place;
    return faces.empty() ? static_cast<std::uint32_t>(at) : faces[at];
  }

  /// Cells of a leaf; the first `size` of them.
  struct Cells {
    std::array<std::uint32_t, kClusterSize> cell;
    std::size_t size = 0;
  };
  Cells cells_of(const WalkableGrid& mesh, std::size_t leaf) const;
  Cells cells_of(const WalkableCells& mesh, std::size_t leaf) const;

  /// Scalars on a cell's faces are sums of those at its points whose weights are not negative and
  /// sum to 1, rounded to a float; the centre of a polygon is summed in single precision.
  static void widen(float& least, float& greatest) {
    const float size = std::max(std::abs(least), std::abs(greatest));
    if (!(least <= greatest)) return;
    const float margin = std::max(0x1p-19f * size, 2 * std::numeric_limits<float>::denorm_min());
    least -= margin;
    greatest += margin;
  }
};

/// Calls visit(point number) for the points of a cell; several times for some.
template <class Visit>
void for_each_point_of(const WalkableGrid& mesh, std::uint32_t cell, const Visit& visit) {
  const std::uint32_t first = mesh.first_point(cell), row = mesh.dimensions[0];
  const std::uint32_t plane = row * mesh.dimensions[1];
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    visit(first + (corner & 1) + (corner >> 1 & 1) * row + (corner >> 2) * plane);
}
template <class Visit>
void for_each_point_of(const WalkableCells& mesh, std::uint32_t cell, const Visit& visit) {
  for (const std::uint32_t face : mesh.faces_of(cell))
    for (const std::uint32_t point : mesh.loop(face)) visit(point);
}

/// The same for the points of a face at the boundary.
template <class Visit>
void for_each_point_of(const WalkableGrid& mesh, const BoundaryFace& face, const Visit& visit) {
  const std::uint32_t first = mesh.first_point(face.cell), row = mesh.dimensions[0];
  const std::uint32_t plane = row * mesh.dimensions[1];
  for (const std::uint32_t corner : kCornerLoop[face.face])
    visit(first + (corner & 1) + (corner >> 1 & 1) * row + (corner >> 2) * plane);
}
template <class Visit>
void for_each_point_of(const WalkableCells& mesh, const BoundaryFace& face, const Visit& visit) {
  for (const std::uint32_t point : mesh.loop(face.face)) visit(point);
}

/// In parallel.
CellClusters make_cell_clusters(const WalkableGrid& mesh);
CellClusters make_cell_clusters(const WalkableCells& mesh);

}  // namespace plume
