/// The generators, one family a file. Each takes `size` >= 1, or 0 for its default, and a finite
/// `jitter` >= 0; generate() has checked that. Every mesh has point fields and an active field.
/// Where jitter and seed are not mentioned, they change nothing.
#pragma once

#include "plume/datasets/generate.h"

namespace plume::datasets {

/// A blunt fin that stands on a plate in a flow of Mach 2.95, after NASA's blunt fin: a curvilinear
/// C-grid, right-handed. i runs around the fin (half-thickness 1, a half cylinder as its nose, its
/// axis at x = y = 0), j from its surface outwards past the bow shock, k from the plate z = 0 up to
/// z = 5, stretched to be fine at both walls. max(4, `size`) cells along i (default 63) and 3/4 as
/// many points along j and k as along i: 64 x 48 x 48. Point fields, freestream density and speed
/// of sound being 1: `density` (active), `pressure`, `mach`, `velocity` (3 components).
Mesh blunt_body(const GenerateOptions& options);

/// The unit cube, cut into size^3 cubes (default 32) of six tetrahedra each, which share the cube's
/// diagonal from (0, 0, 0) to (1, 1, 1) (Kuhn, Freudenthal), so that all faces match. Interior
/// points are displaced by up to `jitter` cube edges along each axis, then clamped into the cube;
/// boundary points stay. Without jitter all volumes are positive. Point fields `linear` (x + 2y +
/// 3z), `radius` (distance to the cube's centre, active), `waves` (sines of several frequencies,
/// within
/// [-1, 1]); cell field `cell_radius` (distance of the mean of the cell's points). Single
/// precision, 32-bit ids, one type, no offsets: 24 bytes a cell, and a sixth of 24 for its points
/// and fields. Throws Error for more than 1289 cubes along an edge.
Mesh box_tetrahedra(const GenerateOptions& options);

/// The points and fields of box_tetrahedra() as a curvilinear grid of size^3 hexahedra (default
/// 32).
Mesh box_hexahedra(const GenerateOptions& options);

/// The unit cube as a rectilinear grid of size^3 cuboids (default 32): interior planes are
/// displaced by up to `jitter` edges, at most 0.45, so that they keep their order; without jitter a
/// regular grid. Coordinates in double precision. Fields as in box_tetrahedra().
Mesh box_rectilinear(const GenerateOptions& options);

/// The unit cube, cut into size^3 cubes (default 24) of two wedges each; they share the diagonal
/// (0, 0)-(1, 1) of the faces of constant z. Points and point fields as in box_tetrahedra().
Mesh box_wedges(const GenerateOptions& options);

/// The unit cube, cut into size^3 cubes (default 16): hexahedra where x is small; elsewhere wedges
/// below and tetrahedra above; where hexahedra meet tetrahedra, cubes cut into five pyramids and
/// two tetrahedra. All faces match. All four types occur if size >= 2. Points and point fields as
/// in box_tetrahedra(), and one point in the middle of each cube that is cut into pyramids.
Mesh box_mixed(const GenerateOptions& options);

/// The unit cube as a honeycomb of polyhedra: size rows (default 12) of upright prisms over
/// hexagons (pentagons and quadrilaterals at the boundary) in size layers. All faces match, normals
/// point outwards. Interior points are displaced by up to `jitter` / (2 size) along each axis and
/// clamped into the cube. Point fields as in box_tetrahedra().
Mesh box_polyhedra(const GenerateOptions& options);

/// The unit cube as a curvilinear grid of size^3 hexahedra (default 56) none of whose interior
/// faces is planar: along its normal, a face's corners are displaced in turn by +0.18 and -0.18
/// edges. The boundary is planar, all Jacobians are positive. Point fields and `cell_radius` as in
/// box_tetrahedra().
Mesh twisted(const GenerateOptions& options);

/// A cylinder around (1/2, 1/2, z), of radius 1/2 and height 1, as a curvilinear grid: i from the
/// axis outwards (size cells, default 24), j around it (4 size cells), k along it (size cells). The
/// points i = 0 of a layer coincide, those of the last j coincide with those of the first, bit for
/// bit. Point fields as in box_tetrahedra().
Mesh o_grid(const GenerateOptions& options);

/// A ball of radius 1 around the origin as a curvilinear grid in spherical coordinates: i from the
/// centre outwards (size cells, default 24), j from the pole +z to -z (2 size cells), k around the
/// axis (4 size cells). The centre, both poles' axes and the seam k = 0, last coincide bit for bit.
/// Point fields as in box_tetrahedra(), `radius` from the ball's centre.
Mesh sphere(const GenerateOptions& options);

/// A ball of radius 1 around the origin as 8 size^3 tetrahedra (default size 24): an octahedron,
/// cut into `size` shells, its points moved along their radius onto spheres. The volume converges
/// to 4/3 pi as 1 / size^2. All volumes are positive. Point fields as in sphere().
Mesh ball_tetrahedra(const GenerateOptions& options);

/// The unit cube as two blocks of hexahedra, x <= 1/2 and x >= 1/2, each of max(1, size / 2) x size
/// x size cells (default size 16) with points of its own: those on x = 1/2 occur twice, at the same
/// place. Interior points of each block are displaced as in box_tetrahedra(). Point fields as
/// there.
Mesh two_blocks(const GenerateOptions& options);

/// A head of nested shells in the unit cube, for interval volumes: tetrahedra as in
/// box_tetrahedra() (default size 48), with the point field `attenuation` (active): 0 in the air,
/// 0.35 in the skin, 1 in the skull, 0.25 around the brain and 0.5 in it. Ellipsoidal, its face
/// with two eye sockets towards -y, its crown towards +z.
Mesh nested_shell(const GenerateOptions& options);

/// Vortices shed from both sides of a cylinder of diameter 1 around the z axis, in a stream of
/// speed 1 along x: a curvilinear grid of the wake, from the cylinder's rear (and the plane x = 0
/// beside it) to x = 14, for y from -4 to 4 and z from 0 to 6. max(4, `size`) cells along x
/// (default 72), 2/3 as many along y, half as many along z: 124,416. The flow is that at `time`,
/// and again after vortex_street_period. Point fields `vorticity` (about z, active) and `velocity`
/// (3 components).
Mesh vortex_street(const GenerateOptions& options);
inline constexpr double vortex_street_period = 5;

}  // namespace plume::datasets
