/// What of a rectilinear grid a frame passes over, as nothing is to be seen there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plume/lib/render.h"
#include "plume/lib/scene.h"
#include "plume/mesh/range_tree.h"
#include "plume/preint/visible_scalars.h"

namespace plume {

/// Refers to the scene's tree.
struct EmptySpace {
  const RangeTree* tree;
  /// Of the modes that show the classification; the greatest and the least scalar know for
  /// themselves what still matters.
  std::optional<VisibleScalars> visible;
};

/// Whether to pass over empty space, and the line of the plan that says so: for rectilinear grids
/// without hidden cells, at orders 1 and 3, in the modes that show the classification or a greatest
/// or least scalar, where no channel needs whole rays. What is seen then is the same, bit for bit,
/// as without. Where packets would do (`by_packets`), which walk some ten times as fast, only
/// little may be left to walk through. Makes the scene's tree where there is none yet.
std::optional<EmptySpace> find_empty_space(const Scene& scene, const RenderSettings& settings,
                                           bool by_packets, std::vector<std::string>& plan);

}  // namespace plume
