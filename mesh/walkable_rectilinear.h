/// A rectilinear grid as a walker reads it: its scalars, and next to nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plume/mesh/face_matching.h"
#include "plume/mesh/findings.h"
#include "plume/mesh/mesh.h"
#include "plume/mesh/scalar_field.h"

namespace plume {

/// 4 bytes a point (or a cell, where the field is cell-centred), 16 for each coordinate along an
/// axis, and one bit a cell where some are hidden. Cell (i, j, k) is i + ci * (j + cj * k) with
/// ci = points(0) - 1 and so on, as in the user's mesh, whichever way the axes run.
///
/// Coordinates are those of the user, in double: no local frame is needed.
struct WalkableRectilinear {
  struct Axis {
    /// Of the planes across the axis, in the user's order: strictly ascending or descending.
    std::vector<double> coordinates;
    /// 1 / distance of plane i + 1 from plane i, > 0 and finite.
    std::vector<double> per_width;

    bool ascending() const { return coordinates.back() > coordinates.front(); }
  };
  std::array<Axis, 3> axes;
  /// One value a point; empty where the field is cell-centred.
  std::vector<float> point_values;
  /// One value a cell; empty where the field is on points.
  std::vector<float> cell_values;
  /// One bit a cell where some are hidden, else empty.
  std::vector<bool> hidden;
  std::vector<Finding> findings;

  /// Points along an axis.
  std::uint32_t points(std::size_t axis) const {
    return static_cast<std::uint32_t>(axes[axis].coordinates.size());
  }
  std::size_t point_count() const {
    return static_cast<std::size_t>(points(0)) * points(1) * points(2);
  }
  std::size_t cell_count() const {
    return static_cast<std::size_t>(points(0) - 1) * (points(1) - 1) * (points(2) - 1);
  }
  std::uint32_t original_cell(std::uint32_t cell) const { return cell; }
  bool is_hidden(std::uint32_t cell) const { return !hidden.empty() && hidden[cell]; }
  std::size_t bytes() const;

  /// The visible cell behind a face, or kNone. Faces are numbered -i, +i, -j, +j, -k, +k.
  std::uint32_t neighbor(std::uint32_t cell, std::uint32_t face) const;
  /// Faces of visible cells without a visible cell behind them; counted at each call where cells
  /// are hidden.
  std::size_t boundary_face_count() const;
};

/// Builds the walkable form and takes the scalar's values for it. Requires a rectilinear grid that
/// passed check_structure().
WalkableRectilinear make_walkable_rectilinear(const Mesh& mesh, ScalarField scalar);

}  // namespace plume
