/// Whole frames of hexahedra: against tetrahedra, by order, and beside the thesis'.
#pragma once

namespace plume::bench {

struct HexahedraFrameOptions {
  int size = 512;  ///< pixels along each side; the thesis' table has twice as many, too
  int rounds = 5;
};

/// Renders the blunt fin as hexahedra and cut into tetrahedra, order 1, on one thread, with the
/// same cameras and transfer function, and prints times and ratios. False where the pictures are
/// not of the same thing.
bool compare_with_tetrahedra(const HexahedraFrameOptions& options);

/// Renders a curvilinear grid with planar faces, one with others and one all of whose faces are
/// twisted, in orders 1, 2 and 3, and prints the time of a frame, and how far the scalar along its
/// rays is from the isoparametric interpolation. False where a higher order is not nearer.
bool compare_orders(const HexahedraFrameOptions& options);

/// Frames a second of the thesis' two grids, beside its tables 6.6, 6.7 and 6.10.
void compare_with_thesis_frames(const HexahedraFrameOptions& options);

}  // namespace plume::bench
