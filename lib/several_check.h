/// What is wrong with a picture of several scenes: for render().
#pragma once

#include <string>
#include <vector>

#include "plume/lib/render.h"

namespace plume {

/// What messages call one of several scenes.
std::string name_of(const std::vector<const Scene*>& scenes, std::size_t index);

/// Throws Error, naming the value, where the settings are wrong, do not fit one of the scenes, or
/// ask for what several scenes have no answer to.
void check_several(const std::vector<const Scene*>& scenes, const RenderSettings& settings);

}  // namespace plume
