/// The named scenes of the atlas: meshes and rays on which methods fail.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plume/mesh/mesh.h"
#include "plume/traverse/ray.h"

namespace plume::atlas {

/// What is known of a scene without any walker.
enum class Oracle : std::uint8_t {
  cells,  ///< how much of a ray lies in each cell (tests/reference/line_lengths.h)
  box,    ///< the mesh fills a box; cells overlap, or rays start in them
  none,   ///< the rays meet nothing
};

struct SceneMesh {
  std::string cells;  ///< "tetrahedra", "grid", "mixed cells", ...
  Mesh mesh;          ///< its only field is linear_field() at the points
  std::vector<Ray> rays;
};

struct AtlasScene {
  std::string group, name;
  Oracle oracle = Oracle::cells;
  std::vector<SceneMesh> meshes;
};

/// All of them, the same ones on every machine.
std::vector<AtlasScene> atlas_scenes();

/// The field of all scenes, a + b . p, from 0 to 1 over the mesh's bounds.
struct LinearField {
  double at_origin = 0;
  double slope[3] = {0, 0, 0};

  explicit LinearField(const Mesh& mesh);
  double at(const double* p) const {
    return at_origin + slope[0] * p[0] + slope[1] * p[1] + slope[2] * p[2];
  }
};

}  // namespace plume::atlas
