/// Tetrahedra as a walker reads them.
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

/// Immutable but for its scalars (put_scalars.h), compact, ordered along a Hilbert curve; safe to
/// read from any number of threads. 32 bytes and a bit a cell, 16 a point.
///
/// A cell does not store its points. Who comes in through a face knows three of them, and the link
/// that was followed brought the fourth, the apex. So the next point and the next cell are fetched
/// at once, and the number of the face left is the rank of the point that it leaves out.
struct WalkableTets {
  struct Link {
    std::uint32_t cell;  ///< the neighbour, kNone at the boundary
    std::uint32_t apex;  ///< the neighbour's point opposite to the common face
  };
  /// links[r] leads across the face that leaves out the cell's point of rank r: of its four points,
  /// the one that r others are smaller than, by number.
  using Cell = std::array<Link, 4>;
  /// A face without a neighbour.
  struct Boundary {
    std::uint32_t cell;
    std::uint32_t apex;                 ///< the cell's point opposite to the face
    std::array<std::uint32_t, 3> loop;  ///< the face's points, seen from outside
  };

  LocalFrame frame;
  std::vector<WalkablePoint> points;
  std::vector<Cell> cells;
  /// One value a cell where the field is cell-centred, else empty (values are in the points).
  std::vector<float> cell_values;
  /// Number of each cell in the user's mesh; empty unless asked for.
  std::vector<std::uint32_t> original_cells;
  /// Number here of each of the user's points, kNone where no cell uses it; empty unless asked for.
  std::vector<std::uint32_t> point_numbers;
  /// In the order of their cells.
  std::vector<Boundary> boundary;
  /// One bit a cell: whether its ascending points have the opposite of VTK's positive orientation.
  /// Walkers need no orientation; who looks at a cell without having walked to it does.
  std::vector<std::uint64_t> odd_bits;
  std::vector<Finding> findings;

  std::size_t cell_count() const { return cells.size(); }
  bool is_odd(std::uint32_t cell) const { return (odd_bits[cell / 64] >> cell % 64 & 1) != 0; }
  /// The points of a cell in ascending order, so that link r leaves out the r-th. From the links
  /// back of its neighbours, or from the list of boundary faces: some ten reads.
  std::array<std::uint32_t, 4> points_of(std::uint32_t cell) const;
  std::uint32_t original_cell(std::uint32_t cell) const {
    return original_cells.empty() ? cell : original_cells[cell];
  }
  std::size_t bytes() const;

 private:
  std::array<std::uint32_t, 4> points_of_rare(std::uint32_t cell) const;
};

/// Builds the walkable form: orders cells and points, finds neighbours, gives all cells that hang
/// together one orientation. Cells with repeated points have no inside; they are left out and their
/// neighbours joined. A face of three and more cells joins the first two and is boundary to the
/// rest. All of that is in `findings`. Requires a mesh of tetrahedra that passed check_structure().
WalkableTets make_walkable_tets(const Mesh& mesh, const ScalarField& scalar, const Bounds& bounds,
                                bool keep_original_cells, bool keep_point_numbers = false);

}  // namespace plume
