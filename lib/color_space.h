/// Interpolation of display colours in the colour spaces that VTK's colour maps use.
#pragma once

#include <array>

#include "plume/lib/color_map.h"

namespace plume {

/// The display (sRGB) colour a fraction t, 0 to 1, of the way from a to b, each channel within 0 to
/// 1. As vtkColorTransferFunction: ColorMap::Space::step gives b; hsv does not go through hue 0
/// (HSVWrap off, as ParaView sets it); lab is CIELAB of a D65 white; diverging goes through white
/// between two saturated colours of different hue (K. Moreland, "Diverging color maps for
/// scientific visualization", 2009).
std::array<double, 3> interpolate(ColorMap::Space space, const std::array<double, 3>& a,
                                  const std::array<double, 3>& b, double t);

}  // namespace plume
