/// What a second core is worth.
#pragma once

namespace plume::bench {

struct ThreadScalingOptions {
  int size = 1024;  ///< pixels along each side
  int rounds = 7;
};

/// Renders a frame of a box of a million tetrahedra and of the blunt fin with one and with two
/// threads in turns, and prints wall times, the ratio of their medians and of
/// the shortest; beside these what the machine has to give: how much sooner two frames are done
/// when two threads render one each at the same time. The blunt fin is skipped, loudly, without the
/// dataset. False where two threads did not give one thread's picture, bit for bit.
bool compare_threads(const ThreadScalingOptions& options);

}  // namespace plume::bench
