/// From an error to a method.
///
/// What a picture's error is made of, and how each part of it is known:
///
/// - **Early termination**: a bound. A ray that ends at a transmittance T is off by at most T in
///   alpha and T times the greatest colour in a colour. It is given a tenth of the tolerance, half
///   where nothing else is to be chosen.
/// - **Integrator**: a bound. The closed form is exact up to rounding: kPacketError by packets,
///   kScalarError ray by ray, which is taken where packets' is too much. Where that is, too, the
///   integrator is the reference's.
/// - **Order of the scalar** in cells that are not tetrahedra: measured. A bound over what a cell's
///   corners allow is some hundred times what happens, for it cannot know that errors along a ray
///   cancel, and is infinite where a cell is degenerate. So candidates are compared with the
///   reference on this very picture: on a small version of all of it, and then, pixel by pixel, in
///   windows around the places where the small version is worst (see Pilot, whose estimate is
///   taken). Where packets make the picture, the adaptive order by packets stands in for the
///   reference as long as rounding is below 2% of the tolerance; these 2% are taken off.
///   tests/lib/planner_test.cpp and docs/evidence.md say how it fares. In the modes maximum,
///   minimum and depth a pixel's error is that of one place, and no sample finds the worst: there
///   the order is adaptive, to a tenth of the tolerance in shares of the field's range (1e-6 to
///   1e-4).
/// - **What is forced** is measured likewise, and the plan says so where it does not keep to the
///   tolerance.
///
/// The reference is order `adaptive` at a thousandth of the tolerance, 1e-6 to 1e-5 of the field's
/// range, by whole rays and adaptive quadrature. Where no candidate will do, it is the plan.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plume/lib/mode_difference.h"
#include "plume/lib/render.h"

namespace plume {

/// What packets' pictures may differ by from the scalar walker's in double, in a channel, per unit
/// of colour; and what rounding leaves in the latter. Measured in tests/lib/packets_test.cpp and
/// tests/lib/closed_form_scenes_test.cpp.
inline constexpr double kPacketError = 1e-5;
inline constexpr double kScalarError = 2e-6;
/// With intervals and isosurfaces, packets' places of hits are in single precision, and a highlight
/// may change much within that: twice the 2e-5 that has been met (docs/evidence.md).
inline constexpr double kClassifiedPacketError = 4e-5;

/// The settings of the reference: what errors are measured against. `max_error` says how closely it
/// follows the cells' interpolation.
RenderSettings reference_settings(RenderSettings settings, double max_error = 0);

/// Which of the candidates for the order a plan takes, and what it is known by.
struct ChosenOrder {
  std::size_t candidate = 0;
  /// Of the order's error, over all pictures on which it was looked at; and what was found when it
  /// was chosen.
  double estimate = 0, found = 0;
  /// What the next cheaper candidate had then, at least; infinite where there is none.
  double cheaper = 0;
  /// Whether it was chosen for another classification.
  bool of_other_look = false;
};

/// What a tolerance came to.
struct Plan {
  RenderSettings settings;           ///< without a tolerance
  std::vector<std::string> reasons;  ///< one choice a line
  /// Of the greatest error of a channel: bounds and estimates, added up.
  double error = 0;
  /// Whether that is within what was asked: false only where something was forced. In the modes
  /// maximum, minimum and depth at a forced order no sample shows that it is; then it says whether
  /// samples do not show the contrary.
  bool keeps = true;
  /// Where one was looked for on samples.
  std::optional<ChosenOrder> order;
};

/// Settings without `tolerance`, chosen to keep to it, and the reasons. Renders small pictures to
/// find out, where the scalar is not linear in all cells or something is forced.
///
/// `before`: the order chosen for another picture of the same settings. Of the same look it is
/// looked at shortly on this picture, and taken where its error, on this and those before, is
/// within what is asked; of another look as closely as any candidate, but before all others. What
/// is cheaper is tried again only where it may do by now.
///
/// Requires settings.tolerance, and what check_settings() lets pass.
Plan plan_for(const Scene& scene, const Camera& camera, const RenderSettings& settings,
              const ChosenOrder* before = nullptr);

}  // namespace plume
