/// Colour maps from ParaView's JSON files.
#pragma once

#include <filesystem>

#include "plume/lib/color_map.h"

namespace plume {

/// Reads ParaView's JSON (an array of maps, of which the first counts, or one map): "Name",
/// "ColorSpace" (RGB, HSV, Lab, CIELAB, Diverging, Step), "RGBPoints" [x, r, g, b, ...], "Points"
/// [x, opacity, midpoint, sharpness, ...], "NanColor" ignored.
///
/// Throws Error, naming the file, the point and the value, for what is no JSON, no map, points that
/// are unsorted, not finite, or outside of [0, 1] where they are colours or opacities.
ColorMap read_color_map(const std::filesystem::path& file);

}  // namespace plume
