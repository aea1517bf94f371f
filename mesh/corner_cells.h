/// Cells of up to eight corners as packets of rays read them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace plume {

struct WalkableCells;

/// In place of a face's number, in a cell that is no CornerCell.
inline constexpr std::uint32_t kNoCorners = 7;

/// One line of the cache: the eight corners of a hexahedron, and who is behind its faces. A wedge,
/// a pyramid or a tetrahedron is one some of whose corners coincide; the faces that have fewer than
/// three different corners are never crossed.
struct alignas(64) CornerCell {
  /// Corner a + 2b + 4c, a, b, c being 0 or 1.
  std::array<std::uint32_t, 8> points;
  /// Behind the faces -a, +a, -b, +b, -c, +c: eight times the cell, plus the number that the face
  /// has there (kNoCorners where that cell has no eight corners); kNone at the boundary.
  std::array<std::uint32_t, 6> links;
  /// 1 where the cell is something else, a polyhedron: the corners then mean nothing.
  std::uint32_t other = 0;
  /// The face that is at the boundary; kNoCorners where none or several are.
  std::uint32_t boundary = kNoCorners;
};

/// As many as have all their words within reach of a signed 32-bit index.
inline constexpr std::uint32_t kMostCornerCells = 0x7FFFFFF;

/// Corners of the faces -a, +a, -b, +b, -c, +c of these, and of the cells of a grid: both cells of
/// a grid at a face go around it from the same corner in the same direction, so they see the same
/// numbers. Counterclockwise from outside of a right-handed cell for the second of each two,
/// clockwise for the first.
inline constexpr std::uint8_t kCornerLoop[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 4, 5, 1},
                                                   {2, 6, 7, 3}, {0, 1, 3, 2}, {4, 5, 7, 6}};

/// A CornerCell for each cell of the mesh, in parallel: 64 bytes a cell. Empty where more than a
/// tenth of the cells would be none, or there are more than kMostCornerCells: such a cell among
/// others takes two steps of the scalar walker, some eight times what EdgeCells take.
std::vector<CornerCell> make_corner_cells(const WalkableCells& mesh);

/// The number in face_sides of a face of a cell that is a CornerCell; kNone where the face has
/// fewer than three different corners.
std::uint32_t face_of_corners(const WalkableCells& mesh, const CornerCell& corners,
                              std::uint32_t cell, std::uint32_t face);

/// The number of a face of a cell among its six: the other way round.
std::uint32_t corner_face(const WalkableCells& mesh, const CornerCell& corners, std::uint32_t cell,
                          std::uint32_t face_side);

}  // namespace plume
