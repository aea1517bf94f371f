/// The optics along a segment on which the scalar is a polynomial, cut at the knots.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "plume/preint/pieces.h"
#include "plume/preint/scalar_polynomial.h"

namespace plume {

/// A part of a segment on which extinction and colour are polynomials, as the scalar runs
/// monotonically and between two knots: each is base + slope * (scalar - scalar at the part's
/// front), and the scalar has powers[0] v + powers[1] v^2 + powers[2] v^3 more than there, over v
/// in [0, 1] from the part's front to its back.
struct CurvedPiece {
  double share;  ///< of the segment
  std::array<double, 3> powers;
  PreciseOptics base;
  PreciseOptics slope;  ///< per unit of the scalar

  double scalar_change(double v) const { return v * (powers[0] + v * (powers[1] + v * powers[2])); }
  double extinction(double v) const {
    return base.extinction + slope.extinction * scalar_change(v);
  }
  /// Integral of the extinction from 0 to v: the optical depth of a piece of length 1. Exact.
  double depth(double v) const {
    return v * (base.extinction +
                slope.extinction * v * (powers[0] / 2 + v * (powers[1] / 3 + v * powers[2] / 4)));
  }
};

/// Cuts a segment at the polynomial's extrema and where it crosses knots, each place found to 1e-12
/// of the segment (ScalarPolynomial::place_of), and replaces what `list` holds by the parts, front
/// to back; their shares add up to 1. None where a value of the polynomial is not finite. A
/// constant scalar at a step takes the later knot, as everywhere.
void cut_at_knots(const Pieces& pieces, const ScalarPolynomial& scalar,
                  std::vector<CurvedPiece>& list);

}  // namespace plume
