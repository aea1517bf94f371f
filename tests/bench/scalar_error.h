/// How far the scalar along segments is from the isoparametric interpolation of their cells.
#pragma once

#include <cstddef>

#include "plume/lib/plume.h"
#include "plume/mesh/mesh.h"

namespace plume::bench {

struct ScalarError {
  /// In shares of the field's range.
  double rms = 0, largest = 0;
  std::size_t samples = 0;
  /// Places where the oracle found no parameters (collapsed cells), left out.
  std::size_t unanswered = 0;
};

/// At five places of each segment along `rays` rays of the camera's picture. Slivers, shorter than
/// a thousandth of a mean cell, are left out. The scene is that of the mesh's active point field.
ScalarError scalar_error(const Mesh& mesh, const Scene& scene, const Camera& camera,
                         ScalarOrder order, int rays);

}  // namespace plume::bench
