/// The oracle for interval volumes: one ray, in double, by the paper's algorithm 2 to the letter.
///
/// Shares no code with preint; the only thing taken from there is the classification as data.
#pragma once

#include <vector>

#include "plume/preint/classification.h"
#include "plume/tests/reference/adaptive_quadrature.h"

namespace plume::reference {

/// The scalar runs linearly from s_in to s_out.
struct LinearPiece {
  double s_in, s_out, length;
};

/// Ament, Weiskopf and Carr 2010: algorithm 2 on subsegments that are so short that each holds one
/// end of an interval or one isovalue at most, with the ranges of equation 27; the clipped interval
/// of section 6.4 at the start. Integrals by adaptive quadrature. `linear` takes the right sides of
/// equations 12 and 13, with the correction of equations 28 to 31.
///
/// For pieces that join. No scalar may equal a bound, nor an isovalue the end of an interval:
/// what happens then the paper leaves open.
Radiance interval_walk(const Classification& classification, const std::vector<LinearPiece>& pieces,
                       bool linear = false);

}  // namespace plume::reference
