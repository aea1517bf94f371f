/// Isosurfaces, intervals, light and clip planes on the command line.
#pragma once

#include <string>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/preint/classification.h"

namespace plume::command {

/// "VALUE[:OPACITY[:R,G,B]]": opaque and of the transfer function's colour for the value unless
/// said otherwise. R, G, B are display values, 0 to 1. Throws Error, naming the text.
Isosurface parse_isosurface(const std::string& text, const TransferFunction& colors);

/// "LOW,HIGH[:OPACITY[:R,G,B]]": half opaque, and of the transfer function's colours over its range
/// unless said otherwise; opacity is spread evenly over the interval. Throws Error, naming the
/// text.
IntervalVolume parse_interval(const std::string& text, const TransferFunction& colors);

/// "head[:INTENSITY]", or "X,Y,Z[:INTENSITY]" of the direction towards a light. Throws Error,
/// naming the text.
Light parse_light(const std::string& text);

/// "X,Y,Z,NX,NY,NZ": a point of the plane, and the normal, which points to what is kept. Throws
/// Error, naming the text.
ClipPlane parse_clip_plane(const std::string& text);

/// "X0,Y0,Z0,X1,Y1,Z1": the planes of a box from its low to its high corner. Throws Error, naming
/// the text.
std::vector<ClipPlane> parse_clip_box(const std::string& text);

}  // namespace plume::command
