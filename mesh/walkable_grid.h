/// A curvilinear grid as a walker reads it: no connectivity at all.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plume/mesh/face_matching.h"
#include "plume/mesh/findings.h"
#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"
#include "plume/mesh/scalar_field.h"

namespace plume {

/// A box of cells by their i, j and k.
struct CellBox {
  std::array<std::uint32_t, 3> first{0, 0, 0}, size{0, 0, 0};

  bool holds(const std::array<std::uint32_t, 3>& index) const {
    return index[0] - first[0] < size[0] && index[1] - first[1] < size[1] &&
           index[2] - first[2] < size[2];
  }
  std::size_t cell_count() const { return std::size_t{size[0]} * size[1] * size[2]; }
};

/// 16 bytes a point and nothing a cell (one bit where cells are hidden). Cell (i, j, k) is
/// i + ci * (j + cj * k) with ci = dimensions[0] - 1 and so on, as in the user's mesh.
struct WalkableGrid {
  LocalFrame frame;
  std::array<std::uint32_t, 3> dimensions{0, 0, 0};  ///< points along i, j, k
  std::vector<WalkablePoint> points;
  /// One value a cell where the field is cell-centred, else empty.
  std::vector<float> cell_values;
  /// One bit a cell where some are hidden, else empty.
  std::vector<bool> hidden;
  /// The whole grid's handedness: i, j, k form a left-handed system.
  bool left_handed = false;
  /// The smallest box of cells that holds both sides of every twisted face: one whose corners are
  /// not within kPlanar / 2 of a plane. Empty where all are planar. Faces between two cells of it
  /// (or at the grid's end) are taken for twisted, which costs time, not precision.
  CellBox twisted;
  /// Every face without a visible cell behind it. Faces are numbered -i, +i, -j, +j, -k, +k.
  std::vector<BoundaryFace> boundary;
  std::vector<Finding> findings;

  std::size_t cell_count() const {
    return static_cast<std::size_t>(dimensions[0] - 1) * (dimensions[1] - 1) * (dimensions[2] - 1);
  }
  std::uint32_t original_cell(std::uint32_t cell) const { return cell; }
  std::size_t bytes() const;

  std::array<std::uint32_t, 3> cell_index(std::uint32_t cell) const {
    const std::uint32_t ci = dimensions[0] - 1, cj = dimensions[1] - 1;
    return {cell % ci, cell / ci % cj, cell / ci / cj};
  }
  /// First point of a cell; corner (a, b, c) of 0 and 1 is a + b * ni + c * ni * nj further on.
  std::uint32_t first_point(const std::array<std::uint32_t, 3>& index) const {
    return index[0] + dimensions[0] * (index[1] + dimensions[1] * index[2]);
  }
  std::uint32_t first_point(std::uint32_t cell) const { return first_point(cell_index(cell)); }
  /// Whether a face of the cell at this index is taken for planar: the same from both sides.
  bool is_planar(const std::array<std::uint32_t, 3>& index, std::uint32_t face) const {
    if (!twisted.holds(index)) return true;
    const std::size_t axis = face / 2;
    const std::uint32_t at = index[axis] - twisted.first[axis];
    if (face % 2 == 0) return at == 0 && index[axis] != 0;
    return at + 1 == twisted.size[axis] && index[axis] + 2 != dimensions[axis];
  }
  /// The visible cell behind a face, or kNone.
  std::uint32_t neighbor(std::uint32_t cell, std::uint32_t face) const;
};

/// Distance of a planar face's diagonals, at most, in the local frame. Rounding coordinates to
/// single precision moves either diagonal by up to 5.2e-8 (half a unit in the last place of numbers
/// up to one, in three axes), and so makes a planar face of any mesh one that is up to 1e-7 apart.
/// Twice that, so that a mesh whose file was rounded, too, passes. Taking such a face for planar
/// moves a crossing by no more than half of this, 1.2e-7, divided by the cosine between ray and
/// face: less than what rounding the sheared vertices does (traverse/measure.h).
inline constexpr double kPlanar = 0x1p-22;

/// Builds the walkable form. Requires a grid that passed check_structure().
WalkableGrid make_walkable_grid(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds);

}  // namespace plume
