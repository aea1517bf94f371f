/// Compositing of what a ray meets of several volumes, which may overlap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "plume/preint/optics_sum.h"
#include "plume/preint/precise_color.h"

namespace plume {

/// Where a ray first meets an isosurface or comes into an interval, and of which volume.
struct MixedHit {
  double t = std::numeric_limits<double>::infinity();  ///< in world units along the ray
  std::size_t volume = 0;                              ///< of those of the picture
  std::uint32_t cell = 0;                              ///< of its walkable mesh
  float scalar = std::numeric_limits<float>::quiet_NaN();

  bool is_one() const { return t < std::numeric_limits<double>::infinity(); }
};

/// A part of a ray in one volume: a medium whose optics are linear from t_in to t_out, or something
/// thin at t_in.
struct MixedPart {
  double t_in, t_out;
  LinearOptics optics;  ///< of a medium
  bool is_thin = false;
  PreciseColor thin;    ///< its colour
  bool is_hit = false;  ///< whether it is of an isosurface or an interval...
  MixedHit hit;         ///< ...which the ray meets there
};

struct MixedRaySettings {
  double early_termination;  ///< transmittance at which the ray ends
  bool whole_ray;            ///< go on to its end whatever was seen
  bool first_only;           ///< end at the first hit, or, of media alone, where extinction begins
  bool hits;                 ///< whether there are isosurfaces or intervals
};

/// Parts are added in the order of their beginnings, those of each volume one after the other.
/// Between two places where a part begins or ends, the media that are there add up
/// (integrate_sum()); what is thin stands in front of what begins at the same place. The result
/// does not depend on how the volumes are numbered, not in the last bit.
class MixedRay {
 public:
  MixedRay(std::size_t volumes, const MixedRaySettings& settings);

  /// A new ray.
  void begin();
  /// Requires that no part before it begins later, and that go_to() was not asked to go beyond its
  /// beginning.
  void add(std::size_t volume, const MixedPart& part) { queues_[volume].parts.push_back(part); }
  /// Composites what lies before t; false once the ray has ended.
  bool go_to(double t);

  const PreciseColor& color() const { return color_; }
  double optical_depth() const { return optical_depth_; }
  /// Where extinction begins; infinite where there is none.
  double first_extinction() const { return first_extinction_; }
  const MixedHit& first_hit() const { return first_hit_; }

 private:
  struct Queue {
    std::vector<MixedPart> parts;
    std::size_t next = 0;

    bool empty() const { return next == parts.size(); }
    const MixedPart& front() const { return parts[next]; }
  };

  double next_start();
  bool composite_thin(double at);
  bool composite_media(double start, double horizon);
  bool take(const PreciseColor& color);
  void meet(const MixedPart& part);

  const MixedRaySettings settings_;
  std::vector<Queue> queues_;
  std::vector<LinearOptics> media_;
  double at_ = 0;
  PreciseColor color_;
  double transmittance_ = 1, optical_depth_ = 0, first_extinction_ = 0;
  MixedHit first_hit_;
};

}  // namespace plume
