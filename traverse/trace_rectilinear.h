/// A ray through a rectilinear grid, as trace.h has it for the other meshes.
#pragma once

#include <algorithm>

#include "plume/traverse/rectilinear_walker.h"
#include "plume/traverse/trace.h"

namespace plume {

/// A box needs no hierarchy over its boundary.
template <>
class BoundaryIndex<RectilinearWalker> {
 public:
  explicit BoundaryIndex(const WalkableRectilinear&) {}
};

/// The scalar along the walker's cell from t_in to t_out, which may be cut by the ray's range.
/// Linear: between the values on the cell's faces, as elsewhere. Beyond: the trilinear interpolant
/// itself at the segment's ends and in between; along a ray it is a cubic, so cubic is exact, and
/// what `adaptive` is.
inline void take_scalar(const RectilinearWalker& walker, const Ray& ray, ScalarOrder order,
                        Segment& segment) {
  const bool from_inside = segment.t_in<ray.t_min, to_inside = segment.t_out> ray.t_max;
  segment.order = order;
  if (order == ScalarOrder::linear) {
    if (from_inside || to_inside) cut(segment, ray.t_min, ray.t_max);
    return;
  }
  if (from_inside) segment.s_in = walker.scalar(segment.t_in = ray.t_min);
  if (to_inside) segment.s_out = walker.scalar(segment.t_out = ray.t_max);
  const double length = segment.t_out - segment.t_in;
  if (order == ScalarOrder::quadratic) {
    segment.inner[0] = walker.scalar(segment.t_in + 0.5 * length);
  } else {
    segment.inner[0] = walker.scalar(segment.t_in + length / 3);
    segment.inner[1] = walker.scalar(segment.t_in + length * (2.0 / 3));
  }
}

/// The order of the scalar that a grid's segments have where this one is asked for.
inline ScalarOrder order_in(const WalkableRectilinear& mesh, ScalarOrder asked) {
  if (!mesh.cell_values.empty()) return ScalarOrder::linear;
  return asked == ScalarOrder::adaptive ? ScalarOrder::cubic : asked;
}

/// The part of the ray in the walker's cell, between those scalars on points.
inline Segment segment_in(const WalkableRectilinear& mesh, const RectilinearWalker& walker,
                          const Ray& ray, ScalarOrder order, float s_in, float s_out) {
  const std::uint32_t cell = walker.cell();
  Segment segment{walker.t_in(), walker.t_out(), s_in, s_out, cell};
  if (!mesh.cell_values.empty()) segment.s_in = segment.s_out = mesh.cell_values[cell];
  take_scalar(walker, ray, order, segment);
  return segment;
}

/// Follows a ray and calls `visit(const Segment&)` for each visible cell, front to back, until that
/// returns false or the grid ends; what happens on vertices, edges and planes, see
/// rectilinear_walker.h.
///
/// Within one passage t_in is the t_out before it, bit for bit, and so are the scalars on points;
/// a passage ends where cells are hidden, and the next one counts as another entry. What lies
/// before t_min is not walked, and its entries are not counted. A cell-centred field is constant in
/// each cell, and linear whatever order is asked for. No ray is lost.
template <class Visit>
TraceResult trace(const WalkableRectilinear& mesh, const BoundaryIndex<RectilinearWalker>&,
                  const Ray& ray, Visit&& visit, const ScalarRequest& request = {}) {
  TraceResult result;
  RectilinearWalker walker(mesh);
  if (!walker.start(ray)) return result;
  const bool on_points = mesh.cell_values.empty();
  const bool any_hidden = !mesh.hidden.empty();
  const ScalarOrder order = order_in(mesh, request.order);
  float s_in = on_points ? walker.entry_scalar() : 0;
  for (bool inside = false;; walker.advance()) {
    const float s_out = on_points ? walker.exit_scalar() : 0;
    if (any_hidden && mesh.hidden[walker.cell()]) {
      inside = false;
    } else {
      if (!inside) ++result.entries;
      inside = true;
      ++result.cells;
      const Segment segment = segment_in(mesh, walker, ray, order, s_in, s_out);
      if (!visit(segment)) {
        result.end = WalkEnd::stopped;
        return result;
      }
    }
    if (walker.t_out() >= walker.end()) return result;
    s_in = s_out;
  }
}

}  // namespace plume
