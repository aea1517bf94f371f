/// What tests of packets share: what packets met, and every instruction set in turn.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "hwy/targets.h"
#include "plume/traverse/packets.h"

namespace plume::test {

/// Segments by ray.
class Segments : public PacketSegmentSink {
 public:
  explicit Segments(std::size_t rays) : of_ray(rays) {}
  void take(const PacketSegment& segment) override { of_ray[segment.ray].push_back(segment); }
  std::vector<std::vector<PacketSegment>> of_ray;
};

/// Restores all instruction sets at the end of a scope.
struct InstructionSets {
  std::vector<std::int64_t> each;
  InstructionSets() {
    for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1)
      each.push_back(all & -all);
  }
  ~InstructionSets() { limit_packet_instruction_sets(0); }
};

/// The other instantiations of the walk come to what its segments do. Paths through the mesh are at
/// most 4 times `size` long, scalars at most 4.
inline void expect_sums(const PacketIntegral& integral, const PacketHit& hit,
                        const std::vector<PacketSegment>& segments, float isovalue,
                        double size = 1) {
  double length = 0, sum = 0;
  for (const PacketSegment& s : segments) {
    length += s.length;
    sum += 0.5 * s.length * (static_cast<double>(s.s_in) + s.s_out);
  }
  const auto count = static_cast<std::uint32_t>(segments.size());
  ASSERT_EQ(integral.cells, count);
  // Half a unit in the last place of the sum (at most 4 for lengths, 16 for integrals) for each
  // addition.
  ASSERT_NEAR(integral.length, length, 2.4e-7 * (count + 1) * size);
  ASSERT_NEAR(integral.integral, sum, 1e-6 * (count + 1) * size);

  double way = 0;
  std::uint32_t cells = 0;
  for (const PacketSegment& s : segments) {
    ++cells;
    if ((s.s_in < isovalue) != (s.s_out < isovalue)) {
      ASSERT_EQ(hit.cells, cells);
      ASSERT_NEAR(hit.distance,
                  way + s.length * (s.s_in - isovalue) / static_cast<double>(s.s_in - s.s_out),
                  2.4e-7 * (count + 1) * size);
      return;
    }
    way += s.length;
  }
  ASSERT_EQ(hit.cells, count);
  ASSERT_EQ(hit.distance, std::numeric_limits<float>::infinity());
}

}  // namespace plume::test
