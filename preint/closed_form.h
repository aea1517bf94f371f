/// The segment integral in closed form.
#pragma once

#include "plume/preint/optical_depth.h"
#include "plume/preint/precise_color.h"
#include "plume/preint/segment_optics.h"
#include "plume/preint/transfer_function.h"

namespace plume {

/// Exact for a linear scalar and a piecewise-linear transfer function, with no table per scene. The
/// segment is split at the knots; on each part of length l, extinction runs linearly from tau0 to
/// tau1 and colour from c0 to c1, and
///     T = exp(-(tau0 + tau1) l / 2),
///     C = c0 - c1 T + (c1 - c0) psi(tau0 l, tau1 l)
///       = c0 (1 - T) + (c1 - c0) chi(tau0 l, tau1 l),      chi = psi - T,
/// of which the second form keeps C's relative accuracy where the part is nearly transparent.
/// Source: Williams and Max, "A Volume Density Optical Model", VolVis 1992; Moreland and Angel, "A
/// Fast High Accuracy Volume Renderer for Unstructured Data", VolVis 2004.
///
/// Max error: alpha 1e-7; r, g, b 1e-7 times the largest colour of the transfer function's knots,
/// and 2e-7 of their own value where the optical depth is at most 1/8. Optical depth: 1e-7 of its
/// value. Steps are exact. A segment whose scalar is constant at a step takes the later knot; one
/// that begins or ends at a step sees its own side only. Valid range: any extinction and length.
class ClosedForm {
 public:
  /// Requires !transfer_function.problem(). Keeps a copy.
  explicit ClosedForm(const TransferFunction& transfer_function) : depth_(transfer_function) {}

  /// See SegmentIntegrator.
  SegmentColor integrate(float s_in, float s_out, float length) const;

  /// See SegmentIntegrator.
  float optical_depth(float s_in, float s_out, float length) const {
    return depth_(s_in, s_out, length);
  }

 private:
  OpticalDepth depth_;
};

static_assert(SegmentIntegrator<ClosedForm>);

/// The same in double, of a part along which the optics run linearly from `front` to `back`.
PreciseColor integrate_linear(const PreciseOptics& front, const PreciseOptics& back, double length);

/// The same in double, between two finite scalars.
PreciseColor integrate_linear(const Pieces& pieces, double s_in, double s_out, double length);

}  // namespace plume
