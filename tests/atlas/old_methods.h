/// The methods that fail, written as plainly as they are described: what the atlas sets beside
/// ours.
#pragma once

#include <string>
#include <vector>

#include "atlas_walk.h"
#include "scenes.h"

namespace plume::atlas {

/// - "Plücker products": Marmitt 2008, sections 6.3.1 to 6.3.5, single precision; tetrahedra only
///   (tests/bench/plucker_walker.h). It starts where our own rule says that a ray comes in.
/// - "ray-triangle test": the nearest triangle of the cell beyond where the ray came in, by the
///   test of Möller and Trumbore ("Fast, Minimum Storage Ray/Triangle Intersection", 1997), double
///   precision, with its epsilon of 1e-6.
/// - "face planes": the nearest of the faces' planes that the ray leaves by (Garrity, "Raytracing
///   Irregular Volume Data", 1990), double precision, no epsilon.
/// - "barycentric, tolerance": a point is in a tetrahedron if no barycentric coordinate is below
///   -1e-6; the ray goes on into the neighbour that it says, else into any around the cell that
///   takes it.
/// - "bump": the farthest triangle of the cell, by a watertight test in single precision (Woop,
///   Benthin and Wald, 2013); where that makes no progress the ray is moved on by 1e-3 of the
///   bounds and the cell is looked for anew, as VTK-m's and Viskores' ConnectivityTracer does.
std::vector<MethodWalks> old_walks(const SceneMesh& mesh);

}  // namespace plume::atlas
