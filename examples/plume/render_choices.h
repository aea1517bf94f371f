/// From what `plume render` is told to a scene, settings and a camera. All throw Error, naming the
/// option and its value, where that is wrong.
#pragma once

#include "console.h"
#include "plume/io/image_file.h"
#include "plume/lib/plume.h"
#include "render_arguments.h"

namespace plume::command {

void choose_transfer_function(Scene& scene, const RenderArguments& args, const Console& console);

/// Light and clip planes need no mesh: what is wrong with them is said before a long read.
void choose_light_and_clip(const RenderArguments& args, RenderSettings& settings);

/// Adds isosurfaces and intervals to what the transfer function shows.
void choose_classification(Scene& scene, const RenderArguments& args, const Console& console);

Camera choose_camera(const Bounds& bounds, const RenderArguments& args, double aspect_ratio);

void choose_background(const std::string& text, ImageFileOptions& options);

}  // namespace plume::command
