/// Several media that fill the same stretch of a ray.
#pragma once

#include <span>

#include "plume/preint/pieces.h"
#include "plume/preint/precise_color.h"

namespace plume {

/// One of them: extinction and colour run linearly from the front of the stretch to its back.
struct LinearOptics {
  PreciseOptics front;  ///< towards the eye
  PreciseOptics back;   ///< away from it

  /// The mean extinction, per unit of length.
  double mean_extinction() const { return (front.extinction + back.extinction) / 2; }
  /// Those of the part between two shares of the stretch, 0 to 1.
  LinearOptics part(double from, double to) const;
  /// In the order of their numbers.
  bool operator<(const LinearOptics& other) const;
};

/// What the stretch adds to a picture. Media do not hide each other, they mix: extinction is the
/// sum of theirs, and so is emission, color * extinction. The sum of linear extinctions is linear,
/// so the optical depth so far is a quadratic D(u), as of one medium; but where colours differ,
/// emission is a quadratic, too, of which the closed form of one medium (closed_form.h) knows
/// nothing. So
///     C = integral of emission(u) exp(-D(u)) du
/// is taken by Gauss quadrature with eight nodes, on parts of an optical depth of at most 1, of
/// which what is visible has no more than 40. Between such parts' ends the integrand is an
/// exponential of a quadratic that falls by no more than 1, whatever the media.
///
/// Max error: 1e-13 of the largest colour, for any extinction and length; alpha 1e-15. One medium
/// alone is integrate_linear(). `length` >= 0, in world units.
PreciseColor integrate_sum(std::span<const LinearOptics> media, double length);

}  // namespace plume
