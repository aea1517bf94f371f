/// What is wrong with the settings of a picture: for render().
#pragma once

#include "plume/lib/render.h"

namespace plume {

/// Throws Error, naming the value, where the settings are wrong or do not fit the scene.
void check_settings(const Scene& scene, const RenderSettings& settings);

}  // namespace plume
