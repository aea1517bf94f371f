/// One ray through the mesh, for a pixel and the further channels.
#pragma once

#include "plume/lib/clip.h"
#include "plume/lib/frame.h"
#include "plume/lib/pixel.h"
#include "plume/lib/scene_body.h"
#include "plume/traverse/trace_ranges.h"

namespace plume {

/// Hands the segments of what clip planes keep of a ray to `visit`.
template <class Walker, class Visit>
TraceResult trace_clipped(const Frame& frame, const Walkable<Walker>& walkable, Ray ray,
                          Visit&& visit) {
  if (!clip(ray, frame.settings().clip_planes)) return {};
  return trace(walkable.mesh, walkable.boundary, ray, visit,
               {frame.settings().order, frame.tolerance()});
}

/// Passes over the frame's empty space, where there is one. A visitor may say for itself what still
/// `matters(least, greatest)`, and be told to `pass_over()` what is left out.
template <class Visit>
TraceResult trace_clipped(const Frame& frame, const Walkable<RectilinearWalker>& walkable, Ray ray,
                          Visit&& visit) {
  if (!clip(ray, frame.settings().clip_planes)) return {};
  const ScalarRequest request{frame.settings().order, frame.tolerance()};
  const std::optional<EmptySpace>& space = frame.empty_space();
  if (!space) return trace(walkable.mesh, walkable.boundary, ray, visit, request);
  auto matters = [&](float least, float greatest) {
    if constexpr (requires { visit.matters(least, greatest); })
      return visit.matters(least, greatest);
    else
      return space->visible->meet(least, greatest);
  };
  auto pass_over = [&] {
    if constexpr (requires { visit.pass_over(); }) visit.pass_over();
  };
  return trace_ranges(walkable.mesh, *space->tree, ray, matters, visit, pass_over, request.order);
}

/// Gives the segments of a pixel's ray to `consumer` until that returns false, and fills in the
/// further channels, for which the ray may go on. `follow(visit)` calls visit(const Segment&) for
/// them, front to back, until it returns false; those without extinction may be left out.
template <class Walker, class Consumer, class Follow>
TraceResult follow_segments(Frame& frame, const Walkable<Walker>& walkable, const PixelPlace& pixel,
                            Consumer& consumer, const Follow& follow) {
  const ChannelPlaces& channels = frame.channels();
  if (!channels.any_of_segments()) return follow(consumer);
  FirstPixel first{frame.optical_depth(), frame.tolerance()};
  OpticalDepthPixel depth{frame.optical_depth(), frame.tolerance()};
  CellCountPixel cells;
  bool more = true, look = true;
  auto visit = [&](const Segment& segment) {
    if (look) look = first(segment);
    if (channels.optical_depth) depth(segment);
    cells(segment);
    if (more) more = consumer(segment);
    return more || channels.whole_rays();
  };
  const TraceResult result = follow(visit);
  frame.put(channels.depth, pixel, first.depth);
  frame.put(channels.optical_depth, pixel, depth.depth);
  frame.put(channels.cell_count, pixel, cells.value());
  frame.put(channels.cell_id, pixel, first.seen() ? walkable.mesh.original_cell(first.cell) : -1.0);
  return result;
}

/// The same of all segments of what clip planes keep of the ray.
template <class Walker, class Consumer>
TraceResult follow_ray(Frame& frame, const Walkable<Walker>& walkable, const PixelPlace& pixel,
                       Consumer& consumer) {
  return follow_segments(frame, walkable, pixel, consumer, [&](auto& visit) {
    return trace_clipped(frame, walkable, frame.ray(pixel), visit);
  });
}

}  // namespace plume
