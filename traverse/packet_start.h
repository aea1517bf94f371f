/// A ray ready to be walked through tetrahedra: what a lane of a packet is filled with.
#pragma once

#include <cstddef>
#include <cstdint>

#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/measure.h"
#include "plume/traverse/sheared_frame.h"

namespace plume {

struct PacketStart {
  /// The triangle by which the ray comes in; it winds about the ray.
  ShearedPoint corners[3] = {};
  std::uint32_t ids[3] = {0, 0, 0};
  /// Whether the edge across from each corner crosses y = 0 on the ray's right.
  bool right[3] = {true, true, true};
  std::uint32_t cell = 0;
  std::uint32_t apex = 0;
  ShearedFrame::Line line = {};
  /// Where it comes in, and the scalar there.
  float z = 0, scalar = 0;
  /// World length per unit of z along the ray; negative where z falls.
  float t_per_z = 1;
  /// For whoever made it: which ray this is.
  std::uint32_t ray = 0;
};

/// Makes a start of the ray whose frame that is, at a boundary face that winds about it, entered at
/// `place`. Each field is written where it stays: set-up is a good part of a short ray's cost, and
/// copies of what was just written wait for it.
inline void set_start(PacketStart& start, const WalkableTets& mesh, const ShearedFrame& frame,
                      const WalkableTets::Boundary& face, const Crossing& place,
                      std::uint32_t ray) {
  const ShearedPoint a = frame(mesh.points[face.loop[0]]);
  const ShearedPoint b = frame(mesh.points[face.loop[1]]);
  const ShearedPoint c = frame(mesh.points[face.loop[2]]);
  start.corners[0] = a;
  start.corners[1] = b;
  start.corners[2] = c;
  for (std::size_t i = 0; i < 3; ++i) start.ids[i] = face.loop[i];
  start.right[0] = crossing(b, c) != 0;
  start.right[1] = crossing(c, a) != 0;
  start.right[2] = crossing(a, b) != 0;
  start.cell = face.cell;
  start.apex = face.apex;
  start.line = frame.line();
  start.z = static_cast<float>(place.z);
  start.scalar = place.scalar;
  start.t_per_z = static_cast<float>(frame.t_per_z());
  start.ray = ray;
}

inline PacketStart make_start(const WalkableTets& mesh, const ShearedFrame& frame,
                              const WalkableTets::Boundary& face, const Crossing& place,
                              std::uint32_t ray) {
  PacketStart start;
  set_start(start, mesh, frame, face, place, ray);
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
