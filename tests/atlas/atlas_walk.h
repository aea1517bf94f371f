/// What one method makes of one ray, whichever method it is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plume/traverse/ray.h"

namespace plume::atlas {

/// A stretch of a ray that a method took for the inside of a cell of the user's mesh.
struct Span {
  std::uint32_t cell;
  double t_in, t_out;
  double s_in, s_out;
};

struct AtlasWalk {
  std::vector<Span> spans;  ///< in the order in which the method met them
  bool lost = false;        ///< found no way out of a cell, or knows that it went astray
  bool looping = false;     ///< was stopped: more steps than there are ways into cells
};

/// Whose cells and faces a method takes the mesh for, and so what it is to be judged by.
enum class Surface : std::uint8_t {
  faces,      ///< triangles as they are, quadrilaterals as bilinear patches
  triangles,  ///< quadrilaterals of a grid cut into two triangles, as PluckerGridWalker has them
  fans,       ///< other faces than triangles cut from their smallest point id, as old methods do
};

/// A method's walks through one mesh, one for each ray; empty where it is not for such a mesh.
struct MethodWalks {
  std::string method;
  bool ours = false;
  /// Right by its own account: judged, and has to have zeros. Not so where a surface is only there
  /// to compare with.
  bool promised = false;
  Surface surface = Surface::faces;
  /// How finely it samples the ray, in world units; 0 where it computes where faces are.
  double resolution = 0;
  std::vector<AtlasWalk> walks;
};

}  // namespace plume::atlas
