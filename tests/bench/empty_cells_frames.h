/// Past the cells of a volume in which nothing is to be seen, against walking through all.
#pragma once

#include "plume/tests/bench/hierarchy_frames.h"

namespace plume::bench {

/// Renders volumes of the boxes of compare_isosurfaces(), of transfer functions that leave more and
/// more cells empty, on one thread: through the hierarchy, by the scalar walker and by packets;
/// prints times and ratios. False where the first two pictures differ in a bit, or that of packets
/// by more than 4e-5.
bool compare_empty_cells(const HierarchyFrameOptions& options);

}  // namespace plume::bench
