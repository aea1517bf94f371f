/// The segment integral by equal samples: the baseline.
#pragma once

#include "plume/preint/optical_depth.h"
#include "plume/preint/segment_optics.h"
#include "plume/preint/transfer_function.h"

namespace plume {

/// Cuts a segment into n equal parts and takes each to be uniform, with the optics of its middle.
///
/// Error: none for uniform optics; otherwise proportional to 1/n^2 while no knot lies within the
/// segment (and nearly so across knots), and 1/n across a step. No bound on it: what a part's
/// middle does not see, however opaque, is not there.
class MidpointIntegrator {
 public:
  /// Requires !transfer_function.problem() and samples >= 1. Keeps a copy.
  explicit MidpointIntegrator(const TransferFunction& transfer_function, int samples = 1);

  /// See SegmentIntegrator.
  SegmentColor integrate(float s_in, float s_out, float length) const;

  /// The optical depth of the same samples, so that alpha = 1 - exp(-optical_depth).
  float optical_depth(float s_in, float s_out, float length) const;

  int samples() const { return samples_; }  ///< of each segment

 private:
  Pieces pieces_;
  int samples_;
};

static_assert(SegmentIntegrator<MidpointIntegrator>);

}  // namespace plume
