/// Cells of any kind as a walker reads them: faces, and who is on either side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plume/mesh/corner_cells.h"
#include "plume/mesh/edge_cells.h"
#include "plume/mesh/face_matching.h"
#include "plume/mesh/findings.h"
#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"
#include "plume/mesh/scalar_field.h"

namespace plume {

/// Hexahedra, wedges, pyramids, polyhedra and tetrahedra in one mesh. Each face is stored once, as
/// a loop of points seen from outside of its owner, that is from inside of its neighbour.
struct WalkableCells {
  struct FaceSides {
    std::uint32_t owner;
    std::uint32_t neighbor;  ///< kNone at the boundary
  };

  LocalFrame frame;
  std::vector<WalkablePoint> points;
  std::vector<std::uint32_t> face_begin;  ///< faces + 1 offsets into face_points
  std::vector<std::uint32_t> face_points;
  std::vector<FaceSides> face_sides;
  std::vector<std::uint32_t> cell_begin;      ///< cells + 1 offsets into cell_faces
  std::vector<std::uint32_t> cell_faces;      ///< numbers of faces
  std::vector<float> cell_values;             ///< one a cell where the field is cell-centred
  std::vector<std::uint32_t> original_cells;  ///< empty unless asked for
  /// Number here of each of the user's points, kNone where no face uses it; empty unless asked for.
  std::vector<std::uint32_t> point_numbers;
  std::vector<BoundaryFace> boundary;    ///< `face` is a number in face_sides
  std::vector<CornerCell> corner_cells;  ///< for packets of rays; empty unless asked for
  EdgeCells edge_cells;                  ///< for packets of rays; empty unless asked for
  std::vector<Finding> findings;

  std::size_t cell_count() const { return cell_begin.size() - 1; }
  std::uint32_t original_cell(std::uint32_t cell) const {
    return original_cells.empty() ? cell : original_cells[cell];
  }
  std::span<const std::uint32_t> loop(std::uint32_t face) const {
    return {face_points.data() + face_begin[face], face_points.data() + face_begin[face + 1]};
  }
  std::span<const std::uint32_t> faces_of(std::uint32_t cell) const {
    return {cell_faces.data() + cell_begin[cell], cell_faces.data() + cell_begin[cell + 1]};
  }
  std::size_t bytes() const;
  /// Whether packets of rays can walk it.
  bool has_packets() const { return !corner_cells.empty() || !edge_cells.empty(); }
};

/// Makes what packets of rays read, corner_cells or edge_cells or, in a mixed mesh, both.
void prepare_packets(WalkableCells& mesh);

/// Builds the walkable form. Repeated points of a face are taken as one; a face with fewer than
/// three different points is nothing a ray could cross and is left out. The faces of a polyhedron
/// are turned so that they agree with each other; a polyhedron whose faces leave a gap has no
/// inside, is left out, and is named in `findings`. Requires a mesh of explicit cells that passed
/// check_structure().
WalkableCells make_walkable_cells(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds,
                                  bool keep_original_cells, bool keep_point_numbers = false);

}  // namespace plume
