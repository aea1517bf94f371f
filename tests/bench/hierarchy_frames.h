/// Isosurfaces through the hierarchy of cells, against walking to them.
#pragma once

namespace plume::bench {

struct HierarchyFrameOptions {
  int size = 1024;  ///< pixels along each side
  int rounds = 5;   ///< frames each
  int cells = 118;  ///< cuboids along the box, of six tetrahedra each: 10 million
};

/// Renders an opaque isosurface of boxes of jittered tetrahedra, of hexahedra (cells^3) and of
/// cells of all kinds (some 2.6 (cells / 2)^3), on one thread: through the hierarchy of cells, by
/// the scalar walker and by packets; prints times, ratios, and what the hierarchy of tetrahedra
/// takes. False where pictures differ in a bit.
bool compare_isosurfaces(const HierarchyFrameOptions& options);

}  // namespace plume::bench
