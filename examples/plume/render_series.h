/// The pictures of `plume render`, one after the other.
#pragma once

#include "console.h"
#include "plume/io/image_file.h"
#include "plume/lib/plume.h"
#include "render_arguments.h"

namespace plume::command {

/// Reads the time steps that are asked for and makes a picture of each, or one from each place of
/// an orbit. Says what it does. Throws Error; pictures that are there by then stay.
void render_series(const RenderArguments& args, RenderSettings settings,
                   ImageFileOptions file_options, const Console& console);

}  // namespace plume::command
