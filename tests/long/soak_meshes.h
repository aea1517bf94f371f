/// The meshes of the soak, from clean to hopeless.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume::test {

struct SoakSource {
  std::string name;
  /// "tetrahedra", "grid", "cells" or "rectilinear": whose walker walks it.
  std::string form;
  /// The mesh fills its bounds, so that what a ray covers is its chord with a box.
  bool fills_bounds;
  /// Nothing where a file is absent: that is said on stderr, loudly.
  std::function<std::optional<Mesh>()> load;
};

/// Small ones, so that a ray meets few cells and there is time for many rays; and the blunt fin.
const std::vector<SoakSource>& soak_sources();

}  // namespace plume::test
