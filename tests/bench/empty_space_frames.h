/// Frames of a rectilinear grid that pass over empty space, against those that walk through it.
#pragma once

namespace plume::bench {

struct EmptySpaceOptions {
  int size = 512;   ///< pixels along each side
  int rounds = 5;   ///< frames each
  int cells = 256;  ///< along each side of the grid
};

/// Renders a grid on one thread with transfer functions that show less and less of it, and with an
/// opaque isosurface: by the tree of ranges, ray by ray through all cells, and by packets; prints
/// times and ratios, and what the tree takes. False where pictures differ: not in a bit from the
/// walk's, by less than 4e-5 (lib/planner.h) from the packets'.
bool compare_empty_space(const EmptySpaceOptions& options);

}  // namespace plume::bench
