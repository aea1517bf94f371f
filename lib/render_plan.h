/// What a picture takes, in words: for render().
#pragma once

#include <string>
#include <vector>

#include "plume/lib/render.h"

namespace plume {

/// Whether the picture shows more than a volume.
bool is_classified(const Scene& scene, const RenderSettings& settings);

/// Whether the scalar is linear in every cell, so that orders are all the same.
bool has_linear_cells(const Scene& scene);

/// Whether the scalar is linear along every segment, as it is there and at order 1.
bool is_linear(const Scene& scene, const RenderSettings& settings);

/// What follows from the scene and the settings alone, one choice a line.
std::vector<std::string> describe_plan(const Scene& scene, const RenderSettings& settings);

}  // namespace plume
