/// What a picture takes, in words: for render().
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plume/lib/render.h"
#include "plume/preint/integrator.h"

namespace plume {

/// Whether the picture shows more than a volume.
bool is_classified(const Scene& scene, const RenderSettings& settings);

/// Whether the scalar is linear in every cell, so that orders are all the same.
bool has_linear_cells(const Scene& scene);

/// Whether the scalar is linear along every segment, as it is there and at order 1.
bool is_linear(const Scene& scene, const RenderSettings& settings);

/// Whether what has no extinction may be seen, as a table blurs what is between its entries: then
/// no part of a ray may be passed over.
bool is_blurred(const Scene& scene, const RenderSettings& settings);

/// What follows from the scene and the settings alone, one choice a line.
std::vector<std::string> describe_plan(const Scene& scene, const RenderSettings& settings);

/// What a table costs and how far off it is; nothing where the integrator has none.
std::optional<std::string> describe_table(const Integrator& integrator);

}  // namespace plume
