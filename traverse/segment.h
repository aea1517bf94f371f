/// The seam between traversal and optics.
#pragma once

#include <cstdint>

namespace plume {

/// The polynomial that a cell's scalar is taken for along a segment. Tetrahedra are linear whatever
/// was asked for.
enum class ScalarOrder : std::uint8_t { linear = 1, quadratic = 2, cubic = 3 };

/// The part of a ray inside one cell, in front-to-back order along the ray.
struct Segment {
  /// Distances along the ray in world units; t_in <= t_out.
  double t_in, t_out;
  /// The scalar where the ray comes in and goes out, linear in between (exactly so in a
  /// tetrahedron). NaN where a value that takes part is.
  float s_in, s_out;
  /// Number of the cell in the walkable mesh.
  std::uint32_t cell;
  /// Quadratic: the scalar half way is inner[0]. Cubic: at a third and at two thirds of the way.
  /// Linear: unused.
  ScalarOrder order = ScalarOrder::linear;
  float inner[2] = {0, 0};
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
