/// Cell data made point data.
#pragma once

#include "plume/mesh/mesh.h"
#include "plume/mesh/scalar_field.h"

namespace plume {

/// The field at the points: at each, the mean of the cells around it, weighted by 1 / distance from
/// the point to the cell's centre, which is the mean of its points (Shepard, "A two-dimensional
/// interpolation function for irregularly-spaced data", ACM 1968, with the exponent 1). Within the
/// range of the cells around each point; a constant field stays so to the last bit, a linear one
/// where the centres around a point lie evenly about it. At the boundary they lie to one side: the
/// error there is that of going half a cell inwards.
///
/// Hidden cells do not take part, nor do cells whose value is NaN: a point is NaN only where all
/// its cells are, or where there is none. A cell whose centre is at the point decides alone (the
/// mean of all such). `not_finite` counts the points of visible cells that have no value; the name
/// stays. In parallel; the same bit for bit for any number of threads.
///
/// Requires check_structure() and `scalar.association == Association::cell`.
ScalarField average_to_points(const Mesh& mesh, const ScalarField& scalar);

}  // namespace plume
