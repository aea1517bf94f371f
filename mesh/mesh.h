/// The mesh that a user has: any cells, any fields, in arrays that are owned or borrowed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plume/mesh/array.h"

namespace plume {

/// Volume cells, by VTK's numbers and with VTK's order of points.
enum class CellType : std::uint8_t {
  tetrahedron = 10,
  voxel = 11,
  hexahedron = 12,
  wedge = 13,
  pyramid = 14,
  pentagonal_prism = 15,
  hexagonal_prism = 16,
  polyhedron = 42,
};

/// Where a field's values live.
enum class Association : std::uint8_t { point, cell };

/// Values on points or cells; `values` holds `components` numbers for each, interleaved.
struct Field {
  std::string name;                              ///< as users ask for it
  Association association = Association::point;  ///< where the values are
  int components = 1;                            ///< numbers for each, >= 1
  Array values;                                  ///< components times points or cells
};

/// Explicit cells, laid out as in vtkUnstructuredGrid, so that its arrays can be borrowed.
struct Cells {
  /// CellType of each cell (uint8), or a single value when all cells are of one type.
  Array types;
  /// Cell i's points are connectivity[offsets[i] .. offsets[i + 1]); one more entry than cells.
  /// Empty when all cells are of one type with a fixed number of points: cell i's are then
  /// connectivity[i * n .. (i + 1) * n).
  Array offsets;
  /// Point ids, from 0.
  Array connectivity;
  /// Polyhedra only. Cell i's faces start at polyhedron_faces[polyhedron_locations[i]]: the number
  /// of faces, then for each face its number of points and their ids. -1 where cell i is none.
  Array polyhedron_locations;
  Array polyhedron_faces;  ///< see above
};

/// A mesh is one of three things: a rectilinear grid (`dimensions` and `axes` set, neither points
/// nor connectivity stored; a regular grid is one whose coordinates are equidistant), a curvilinear
/// grid of hexahedra (`dimensions` and `points` set, no connectivity stored), or a list of explicit
/// cells (`points` and `cells`). Nothing is checked here; see validate.h.
struct Mesh {
  /// x, y, z of each point, interleaved; float or double. Length unit: the user's. Empty for a
  /// rectilinear grid.
  Array points;
  /// Rectilinear grids only: the coordinates along x, y and z, float or double, as many as
  /// `dimensions` says, strictly ascending or strictly descending.
  std::array<Array, 3> axes;
  /// Points along i, j and k of a grid; point (i, j, k) is i + ni * (j + nj * k). All zero for a
  /// mesh of explicit cells.
  std::array<std::int64_t, 3> dimensions{0, 0, 0};
  Cells cells;  ///< of a mesh of explicit cells
  /// Grids only: nonzero (uint8) where a cell is hidden (blanked, a ghost). May be empty.
  Array hidden_cells;
  std::vector<Field> fields;  ///< names may occur on points and on cells
  /// Name of the field that the file calls active; may be empty.
  std::string active_field;

  /// A grid of either kind: cells follow from `dimensions`.
  bool is_grid() const { return dimensions[0] > 0; }
  /// Whether `axes` are set.
  bool is_rectilinear() const { return !axes[0].empty() || !axes[1].empty() || !axes[2].empty(); }
  /// Used or not.
  std::size_t point_count() const;
  /// Hidden cells included.
  std::size_t cell_count() const;
};

/// Points of one cell of a type; 0 for a polyhedron, which has no fixed number.
int points_per_cell(CellType type);

/// The type's name for messages: "tetrahedron", ...
const char* cell_type_name(CellType type);

/// True where the number is one of CellType's.
bool is_volume_cell_type(int vtk_type);

}  // namespace plume
