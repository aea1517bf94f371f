/// The scenes of the atlas that are about what a segment looks like, not where it is.
#pragma once

#include <string>
#include <vector>

namespace plume::atlas {

/// What one way to integrate (or to count surfaces) makes of a scene.
struct OpticsRow {
  std::string scene, meshes, method;
  bool ours = false;
  /// What is asserted of ours: `error` at most this.
  double promised = 0;
  /// The largest difference of a pixel's channel from the oracle; not a number where one is that.
  double error = 0;
};

/// Pictures of a field that is linear in space (and so along every ray) on tetrahedra, a grid,
/// mixed cells and a rectilinear grid, against adaptive quadrature: transfer functions with a step,
/// with a spike narrower than an entry of the table, with an optical depth of a million; and eight
/// knots as the control. By fixed steps, the midpoint of each segment, the pre-integrated table,
/// the closed form ray by ray and in packets.
std::vector<OpticsRow> run_transfer_functions();

/// A trilinear cell along whose diagonals the scalar turns twice: orders 1, 2 and 3 against
/// adaptive quadrature.
std::vector<OpticsRow> run_turning_points();

/// Counts of rays on which isosurfaces, intervals or values that are no numbers go wrong.
struct SurfaceRow {
  std::string scene, method;
  bool ours = false;
  std::size_t rays = 0;
  std::size_t missed = 0;   ///< see less than there is
  std::size_t doubled = 0;  ///< see more than there is
  std::size_t not_a_number = 0;
};

/// Isovalues that are values of vertices, of whole cells, of the bounds of intervals; values that
/// are NaN or infinite. The old methods: a cell is crossed where its ends are on two sides of the
/// isovalue, ends included or not; steps that composite what they find.
std::vector<SurfaceRow> run_surfaces();

std::string optics_table(const std::vector<OpticsRow>& rows);
std::string surface_table(const std::vector<SurfaceRow>& rows);
std::vector<std::string> problems_of(const std::vector<OpticsRow>& rows);
std::vector<std::string> problems_of(const std::vector<SurfaceRow>& rows);

}  // namespace plume::atlas
