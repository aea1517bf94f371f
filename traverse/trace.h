/// A ray through a whole mesh: entries, walks, and the segments that a visitor gets.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "plume/traverse/boundary.h"
#include "plume/traverse/inner_scalar.h"
#include "plume/traverse/segment.h"

namespace plume {

/// Shortens a segment to [from, to]; the scalar stays the same polynomial along it. Requires that
/// they overlap.
inline void cut(Segment& segment, double from, double to) {
  const Segment whole = segment;
  auto share_of = [&whole](double t) { return (t - whole.t_in) / (whole.t_out - whole.t_in); };
  double first = 0, last = 1;
  if (whole.t_in < from) {
    first = share_of(from);
    segment.t_in = from;
    segment.s_in = static_cast<float>(scalar_at(whole, first));
  }
  if (whole.t_out > to) {
    last = share_of(to);
    segment.t_out = to;
    segment.s_out = static_cast<float>(scalar_at(whole, last));
  }
  if (whole.order == ScalarOrder::linear || (first == 0 && last == 1)) return;
  auto inner = [&](double share) {
    return static_cast<float>(scalar_at(whole, first + share * (last - first)));
  };
  if (whole.order == ScalarOrder::quadratic) {
    segment.inner[0] = inner(0.5);
  } else {
    segment.inner[0] = inner(1.0 / 3);
    segment.inner[1] = inner(2.0 / 3);
  }
}

/// Follows a ray through a mesh and calls `visit(const Segment&)` for each cell, front to back,
/// until that returns false or the mesh ends.
///
/// Within one passage from boundary to boundary the segments join without gap: t_in is the t_out
/// before it, bit for bit, and so are the scalars. In a mesh whose cells overlap, where the ray
/// would have to go back, the segment has length zero instead. A mesh that is not convex is left
/// and entered again; passages come in the order of their entries. What one passage has covered the
/// next does not cover again (parts that overlap, or blocks that touch along the ray): no length is
/// counted twice. Where a segment is cut (there, at t_min, at t_max) its scalar is that of the
/// whole.
///
/// Above `linear`, segments get inner values where their cells are not linear (inner_scalar.h);
/// `adaptive` makes several segments of one cell where it needs them.
template <class Walker, class Visit>
TraceResult trace(const typename Walker::Mesh& mesh, const BoundaryIndex<Walker>& boundary,
                  const Ray& ray, Visit&& visit, const ScalarRequest& request = {}) {
  TraceResult result;
  ShearedFrame frame;
  if (!frame.set(ray, mesh.frame)) return result;
  Walker walker(mesh, frame);
  // The map from a way into a cell to the way into the next is one-to-one, so a walk cannot come
  // back to where it was. Each cell of n faces has at most n ways in; this guards against a mesh
  // that was changed under our feet.
  const std::uint64_t longest = 64 * static_cast<std::uint64_t>(mesh.cell_count()) + 64;

  double seen_until = ray.t_min;
  Entries<Walker> entries;
  std::optional<Entry> entry = entries.first(boundary, walker, frame);
  for (; entry; entry = entries.next(boundary, walker, frame)) {
    double t_in = frame.t(entry->place.z);
    if (t_in > ray.t_max) break;
    ++result.entries;
    double z_in = entry->place.z;
    float s_in = entry->place.scalar;
    walker.enter(mesh.boundary[entry->boundary], entry->rank);
    std::uint64_t steps = 0;
    do {
      const std::uint32_t cell = walker.cell();
      const std::optional<Crossing> exit = walker.leave();
      if (!exit || ++steps > longest) {
        result.end = WalkEnd::lost;
        return result;
      }
      Segment segment{t_in, std::max(t_in, frame.t(exit->z)), s_in, exit->scalar, cell};
      const double z_from = std::exchange(z_in, exit->z);
      t_in = segment.t_out;
      s_in = segment.s_out;
      if (!mesh.cell_values.empty()) segment.s_in = segment.s_out = mesh.cell_values[cell];
      if (segment.t_out < seen_until) continue;
      ++result.cells;
      // Where the ray would have to go back, its ends are not where the scalars are.
      const bool bends = request.order != ScalarOrder::linear && segment.t_in == frame.t(z_from) &&
                         segment.t_out == frame.t(exit->z);
      bool more = true;
      if (bends && request.order == ScalarOrder::adaptive && mesh.cell_values.empty() &&
          z_from != exit->z) {
        auto place_at = [&](double share) {
          return frame.local(z_from + share * (exit->z - z_from));
        };
        more = for_each_close_part(mesh, place_at, request.tolerance, segment, [&](Segment part) {
          if (part.t_out < seen_until || part.t_in > ray.t_max) return true;
          cut(part, seen_until, ray.t_max);
          return static_cast<bool>(visit(std::as_const(part)));
        });
      } else {
        if (bends) sample_inside(mesh, frame, z_from, exit->z, request.order, segment);
        cut(segment, seen_until, ray.t_max);
        more = visit(std::as_const(segment));
      }
      if (!more) {
        result.end = WalkEnd::stopped;
        return result;
      }
    } while (t_in <= ray.t_max && walker.advance());
    seen_until = std::max(seen_until, t_in);
  }
  return result;
}

}  // namespace plume
