/// Opaque things in a scene: the aircraft in the flow.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume {

/// Triangles that hide what is behind them. World coordinates; seen from both sides.
struct OpaqueSurface {
  std::vector<std::array<double, 3>> points;  ///< x, y, z of each
  std::vector<std::array<std::uint32_t, 3>>
      triangles;  ///< numbers of the points, in any sense of rotation
  /// Linear RGB (Rec. 709 primaries), >= 0, of all of it...
  std::array<float, 3> color{0.6f, 0.6f, 0.6f};
  /// ...or of each point, interpolated over triangles; empty, or one for each.
  std::vector<std::array<float, 3>> point_colors;
  /// Normals of the points, of any length, interpolated; empty: that of the triangle. A smooth
  /// surface has them (see smooth_normals()).
  std::vector<std::array<float, 3>> point_normals;

  /// What is wrong, in one line that names the point or triangle, the value and the remedy; nothing
  /// where all is well.
  std::optional<std::string> problem() const;
};

/// Gives each point the mean of the normals of its triangles, weighted by area. Triangles that meet
/// at a point must be oriented alike for this to mean something.
void smooth_normals(OpaqueSurface& surface);

/// One of the six sides of a curvilinear or rectilinear grid, such as the wall of a body around
/// which it was made: side 0 to 5 is the first i, the last i, the first j, ... With smooth normals.
/// Throws Error where the mesh is no grid.
OpaqueSurface side_of_grid(const Mesh& mesh, int side);

}  // namespace plume
