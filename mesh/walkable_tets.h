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

/// How cells know each other.
enum class TetLinks : std::uint8_t {
  /// Neighbour and apex behind each face: 32 bytes and a bit a cell.
  whole,
  /// Sums of numbers, from which who walks works them out: 16 bytes a cell. Beyond some 10 million
  /// cells a walk is faster so; but no cell can be looked at that was not walked to.
  compact,
};

/// Immutable but for its scalars (put_scalars.h), compact, ordered along a Hilbert curve; safe to
/// read from any number of threads. 32 bytes and a bit a cell, or 16 bytes; 16 a point.
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
  /// A cell of TetLinks::compact. Who is in a cell knows three of its points and the neighbour that
  /// it came from; exclusive ors with these give the fourth point, and the other neighbours.
  ///
  /// Source: Aman, Demirci, Gudukbay, "Compact tetrahedralization-based acceleration structures for
  /// ray tracing" (Journal of Visualization 25, 2022), their 16-byte form; faces are numbered by
  /// rank here, so that none need be stored.
  struct CompactCell {
    std::uint32_t points;                    ///< of the four points' numbers
    std::array<std::uint32_t, 3> neighbors;  ///< of the neighbour across face r + 1 and that of 0

    /// The point that these three are not, given the exclusive or of their numbers.
    std::uint32_t apex(std::uint32_t others) const { return points ^ others; }
    /// The neighbour across face `out`, given the one across face `in`; kNone at the boundary.
    std::uint32_t neighbor(std::size_t out, std::size_t in, std::uint32_t across_in) const {
      auto sum = [&](std::size_t face) { return face == 0 ? 0 : neighbors[face - 1]; };
      return across_in ^ sum(in) ^ sum(out);
    }
  };
  /// A face without a neighbour.
  struct Boundary {
    std::uint32_t cell;
    std::uint32_t apex;                 ///< the cell's point opposite to the face
    std::array<std::uint32_t, 3> loop;  ///< the face's points, seen from outside
  };

  LocalFrame frame;
  std::vector<WalkablePoint> points;
  /// One of the two is empty.
  std::vector<Cell> cells;
  std::vector<CompactCell> compact_cells;
  /// One value a cell where the field is cell-centred, else empty (values are in the points).
  std::vector<float> cell_values;
  /// Number of each cell in the user's mesh; empty unless asked for.
  std::vector<std::uint32_t> original_cells;
  /// Number here of each of the user's points, kNone where no cell uses it; empty unless asked for.
  std::vector<std::uint32_t> point_numbers;
  /// In the order of their cells.
  std::vector<Boundary> boundary;
  /// One bit a cell: whether its ascending points have the opposite of VTK's positive orientation.
  /// Walkers need no orientation; who looks at a cell without having walked to it does. Empty where
  /// cells are compact.
  std::vector<std::uint64_t> odd_bits;
  std::vector<Finding> findings;

  bool is_compact() const { return !compact_cells.empty(); }
  std::size_t cell_count() const { return cells.size() + compact_cells.size(); }
  bool is_odd(std::uint32_t cell) const { return (odd_bits[cell / 64] >> cell % 64 & 1) != 0; }
  /// The points of a cell in ascending order, so that link r leaves out the r-th. From the links
  /// back of its neighbours, or from the list of boundary faces: some ten reads. Requires whole
  /// links.
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
                                bool keep_original_cells, bool keep_point_numbers = false,
                                TetLinks links = TetLinks::whole);

}  // namespace plume
