/// Whole frames of hexahedra: against tetrahedra, and by order.
#pragma once

namespace plume::bench {

struct HexahedraFrameOptions {
  int size = 512;  ///< pixels along each side
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

}  // namespace plume::bench
