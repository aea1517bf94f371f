/// Whole frames in the modes that show one number a ray: packets of rays against one by one.
#pragma once

namespace plume::bench {

struct ModeFrameOptions {
  int size = 512;  ///< pixels along each side
  int rounds = 5;
};

/// Renders the blunt fin as hexahedra and as tetrahedra, mixed cells and a rectilinear grid in
/// every mode at order 1, on one thread, by packets and by the scalar twin in turns, and prints
/// times, ratios, and how far the numbers are from the twin's. False where they are farther than
/// 1e-5 of the picture's greatest number.
bool compare_modes(const ModeFrameOptions& options);

}  // namespace plume::bench
