/// The segment integral by adaptive quadrature, to a tolerance: the reference.
#pragma once

#include <span>

#include "plume/preint/pieces.h"
#include "plume/preint/precise_color.h"
#include "plume/preint/scalar_polynomial.h"
#include "plume/preint/segment_optics.h"
#include "plume/preint/transfer_function.h"

namespace plume {

/// Integrates along the segment, in double, with nothing expanded, fitted or tabulated: neither psi
/// nor a table. The segment is cut at the extrema of the scalar's polynomial and where that crosses
/// a knot; between two such places extinction is a polynomial, whose integral is the optical depth
/// so far, and color * extinction * exp(-optical depth so far) is entire, so that Gauss quadrature
/// with 4 and 8 nodes, halving where the two differ, gets to any tolerance.
///
/// Takes polynomials of degree 1 to 3 whole. Max error: r, g and b `tolerance` times the largest
/// colour of the transfer function's knots, twice, and what places are off by, 1e-12 of the
/// segment; alpha and optical depth the latter alone; then rounding to floats.
class AdaptiveIntegrator {
 public:
  static constexpr double default_tolerance = 1e-9;  ///< see tolerance()
  static constexpr int highest_degree = 3;           ///< of the polynomials that integrate() takes

  /// Requires !transfer_function.problem() and a tolerance of 1e-13 to 1. Keeps a copy.
  explicit AdaptiveIntegrator(const TransferFunction& transfer_function,
                              double tolerance = default_tolerance);

  /// As SegmentIntegrator has it.
  SegmentColor integrate(float s_in, float s_out, float length) const {
    return integrate(ScalarPolynomial::linear(s_in, s_out), length);
  }
  /// Likewise.
  float optical_depth(float s_in, float s_out, float length) const {
    return optical_depth(ScalarPolynomial::linear(s_in, s_out), length);
  }

  /// Of a segment along which the scalar is a polynomial.
  SegmentColor integrate(const ScalarPolynomial& scalar, float length) const {
    return integrate_precisely(scalar, length).rounded();
  }
  /// Likewise.
  float optical_depth(const ScalarPolynomial& scalar, float length) const;

  /// Before rounding to floats.
  PreciseColor integrate_precisely(const ScalarPolynomial& scalar, double length) const;

  /// Of colours, in shares of the largest of the transfer function.
  double tolerance() const { return tolerance_; }
  /// The transfer function between its knots.
  const Pieces& pieces() const { return pieces_; }

 private:
  Pieces pieces_;
  double tolerance_;
  double largest_color_ = 0;
};

static_assert(CurvedSegmentIntegrator<AdaptiveIntegrator>);

struct CurvedPiece;

/// The same of a segment that is cut already (see cut_at_knots). `largest_color` is that of the
/// knots.
PreciseColor integrate_curved(std::span<const CurvedPiece> pieces, double length, double tolerance,
                              double largest_color);

}  // namespace plume
