/// Light on isosurfaces and intervals.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "plume/preint/segment_optics.h"

namespace plume {

/// A light that is white and infinitely far away.
struct Light {
  /// Towards the light, of any length but zero; nothing for a headlight, which shines along each
  /// ray.
  std::optional<std::array<double, 3>> direction;
  double intensity = 1;  ///< >= 0 and finite

  /// The same in every number.
  bool operator==(const Light&) const = default;
};

/// Phong's model with Blinn's half vector: on a surface of colour c,
///     c (ambient + diffuse sum(intensity (n . l))) + specular sum(intensity (n . h)^exponent),
/// where n is the normal on the viewer's side (surfaces are two-sided), l points towards the light
/// and h halfway between it and the viewer. Lights on the other side add nothing.
struct Lighting {
  std::vector<Light> lights{{}};  ///< by default one headlight
  double ambient = 0.2;           ///< >= 0
  double diffuse = 0.8;           ///< >= 0
  double specular = 0.25;         ///< >= 0
  double exponent = 30;           ///< > 0
  /// Light intervals by the normal where the ray comes in, too.
  bool intervals = true;

  /// The same in every number.
  bool operator==(const Lighting&) const = default;

  /// What is wrong, in one line that names the value; nothing where all is well.
  std::optional<std::string> problem() const;
};

/// What light makes of a colour; as it stands, nothing.
struct Shading {
  float factor = 1;     ///< of the colour
  float highlight = 0;  ///< white, to be added, as opaque as the colour

  /// The colour in that light.
  SegmentColor applied(const SegmentColor& color) const {
    const float white = highlight * color.alpha;
    return {color.r * factor + white, color.g * factor + white, color.b * factor + white,
            color.alpha};
  }
};

/// Light on a surface across `gradient`, seen along `direction` (of length one). Where the gradient
/// is zero or not finite there is no normal, and the colour stays as it is.
Shading shading_of(const Lighting& lighting, const std::array<double, 3>& gradient,
                   const std::array<double, 3>& direction);

}  // namespace plume
