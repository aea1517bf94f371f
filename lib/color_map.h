/// A colour map as editors write it, and the transfer function it becomes.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plume/preint/transfer_function.h"

namespace plume {

/// A colour map with opacity, as ParaView's editor has it: colours are display colours (sRGB),
/// opacity is per `unit distance`.
struct ColorMap {
  /// How colours are interpolated between two points.
  enum class Space { rgb, hsv, lab, diverging, step };
  /// A colour at a value.
  struct ColorPoint {
    double x = 0;                         ///< in the field's unit
    std::array<double, 3> srgb{0, 0, 0};  ///< 0 to 1
  };
  /// An opacity at a value.
  struct OpacityPoint {
    double x = 0;           ///< in the field's unit
    double opacity = 0;     ///< 0 to 1, over one unit distance
    double midpoint = 0.5;  ///< 0 to 1, as vtkPiecewiseFunction
    double sharpness = 0;   ///< 0 (linear) to 1 (step), as vtkPiecewiseFunction
  };
  std::string name;                     ///< as the editor calls it; may be empty
  Space space = Space::rgb;             ///< in which colours are interpolated
  std::vector<ColorPoint> colors;       ///< ascending x
  std::vector<OpacityPoint> opacities;  ///< ascending x; empty: a ramp from 0 to 1 over the colours
};

/// Maps the range of `map` linearly onto [low, high].
ColorMap rescaled(ColorMap map, double low, double high);

/// Resamples a colour map into linear colour and extinction, both piecewise linear:
/// extinction = -log(1 - opacity) / unit_distance * opacity_scale. An opacity of 1 counts as
/// 1 - 2^-24, an optical depth of 16.6 per unit distance. Knots are added until, halfway between
/// any two, colour is within 1e-3 and opacity over one unit distance within 1e-3 of the map.
/// Requires unit_distance > 0. Throws Error where the map is no map (too few points, x not
/// ascending, values outside of [0, 1]).
TransferFunction to_transfer_function(const ColorMap& map, double unit_distance,
                                      double opacity_scale = 1);

/// Names of the built-in colour maps: "cool-warm", "viridis", "inferno", "turbo", "gray",
/// "rainbow".
std::vector<std::string> preset_names();

/// A built-in colour map over [0, 1] with an opacity ramp; nothing for an unknown name.
std::optional<ColorMap> preset(const std::string& name);

}  // namespace plume
