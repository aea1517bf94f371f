/// The two integrals behind the closed form of a segment with linear optics.
#pragma once

namespace plume {

/// Both belong to a segment of unit length whose extinction runs linearly from `a` to `b`, so that
/// the optical depth so far is D(u) = a u + (b - a) u^2 / 2, and the whole one (a + b) / 2. They
/// depend on no transfer function. Source: Moreland and Angel, "A Fast High Accuracy Volume
/// Renderer for Unstructured Data", VolVis 2004, section 3 (psi, there tabulated); the segment's
/// integral in terms of the error function is Williams and Max, "A Volume Density Optical Model",
/// VolVis 1992.
///
/// Method: Gauss-Legendre quadrature with 4, 8 or 16 nodes as the optical depth grows; beyond a
/// depth of 20 only the part of the segment that can still be seen. Valid range: a, b in [0,
/// 1e150].

/// The mean transparency so far, psi(a, b) = integral over [0, 1] of exp(-D(u)), in [0, 1].
/// Max error: 1e-8, absolute.
double psi(double a, double b);

/// chi(a, b) = psi(a, b) - exp(-D(1)) = integral over [0, 1] of u D'(u) exp(-D(u)), in [0, 1], but
/// without the cancellation that this difference suffers where the segment is nearly transparent.
/// Max error: 1e-8, absolute; 5e-8, relative, where the whole optical depth is at most 1.
double chi(double a, double b);

}  // namespace plume
