/// The seam between traversal and optics.
#pragma once

#include <cstdint>

namespace plume {

/// The part of a ray inside one cell, in front-to-back order along the ray.
struct Segment {
  /// Distances along the ray in world units; t_in <= t_out.
  double t_in, t_out;
  /// The scalar where the ray comes in and goes out, linear in between (exactly so in a
  /// tetrahedron). NaN where a value that takes part is.
  float s_in, s_out;
  /// Number of the cell in the walkable mesh.
  std::uint32_t cell;
};

/// How a ray's way through a mesh ended.
enum class WalkEnd : std::uint8_t {
  left,     ///< at the boundary, as every walk does
  stopped,  ///< the visitor had seen enough
  lost,     ///< no way out of a cell, or a walk without end: never, by construction; counted
};

/// What became of a ray.
struct TraceResult {
  WalkEnd end = WalkEnd::left;
  /// Times that the ray came in through the boundary.
  std::uint32_t entries = 0;
  /// Cells walked through, each as often as the ray was in it.
  std::uint64_t cells = 0;
};

}  // namespace plume
