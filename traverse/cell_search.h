/// Rays that find the cells that matter to them in a hierarchy, rather than walk to them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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

/// An isovalue that is looked for.
struct SoughtIsovalue {
  float value = 0;
  /// Nothing behind the surface matters.
  bool opaque = false;
};

/// What cells are looked for in the order of: where they begin along the rays, or their values.
enum class CellKey : std::uint8_t { place, least, greatest };

/// Finds, for each ray of the bundle, the segments on which the points' scalar crosses one of the
/// isovalues (a value equal to it counts as above), up to the first one that is opaque.
///
/// The segments are those of trace(), bit for bit: a cell's faces are decided and measured by the
/// walker's operations. What a walk knows besides, from the way to the cell, is checked as far as
/// it may matter, and the ray declined where it may:
///
/// - A place is never before the one that came before it. So it is in cells that are not special
/// (thin tetrahedra, crooked cells),
///   but for rounding, which is looked into where the ray comes by an edge; all special cells that
///   the ray goes through are looked at, and each must go forward.
/// - A walk begins at the boundary, and passages do not overlap: SearchedRay::finish().
///
/// `Cache` is LeafCache, of tetrahedra, or ClusterCache<Walker>, of a grid or of cells of any kind,
/// whose segments are those of order 1.
///
/// Requires a scalar on points. `isovalues` are finite, ascending and different; `found` has a
/// place for each ray. Passages closer than `connected`, in world units, count as one.
template <class Cache>
void find_isosurfaces(Cache& leaves, std::span<const SoughtIsovalue> isovalues, double connected,
                      RayBundle& bundle, std::span<SearchedRay> found);

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
