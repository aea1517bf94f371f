#include "plume/mesh/corner_cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "plume/mesh/cell_shape.h"
#include "plume/mesh/walkable_cells.h"

namespace plume {
namespace {

using Corners = std::array<std::uint32_t, 8>;

// From VTK's order, in which two opposite faces are gone around.
std::optional<Corners> corners_of(const CellShape& shape) {
  const auto& v = shape.corners;
  switch (shape.type) {
    case CellType::hexahedron:
      return Corners{v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]};
    case CellType::wedge:
      return Corners{v[0], v[1], v[2], v[2], v[3], v[4], v[5], v[5]};
    case CellType::pyramid:
      return Corners{v[0], v[1], v[3], v[2], v[4], v[4], v[4], v[4]};
    case CellType::tetrahedron:
      return Corners{v[0], v[1], v[2], v[2], v[3], v[3], v[3], v[3]};
    default:
      return std::nullopt;
  }
}

// A loop without repeated points.
struct Loop {
  std::array<std::uint32_t, 4> points;
  std::size_t size = 0;
};
Loop loop_of(const Corners& corners, std::size_t face) {
  Loop loop;
  for (const std::uint8_t corner : kCornerLoop[face]) {
    const std::uint32_t point = corners[corner];
    const auto end = loop.points.begin() + static_cast<std::ptrdiff_t>(loop.size);
    if (std::find(loop.points.begin(), end, point) == end) loop.points[loop.size++] = point;
  }
  return loop;
}

// 1 where the two go around the same points in the same direction, -1 in the opposite one, else 0.
int same_loop(const Loop& a, std::span<const std::uint32_t> b) {
  if (a.size != b.size() || a.size < 3) return 0;
  for (std::size_t start = 0; start < a.size; ++start) {
    if (b[start] != a.points[0]) continue;
    bool forward = true, backward = true;
    for (std::size_t i = 1; i < a.size; ++i) {
      forward = forward && a.points[i] == b[(start + i) % a.size];
      backward = backward && a.points[i] == b[(start + a.size - i) % a.size];
    }
    if (forward) return 1;
    if (backward) return -1;
  }
  return 0;
}

// All faces of the cell are among its corners' and the other way round.
bool has_faces(const WalkableCells& mesh, const Corners& corners, std::uint32_t cell) {
  std::size_t found = 0;
  for (std::size_t f = 0; f < 6; ++f) {
    const Loop loop = loop_of(corners, f);
    if (loop.size < 3) continue;
    std::size_t same = 0;
    for (const std::uint32_t side : mesh.faces_of(cell))
      if (same_loop(loop, mesh.loop(side)) != 0) ++same;
    if (same != 1) return false;  // a flat cell, whose faces coincide
    ++found;
  }
  return found == mesh.faces_of(cell).size();
}

// Seen from outside the loops of +a, +b, +c are to go around counterclockwise.
bool is_mirrored(const WalkableCells& mesh, const Corners& corners, std::uint32_t cell) {
  for (std::size_t f = 0; f < 6; ++f) {
    const Loop loop = loop_of(corners, f);
    for (const std::uint32_t side : mesh.faces_of(cell)) {
      const int same = same_loop(loop, mesh.loop(side));
      if (same == 0) continue;
      const bool from_outside = mesh.face_sides[side].owner == cell;
      return (same > 0) != (from_outside == (f % 2 == 1));
    }
  }
  return false;
}

}  // namespace

std::uint32_t face_of_corners(const WalkableCells& mesh, const CornerCell& corners,
                              std::uint32_t cell, std::uint32_t face) {
  const Loop loop = loop_of(corners.points, face);
  for (const std::uint32_t side : mesh.faces_of(cell))
    if (same_loop(loop, mesh.loop(side)) != 0) return side;
  return kNone;
}

std::uint32_t corner_face(const WalkableCells& mesh, const CornerCell& corners, std::uint32_t cell,
                          std::uint32_t face_side) {
  if (corners.other != 0) return kNoCorners;
  if (corners.boundary != kNoCorners && mesh.face_sides[face_side].neighbor == kNone)
    return corners.boundary;
  for (std::uint32_t f = 0; f < 6; ++f)
    if (face_of_corners(mesh, corners, cell, f) == face_side) return f;
  return kNoCorners;
}

std::vector<CornerCell> make_corner_cells(const WalkableCells& mesh) {
  const std::size_t count = mesh.cell_count();
  if (count > kMostCornerCells) return {};
  std::vector<CornerCell> cells(count);
  std::atomic<std::size_t> others = 0;
  auto for_each = [count](const auto& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](const auto& range) {
      for (std::size_t c = range.begin(); c != range.end(); ++c)
        body(static_cast<std::uint32_t>(c));
    });
  };
  for_each([&](std::uint32_t c) {
    CornerCell& cell = cells[c];
    cell.links.fill(kNone);
    std::optional<Corners> corners = corners_of(shape_of(mesh, c));
    if (!corners || !has_faces(mesh, *corners, c)) {
      cell.points.fill(0);
      cell.other = 1;
      ++others;
      return;
    }
    if (is_mirrored(mesh, *corners, c))
      for (std::size_t i = 0; i < 8; i += 2) std::swap((*corners)[i], (*corners)[i + 1]);
    cell.points = *corners;
  });
  if (10 * others > count) return {};
  for_each([&](std::uint32_t c) {
    CornerCell& cell = cells[c];
    if (cell.other != 0) return;
    std::uint32_t at_boundary = 0;
    for (std::uint32_t f = 0; f < 6; ++f) {
      const std::uint32_t side = face_of_corners(mesh, cell, c, f);
      if (side == kNone) continue;
      const auto& sides = mesh.face_sides[side];
      const std::uint32_t neighbor = sides.owner == c ? sides.neighbor : sides.owner;
      if (neighbor == kNone) {
        cell.boundary = ++at_boundary == 1 ? f : kNoCorners;
        continue;
      }
      cell.links[f] = 8 * neighbor + corner_face(mesh, cells[neighbor], neighbor, side);
    }
  });
  return cells;
}

}  // namespace plume
