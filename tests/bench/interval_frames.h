/// What intervals, isosurfaces and light cost a frame.
#pragma once

namespace plume::bench {

struct IntervalFrameOptions {
  int rounds = 5;
  int size = 512;
};

/// The blunt fin, as hexahedra and as tetrahedra, as a volume alone, with two intervals and an
/// isosurface added, and with light on these, all by packets, in turns on one thread. Prints a
/// table; false where packets and the scalar twin are not of the same thing.
bool compare_with_volume_alone(const IntervalFrameOptions& options);

/// The same scene split in data space and from tables (IntervalWay), ray by ray. Prints how far the
/// pictures are apart and what they cost.
void compare_ways(const IntervalFrameOptions& options);

}  // namespace plume::bench
