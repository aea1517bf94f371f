/// A ray ready to be walked: what a lane of a packet is filled with.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/measure.h"
#include "plume/traverse/sheared_frame.h"

namespace plume {

/// What all kinds of cells need.
struct PacketStart {
  std::uint32_t cell = 0;
  ShearedFrame::Line line = {};
  /// Where it comes in, and the scalar there.
  float z = 0, scalar = 0;
  /// World length per unit of z along the ray; negative where z falls.
  float t_per_z = 1;
  /// For whoever made it: which ray this is.
  std::uint32_t ray = 0;

  /// Each field is written where it stays: set-up is a good part of a short ray's cost, and copies
  /// of what was just written wait for it.
  void set(const ShearedFrame& frame, const Crossing& place, std::uint32_t number) {
    line = frame.line();
    z = static_cast<float>(place.z);
    scalar = place.scalar;
    t_per_z = static_cast<float>(frame.t_per_z());
    ray = number;
  }
};

/// A ray ready to be walked through tetrahedra.
struct TetStart : PacketStart {
  /// The triangle by which the ray comes in; it winds about the ray.
  ShearedPoint corners[3] = {};
  std::uint32_t ids[3] = {0, 0, 0};
  /// Whether the edge across from each corner crosses y = 0 on the ray's right.
  bool right[3] = {true, true, true};
  std::uint32_t apex = 0;
};

/// Makes a start of the ray whose frame that is, at a boundary face that winds about it, entered at
/// `place`.
inline void set_start(TetStart& start, const WalkableTets& mesh, const ShearedFrame& frame,
                      const WalkableTets::Boundary& face, const Crossing& place,
                      std::uint32_t /*rank*/, std::uint32_t ray) {
  start.set(frame, place, ray);
  const ShearedPoint a = frame(mesh.points[face.loop[0]]);
  const ShearedPoint b = frame(mesh.points[face.loop[1]]);
  const ShearedPoint c = frame(mesh.points[face.loop[2]]);
  start.corners[0] = a;
  start.corners[1] = b;
  start.corners[2] = c;
  for (std::size_t i = 0; i < 3; ++i) start.ids[i] = face.loop[i];
  start.right[0] = crossing_unbranched(b, c) != 0;
  start.right[1] = crossing_unbranched(c, a) != 0;
  start.right[2] = crossing_unbranched(a, b) != 0;
  start.cell = face.cell;
  start.apex = face.apex;
}

/// A ray ready to be walked through a curvilinear grid.
///
/// Directions are numbered as faces are: -i, +i, -j, +j, -k, +k. The corners of the quadrilateral
/// by which the ray comes in are `first`, then one step along u, along u and v, and along v; along
/// `ahead` lies the cell.
struct GridStart : PacketStart {
  ShearedPoint corners[4] = {};
  std::uint32_t first = 0;  ///< number of a point
  std::uint8_t u = 0, v = 0, ahead = 0;
  std::array<std::uint32_t, 3> index = {0, 0, 0};  ///< of the cell
  std::uint32_t rank = 0;                          ///< of the entry (see pair_crossings.h)
  const ShearedFrame* frame = nullptr;             ///< must stay where it is
};

/// Places a start at a face of a cell by which a ray comes into it.
inline void set_place(GridStart& start, const WalkableGrid& mesh, const ShearedFrame& frame,
                      std::uint32_t cell, std::uint32_t face, std::uint32_t rank) {
  const std::uint32_t step[3] = {1, mesh.dimensions[0], mesh.dimensions[0] * mesh.dimensions[1]};
  const std::uint32_t axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  start.cell = cell;
  start.index = mesh.cell_index(cell);
  start.first = start.index[0] + start.index[1] * step[1] + start.index[2] * step[2] +
                (face % 2) * step[axis];
  start.u = static_cast<std::uint8_t>(2 * u + 1);
  start.v = static_cast<std::uint8_t>(2 * v + 1);
  start.ahead = static_cast<std::uint8_t>(face ^ 1);
  start.rank = rank;
  start.frame = &frame;
  start.corners[0] = frame(mesh.points[start.first]);
  start.corners[1] = frame(mesh.points[start.first + step[u]]);
  start.corners[2] = frame(mesh.points[start.first + step[u] + step[v]]);
  start.corners[3] = frame(mesh.points[start.first + step[v]]);
}

inline void set_start(GridStart& start, const WalkableGrid& mesh, const ShearedFrame& frame,
                      const BoundaryFace& face, const Crossing& place, std::uint32_t rank,
                      std::uint32_t ray) {
  start.set(frame, place, ray);
  set_place(start, mesh, frame, face.cell, face.face, rank);
}

/// A ray ready to be walked through cells of up to eight corners (CornerCell).
struct CellStart : PacketStart {
  std::uint32_t from = 0;               ///< of the cell's six faces, or kNoCorners
  std::uint32_t face = 0;               ///< by which it comes in: a number in face_sides
  std::uint32_t rank = 0;               ///< of the entry (see pair_crossings.h)
  const ShearedFrame* frame = nullptr;  ///< must stay where it is
};

/// Places a start at a face of a cell by which a ray comes into it.
inline void set_place(CellStart& start, const WalkableCells& mesh, const ShearedFrame& frame,
                      std::uint32_t cell, std::uint32_t face, std::uint32_t rank) {
  start.cell = cell;
  start.from = mesh.corner_cells.empty() ? kNoCorners
                                         : corner_face(mesh, mesh.corner_cells[cell], cell, face);
  start.face = face;
  start.rank = rank;
  start.frame = &frame;
}

inline void set_start(CellStart& start, const WalkableCells& mesh, const ShearedFrame& frame,
                      const BoundaryFace& face, const Crossing& place, std::uint32_t rank,
                      std::uint32_t ray) {
  start.set(frame, place, ray);
  set_place(start, mesh, frame, face.cell, face.face, rank);
}

/// What rays through a mesh start with.
template <class Mesh>
using StartOf = std::conditional_t<
    std::is_same_v<Mesh, WalkableTets>, TetStart,
    std::conditional_t<std::is_same_v<Mesh, WalkableGrid>, GridStart, CellStart>>;

/// set_start() by value.
template <class Mesh, class Boundary>
StartOf<Mesh> make_start(const Mesh& mesh, const ShearedFrame& frame, const Boundary& face,
                         const Crossing& place, std::uint32_t rank, std::uint32_t ray) {
  StartOf<Mesh> start;
  set_start(start, mesh, frame, face, place, rank, ray);
  return start;
}

/// Starts that packets hold at a time, at the most.
inline constexpr std::size_t kMaxPacketLanes = 8 * 16;

/// Where packets get their rays from.
class PacketFeeder {
 public:
  virtual ~PacketFeeder() = default;
  /// The next ray, null at the end. `finished` is the one that the lane has just ended, null at
  /// first; the same ray may come back, to enter again elsewhere. What is returned must stay where
  /// it is until its lane asks again.
  virtual const PacketStart* next(const PacketStart* finished) = 0;
};

}  // namespace plume
