/// What a part of an interval volume adds to a picture.
#pragma once

#include <cstdint>

#include "plume/preint/closed_form.h"
#include "plume/preint/segment_optics.h"
#include "plume/preint/transfer_function.h"

namespace plume {

/// The two forms of Ament, Weiskopf and Carr 2010, equations 12 and 13.
enum class IntervalForm : std::uint8_t {
  /// alpha = 1 - exp(-integral of tau); colour attenuated by what of the interval lies before it.
  exponential,
  /// alpha = integral of tau, at most 1; colour = integral of color * tau, as far as alpha goes:
  /// without self-attenuation.
  linear,
};

/// Integrates one interval's profile over parts of w in [0, 1], which a ray sees one after the
/// other with other things between.
///
/// Exponential: parts composite to the whole by themselves. Linear: they would not, and each part
/// is divided by 1 - the opacity of those before it (equations 28 to 31, of which this is the form
/// for parts of any size), so that compositing adds up opacities.
///
/// Max error: that of ClosedForm for the exponential form, 2e-7 for the linear one, both relative
/// to the largest colour.
class IntervalOptics {
 public:
  /// Requires a profile without problem.
  IntervalOptics(const TransferFunction& profile, IntervalForm form)
      : profile_(profile), depth_(profile), form_(form) {}

  /// From w_from to w_to, both in [0, 1], of a visit that began at the end of the interval away
  /// from w_to: at 0 where w rises, at 1 where it falls.
  SegmentColor integrate(float w_from, float w_to) const;

  /// Integral of the extinction over a part, whatever the form.
  float optical_depth(float w_from, float w_to) const;

 private:
  SegmentColor integrate_linear(float w_from, float w_to) const;

  ClosedForm profile_;
  OpticalDepth depth_;
  IntervalForm form_;
};

}  // namespace plume
