/// Whole frames: Plume's against VTK's.
#pragma once

#include <string>

namespace plume::bench {

struct PeerFrameOptions {
  int size = 512;  ///< pixels along each side
  int rounds = 5;
  /// A directory for the pictures, as PNG files; none where empty.
  std::string pictures;
};

/// Renders the blunt fin as tetrahedra on one thread, by Plume and by VTK with each of its
/// integrators, and prints times, ratios and errors. Skipped, loudly, without the dataset. False
/// where the pictures are not of the same thing, or VTK's are not what it showed.
bool compare_peer_frames(const PeerFrameOptions& options);

}  // namespace plume::bench
