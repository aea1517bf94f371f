/// Points, and what closed surfaces enclose, as tetrahedra.
///
/// Two engines, each an option of the build, off by default because of its licence: TetGen (AGPL;
/// H. Si, "TetGen, a Delaunay-Based Quality Tetrahedral Mesh Generator", ACM TOMS 41(2), 2015) and
/// CGAL's 3D triangulations (GPL; C. Jamin, S. Pion, M. Teillaud, CGAL User and Reference Manual).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plume/mesh/findings.h"
#include "plume/mesh/mesh.h"

namespace plume {

/// What makes the tetrahedra. `automatic`: TetGen where the build has it, else CGAL.
enum class TetrahedralizationEngine : std::uint8_t { automatic, tetgen, cgal };

/// True where the build has the engine; of `automatic`, where it has any.
bool has_engine(TetrahedralizationEngine engine);

/// Points with values, without cells.
struct PointSet {
  /// x, y, z of each point, interleaved; float or double.
  Array points;
  /// Fields of points only.
  std::vector<Field> fields;
  std::string active_field;  ///< the field to show; empty: the first

  /// Of x, y, z.
  std::size_t point_count() const { return points.size() / 3; }
};

/// Triangles between points. They need not be oriented.
struct TriangleSurface {
  PointSet vertices;                                    ///< with their fields
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< numbers of the vertices
};

/// What tetrahedralize() makes.
struct Tetrahedralization {
  /// Tetrahedra of positive volume by VTK's order of points.
  Mesh mesh;
  /// "TetGen" or "CGAL".
  std::string engine;
  /// What was done that a user should know: examples are numbers of the points or triangles given.
  std::vector<Finding> findings;
};

/// The Delaunay tetrahedralization of the points: it fills their convex hull, so that what is
/// concave is closed, and near the hull tetrahedra may be as flat as the points make them.
///
/// Points are neither moved nor added. Of points with equal coordinates (0 and -0 are equal) the
/// first is kept with its values, which is a finding; where there are none, point i of the mesh is
/// point i of the set. Where five or more points lie on a sphere, one of several
/// tetrahedralizations is made, which one depends on the engine. Both engines decide exactly, CGAL
/// everywhere, TetGen but for points within 1e-8 of the set's size of each other or of one plane,
/// which it may refuse.
///
/// Throws Error without the engine; where coordinates are not finite, fewer than four points
/// differ, or all are in a plane, naming points and coordinates; and where the engine fails, with
/// its words. TetGen runs in a process of its own (see separate_process.h), for it may abort.
Tetrahedralization tetrahedralize(
    const PointSet& points, TetrahedralizationEngine engine = TetrahedralizationEngine::automatic);

/// Bounds that TetGen refines a surface's tetrahedra for. They are aims: a few tetrahedra may
/// remain beyond them (a volume by some percent), which a finding counts.
struct SurfaceMeshing {
  /// TetGen's -q: the radius of a tetrahedron's circumscribed sphere by its shortest edge; 1 to
  /// 1000, or 0 for no bound. 2 comes to an end but where the surface itself has sharp angles, 1.4
  /// most often; 1.1 need not.
  double radius_edge_ratio = 0;
  /// TetGen's -q: the smallest dihedral angle, in degrees; 0 (no bound) to 40, and needs a
  /// radius_edge_ratio. 10 to 15 is often reached; 20 need not come to an end.
  double dihedral_angle = 0;
  /// TetGen's -a: the largest tetrahedron's volume, in the mesh's unit of length, cubed; 0 for no
  /// bound.
  double volume = 0;
  /// TetGen's -S: refinement ends when it has added this many points, which a finding says. At
  /// least 1.
  int added_points = 10'000'000;
};

/// A constrained tetrahedralization of what a closed surface of triangles encloses, by TetGen.
///
/// Enclosed is what an odd number of the surface's sheets separates from infinity: a closed surface
/// inside of another bounds a cavity, one in the cavity is filled again, whatever their
/// orientations. Points with equal coordinates are one; triangles with equal corners are left out.
/// The surface's points come first and in order, but for those that no tetrahedron has; points
/// are added on the surface and inside. As these have no values, the mesh has no fields, and what
/// the surface had is named in a finding.
///
/// Throws Error without TetGen; for settings out of range; where a coordinate is not finite or a
/// triangle has a point that is not there; where the surface is open (an edge has an odd number of
/// triangles), or intersects itself or touches itself elsewhere than in common edges and points,
/// naming triangles and coordinates; and where TetGen fails, with its words.
Tetrahedralization tetrahedralize(const TriangleSurface& surface,
                                  const SurfaceMeshing& meshing = {});

}  // namespace plume
