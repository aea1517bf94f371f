/// From what `plume render` is told to a scene, settings and a camera. All throw Error, naming the
/// option and its value, where that is wrong.
#pragma once

#include "console.h"
#include "plume/io/image_file.h"
#include "plume/lib/plume.h"
#include "render_arguments.h"

namespace plume::command {

/// Whether --tf names a file, which has a range of its own, and not a preset.
bool is_color_map_file(const std::string& transfer_function);

/// A colour map that fits what is shown, and over which distance its opacity applies.
struct FittedLook {
  ColorMap map;
  double unit_distance;
};

/// Fitted to the scene alone.
FittedLook look_fitted_to(const Scene& scene);

void choose_transfer_function(Scene& scene, const FittedLook& fitted, const RenderArguments& args,
                              const Console& console);

/// Light and clip planes need no mesh: what is wrong with them is said before a long read.
void choose_light_and_clip(const RenderArguments& args, RenderSettings& settings);

/// Needs no mesh either. Requires that the mode is set.
void choose_gray_range(const RenderArguments& args, RenderSettings& settings);

/// Adds isosurfaces and intervals to what the transfer function shows.
void choose_classification(Scene& scene, const RenderArguments& args, const Console& console);

/// The camera of the first frame. Fitted to the bounds, or to all ways in which an orbit sees them,
/// unless its position is given.
Camera choose_camera(const Bounds& bounds, const RenderArguments& args, double aspect_ratio);

/// That camera `turn` degrees further about view up, as it was before any elevation.
Camera turned(const Camera& first, const RenderArguments& args, double turn);

/// The camera in one line, for files.
std::string describe_camera(const Camera& camera);

void choose_background(const std::string& text, ImageFileOptions& options);

}  // namespace plume::command
