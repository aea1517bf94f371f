/// The volumes of a picture that has several.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/lib/frame.h"
#include "plume/lib/mixed_ray.h"
#include "plume/lib/ray_through.h"
#include "plume/lib/shading.h"
#include "plume/preint/interval_state.h"
#include "plume/preint/linear_parts.h"
#include "plume/preint/optical_depth.h"

namespace plume {

/// One of them, ready for rays. Safe to share between threads.
struct VolumeOfSeveral {
  const Scene* scene;
  LinearParts parts;
  OpticalDepth depth;  ///< of its transfer function
  double tolerance;    ///< of the linear parts of segments, in the field's unit
  /// The first volume that shows the same field in the same way: where one of them ends and the
  /// other begins, a visit to an interval goes on and an isosurface is crossed.
  std::size_t look;
};

/// All of them, in the frame's order.
std::vector<VolumeOfSeveral> volumes_of(const Frame& frame);

/// Follows a ray through a volume as far as `limit`; no segment is cut there. Where the volume
/// `bounds` what is seen, the limit comes down to where it hides all that is behind by itself: by
/// twice what early termination asks for, so that the picture does not depend on the limit.
TraceResult follow(const VolumeOfSeveral& volume, const Frame& frame, const Ray& ray, bool bounds,
                   double& limit, RayThrough& through);

/// Hands what rays met of the volumes to a MixedRay, in the order along the ray. Volumes that only
/// touch, and look the same, are one as far as intervals and isosurfaces are concerned. One for
/// each thread; keeps references.
class MixedVolumes {
 public:
  MixedVolumes(const Frame& frame, const std::vector<VolumeOfSeveral>& volumes, bool hits);

  /// `throughs`: of the ray, one for each volume.
  const MixedRay& make(const Ray& ray, const std::vector<RayThrough>& throughs, Counts& counts);

  /// The direction in which the scalar rises at a hit of the last ray, of length one; NaN where
  /// there is none.
  std::array<double, 3> normal(const MixedHit& hit) const;

 private:
  struct Walk {
    IntervalState state;
    double end;
    std::size_t next;  // segment
    Shading visit;     // of the interval that the ray is in
  };
  // A piece of a segment along which the scalar is linear, or is taken for it.
  struct Piece {
    std::size_t volume;
    std::uint32_t cell;
    float s_in, s_out;
    double t_in, length;
  };

  void begin(std::size_t volume, double t);
  void take(std::size_t volume, const Segment& segment);
  template <class PlaceOf>
  void take(const Piece& piece, const PlaceOf& place_of);
  void put(const Piece& piece, const ClassifiedPart& part, double place);
  std::array<double, 3> gradient(std::size_t volume, std::uint32_t cell, double t) const;
  Shading shading(const Piece& piece, double t) const;

  const Frame& frame_;
  const std::vector<VolumeOfSeveral>& volumes_;
  MixedRay mixed_;
  std::vector<Walk> walks_;
  const Ray* ray_ = nullptr;
  Counts* counts_ = nullptr;
};

}  // namespace plume
