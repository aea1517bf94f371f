/// Rays that find the cells that matter to them in a hierarchy, rather than walk to them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "plume/traverse/ray_bundle.h"
#include "plume/traverse/searched_ray.h"

namespace plume {

/// Scalars that matter: those from `from` to below `below`. A cell matters whose values reach both.
/// An isovalue is {value, value}: it is crossed between what is below it and what is not.
struct ScalarWindow {
  float from = 0, below = 0;
};

/// What is looked for along rays.
struct SoughtSegments {
  /// Segments matter whose scalars, which are linear along them, reach one of these.
  std::span<const ScalarWindow> windows;
  /// How much of what lies behind a segment is hidden by it, from 0 to 1, at the least; for several
  /// threads. Nothing: no segment hides anything.
  std::function<double(const Segment&)> opacity;
  /// That is not asked as long as segments cannot hide enough, as none hides more than
  /// 1 - exp(-greatest_extinction * its length).
  double greatest_extinction = std::numeric_limits<double>::infinity();
  /// What lies behind segments that together let no more than that through does not matter.
  double least_transmittance = 0;
  /// World length: passages closer than that count as one, and rays with anything that matters
  /// between the scalars of two such are declined. Negative where passages have nothing to do with
  /// each other.
  double connected = 0;
};

/// What cells are looked for in the order of: where they begin along the rays, or their values.
enum class CellKey : std::uint8_t { place, least, greatest };

/// Finds, for each ray of the bundle, the segments that matter, up to where they hide what lies
/// behind.
///
/// The segments are those of trace(), bit for bit: a cell's faces are decided and measured by the
/// walker's operations. What a walk knows besides, from the way to the cell, is checked as far as
/// it may matter, and the ray declined where it may:
///
/// - A place is never before the one that came before it. So it is in cells that are not special
///   (thin tetrahedra, crooked cells), but for rounding, which is looked into where a cell that
///   matters follows one that does not, and the ray comes by an edge; all special cells that the
///   ray goes through are looked at, and each must go forward.
/// - A walk begins at the boundary, and passages do not overlap: SearchedRay::finish().
///
/// `Cache` is LeafCache, of tetrahedra, or ClusterCache<Walker>, of a grid or of cells of any kind,
/// whose segments are those of order 1.
///
/// Requires a scalar on points; `found` has a place for each ray.
template <class Cache>
void find_segments(Cache& leaves, const SoughtSegments& sought, RayBundle& bundle,
                   std::span<SearchedRay> found);

/// The greatest scalar on each ray, or the least: of those on the faces of all cells that a walk
/// goes through, bit for bit; -infinity, or infinity, where a ray has none. `found` says which rays
/// are declined, for the reasons above.
template <class Cache>
void find_greatest(Cache& leaves, RayBundle& bundle, std::span<SearchedRay> found,
                   std::span<float> values);
template <class Cache>
void find_least(Cache& leaves, RayBundle& bundle, std::span<SearchedRay> found,
                std::span<float> values);

}  // namespace plume
