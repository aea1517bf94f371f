/// Which pictures are made through a hierarchy of cells, and what is looked for there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plume/lib/render.h"
#include "plume/lib/scene.h"
#include "plume/traverse/cell_search.h"

namespace plume {

/// Scalars of which a classification shows anything: what has extinction, intervals with their
/// ends, isosurfaces.
std::vector<ScalarWindow> visible_windows(const Classification& classification);

/// Of the scene's cells, the share whose scalars reach one of these windows: of some thousand
/// cells, evenly taken. Requires another form than a rectilinear grid's or compact tetrahedra, and
/// a scalar on points.
double visible_share(const Scene& scene, const std::vector<ScalarWindow>& windows);

/// Why a picture cannot be made through a hierarchy of cells; nothing where it can.
std::optional<std::string> cannot_search(const Scene& scene, const RenderSettings& settings);

/// Whether a picture is made through a hierarchy of cells.
struct SearchChoice {
  bool search = false;
  /// Why, or why not, in words for the plan; empty where nobody would ask.
  std::string why;
};

/// It is where it can and where that pays beside what else there is, which is packets
/// (`by_packets`) or a walk. A rule of counts, not of a clock.
SearchChoice choose_search(const Scene& scene, const RenderSettings& settings, bool by_packets);

}  // namespace plume
