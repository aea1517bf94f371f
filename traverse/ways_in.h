/// Sixteen rays and a boundary face: which come in by it, and where.
#pragma once

#include <span>

#include "plume/mesh/local_frame.h"
#include "plume/traverse/frame_lanes.h"

namespace plume {

/// What walkers take a face for.
enum class FaceSurface {
  triangle,
  planar,  ///< a quadrilateral by measure_planar()
  patch,   ///< a quadrilateral by measure_patch()
  other    ///< a polygon, or a quadrilateral that is crossed otherwise
};

/// Corners in the order in which walkers measure the face.
struct BoundaryLoop {
  std::span<const WalkablePoint* const> corners;
  FaceSurface surface = FaceSurface::other;
  bool is_from_outside = true;  ///< whether that order goes around it as seen from outside
};

/// Bits are of the lanes.
struct WaysIn {
  /// Those that may come in: not those that pass beside the hull of the corners, nor, for
  /// triangles and quadrilaterals, those about which the face winds as at a way out; by a planar
  /// face none but those about which it winds as at a way in. All bits where the rays' longest axes
  /// differ. Means nothing for rays that are not valid.
  unsigned maybe = 0;
  /// Of those the ones that come in once, with rank 0, at these places.
  unsigned once = 0;
  alignas(64) double z[FrameLanes::kRays];
  float scalar[FrameLanes::kRays];
};

/// Takes the same bits from the same numbers as the walkers do, and finds the same places, to the
/// bit.
void find_ways_in(const FrameLanes& frames, const BoundaryLoop& face, WaysIn& found);

}  // namespace plume
