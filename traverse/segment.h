/// The seam between traversal and optics.
#pragma once

#include <cstdint>

namespace plume {

/// The polynomial that a cell's scalar is taken for along a segment: through the values at its ends
/// and none, one or two inside of the cell (inner_scalar.h). A segment may be linear whatever was
/// asked for: in tetrahedra, where cells are constant, and where the inside has no answer.
///
/// `adaptive` is a request alone: a cell's part of the ray then comes as one or several segments,
/// linear or cubic, which follow the cell's interpolation to a tolerance (ScalarRequest).
enum class ScalarOrder : std::uint8_t { linear = 1, quadratic = 2, cubic = 3, adaptive = 4 };

/// How closely segments are to follow the interpolation inside of cells.
struct ScalarRequest {
  ScalarOrder order = ScalarOrder::linear;
  /// `adaptive`: by how much the scalar may be off where it is looked at, in the field's unit.
  double tolerance = 0;

  ScalarRequest() = default;
  ScalarRequest(ScalarOrder asked, double off_by = 0) : order(asked), tolerance(off_by) {}
};

/// The part of a ray inside one cell, in front-to-back order along the ray.
struct Segment {
  /// Distances along the ray in world units; t_in <= t_out.
  double t_in, t_out;
  /// The scalar where the ray comes in and goes out. NaN where a value that takes part is.
  float s_in, s_out;
  /// Number of the cell in the walkable mesh.
  std::uint32_t cell;
  /// Quadratic: the scalar half way is inner[0]. Cubic: at a third and at two thirds of the way.
  /// Linear: unused.
  ScalarOrder order = ScalarOrder::linear;
  float inner[2] = {0, 0};
};

/// The scalar at a share, 0 to 1, of the way along a segment: its polynomial, by divided
/// differences. Source: Ament, Weiskopf and Carr, "Direct Interval Volume Visualization" (TVCG
/// 2010), equations 19 to 26.
inline double scalar_at(const Segment& segment, double share) {
  const double s_in = segment.s_in, s_out = segment.s_out;
  switch (segment.order) {
    case ScalarOrder::linear:
    case ScalarOrder::adaptive:
      break;
    case ScalarOrder::quadratic: {
      const double d01 = 2 * (segment.inner[0] - s_in), d12 = 2 * (s_out - segment.inner[0]);
      return s_in + share * (d01 + (share - 0.5) * (d12 - d01));
    }
    case ScalarOrder::cubic: {
      const double third = segment.inner[0], two_thirds = segment.inner[1];
      const double d01 = 3 * (third - s_in), d12 = 3 * (two_thirds - third);
      const double d23 = 3 * (s_out - two_thirds);
      const double d012 = 1.5 * (d12 - d01), d123 = 1.5 * (d23 - d12);
      return s_in + share * (d01 + (share - 1.0 / 3) * (d012 + (share - 2.0 / 3) * (d123 - d012)));
    }
  }
  return segment.s_in + share * (segment.s_out - segment.s_in);
}

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
