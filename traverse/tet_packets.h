/// Tetrahedra walked by packets of rays with the widest instructions that the processor has.
#pragma once

#include <cstdint>
#include <span>

#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/packet_start.h"

namespace plume {

/// Walks all rays of `feeder` and counts, by PacketStart::ray, the cells that each went through
/// (added to what is there). The rays' longest axis must be `axis`, 0 to 2. Takes the same way as
/// TetWalker, bit for bit, with any instruction set.
void count_cells(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                 std::span<std::uint32_t> counts);

/// Segments of packets, for tests: what every lane met, in the order in which it did.
struct PacketSegment {
  std::uint32_t ray, cell;
  float length, s_in, s_out;
};

/// Walks all rays of `feeder` and hands out their segments. Lengths are in world units. Slow.
class PacketSegmentSink {
 public:
  virtual ~PacketSegmentSink() = default;
  virtual void take(const PacketSegment& segment) = 0;
};
void walk_segments(const WalkableTets& mesh, int axis, PacketFeeder& feeder,
                   PacketSegmentSink& sink);

/// The instruction set that is used: "AVX3", "AVX2", "SSE4", "NEON", ...
const char* packet_instruction_set();

/// Forbids all but the named instruction sets (0: allows all again), for tests and benchmarks; true
/// where something is left. Bits as Highway's HWY_SSE4 and so on.
void limit_packet_instruction_sets(std::int64_t targets);

}  // namespace plume
