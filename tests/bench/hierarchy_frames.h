/// Isosurfaces through the hierarchy of cells, against walking to them.
#pragma once

namespace plume::bench {

struct HierarchyFrameOptions {
  int size = 1024;  ///< pixels along each side
  int rounds = 5;   ///< frames each
  int cells = 118;  ///< cuboids along the box, of six tetrahedra each: 10 million
};

/// Renders an opaque isosurface of a box of jittered tetrahedra on one thread: through the
/// hierarchy, by the scalar walker, and by packets' search for it (no picture, ways in known);
/// prints times, ratios, and what the hierarchy takes. False where pictures differ in a bit.
bool compare_isosurfaces(const HierarchyFrameOptions& options);

}  // namespace plume::bench
