/// A ray ready to be walked through tetrahedra: what a lane of a packet is filled with.
#pragma once

#include <cstddef>
#include <cstdint>

#include "plume/traverse/sheared_frame.h"

namespace plume {

struct PacketStart {
  /// The triangle by which the ray comes in; it winds about the ray.
  ShearedPoint corners[3] = {};
  std::uint32_t ids[3] = {0, 0, 0};
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
