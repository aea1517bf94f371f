/// The integrals behind the closed form of a segment with linear optics.
#pragma once

namespace plume {

/// They belong to a segment of unit length whose extinction runs linearly from `a` to `b`, so that
/// the optical depth so far is D(u) = a u + (b - a) u^2 / 2, and the whole one m = (a + b) / 2.
/// They depend on no transfer function. Source: Moreland and Angel, "A Fast High Accuracy Volume
/// Renderer for Unstructured Data", VolVis 2004, section 3 (psi, there tabulated over a and b); the
/// segment's integral in terms of the error function and Dawson's is Williams and Max, "A Volume
/// Density Optical Model", VolVis 1992.
///
/// Method, with d = (b - a) / 2: where m is above 1/4,
///     psi = g(a, d) - exp(-m) g(b, d),     g(x, d) = integral of exp(-x u - d u^2) from u = 0 on,
/// of which either is a function of one number, scaled: with s = sqrt(|d|) and y = s / (s + x / 2),
/// (s + x / 2) g is smooth over all of [0, 1], for each sign of d, and is read from a universal
/// table of polynomials. Below 1/4, chi is a power series in d whose coefficients are polynomials
/// in m, so that nothing cancels. Valid range: a, b in [0, 1e150].

/// The mean transparency so far, psi(a, b) = integral over [0, 1] of exp(-D(u)), in [0, 1].
/// Max error: 2e-9, absolute.
double psi(double a, double b);

/// chi(a, b) = psi(a, b) - exp(-D(1)) = integral over [0, 1] of u D'(u) exp(-D(u)), in [0, 1], but
/// without the cancellation that this difference suffers where the segment is nearly transparent.
/// Max error: 2e-9, absolute; 2e-8, relative, where the whole optical depth is at most 1.
double chi(double a, double b);

/// What a segment takes from what lies behind it, and chi.
struct Absorption {
  double absorbed;  ///< 1 - exp(-m), to 1e-10, relative
  double chi;       ///< see chi()
};

/// Both at once, as they share their exponential.
Absorption absorption(double a, double b);

/// 1 - exp(-depth), to 1e-10, relative; of a depth >= 0.
double absorbed(double depth);

}  // namespace plume
