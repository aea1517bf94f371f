/// What scalar values look like: a volume, interval volumes and isosurfaces in one model.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "plume/preint/transfer_function.h"

namespace plume {

/// All of space where the scalar lies in [low, high], as a thing with a look of its own: it depends
/// neither on its thickness in space nor on its width over the scalar axis.
struct IntervalVolume {
  float low = 0;   ///< the scalar at w = 0
  float high = 1;  ///< the scalar at w = 1
  /// Optics over w = (scalar - low) / (high - low) in [0, 1]; extinction is per unit of w. A ray
  /// that crosses the interval sees 1 - exp(-integral of the extinction over [0, 1]) of it.
  TransferFunction profile;

  /// The same in every number.
  bool operator==(const IntervalVolume&) const = default;
};

/// All of space where the scalar has one value: an interval volume of no width.
struct Isosurface {
  float value = 0;  ///< of the scalar
  /// Of each crossing, in [0, 1].
  float opacity = 1;
  /// Linear RGB (Rec. 709 primaries), >= 0.
  std::array<float, 3> color{1, 1, 1};

  /// The same in every number.
  bool operator==(const Isosurface&) const = default;
};

/// The optics of a scalar field, in up to three parts over the scalar axis. Source: Ament,
/// Weiskopf and Carr, "Direct Interval Volume Visualization" (TVCG 2010), section 4.
///
/// - The volume: extinction per unit of length.
/// - Interval volumes, each of which cuts its range, ends included, out of the volume. Two may have
///   a gap between them or touch; where they touch, the common value belongs to the upper one.
/// - Isosurfaces, at any values, also inside of an interval or at one of its ends.
struct Classification {
  std::optional<TransferFunction> volume;  ///< nothing: no volume is seen
  std::vector<IntervalVolume> intervals;   ///< in any order
  std::vector<Isosurface> isosurfaces;     ///< in any order

  /// The same in every number.
  bool operator==(const Classification&) const = default;

  /// What is wrong, in one line that names the values and the remedy; nothing where all is well:
  /// the volume and the profiles have no problem (see TransferFunction), profiles have their knots
  /// in [0, 1], intervals are finite and wider than nothing and do not overlap, isovalues are
  /// finite and all different, opacities in [0, 1], colours finite and not negative.
  std::optional<std::string> problem() const;

  /// Whether there is nothing but a volume.
  bool is_plain_volume() const { return volume && intervals.empty() && isosurfaces.empty(); }
};

/// A profile of one colour that lets a ray that crosses the whole interval see `opacity` of it,
/// evenly over w. `opacity` is in [0, 1]; 1 counts as 1 - 2^-24, an optical depth of 16.6.
TransferFunction even_profile(float opacity, const std::array<float, 3>& color);

}  // namespace plume
