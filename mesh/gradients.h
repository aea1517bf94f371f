/// The gradient of a point field at the points of a mesh.
#pragma once

#include <vector>

#include "plume/mesh/mesh.h"
#include "plume/mesh/scalar_field.h"

namespace plume {

/// d/dx, d/dy and d/dz of a point field at each point, interleaved: 3 floats a point, in units of
/// the scalar per world length. Computed in parallel when called; nothing of it is kept. Each point
/// depends on its neighbours alone, so the result is the same bit for bit for any number of
/// threads. Requires check_structure(). Throws Error for a cell field.
///
/// How, for each point:
///
/// - In a curvilinear grid, by differences along i, j and k of both positions and scalars, which
///   the Jacobian takes from computational to physical space: Marmitt, "Interactive Volume Ray
///   Tracing" (2008), equations 6.8 and 6.9, after Fruehauf. Equation 6.10 takes the gradient there
///   as if it were a position; here the equations x_xi . g = s_xi are solved, which is exact in
///   sheared cells too. Differences are central; where a neighbour is missing they are one-sided,
///   of second order if two points follow on the other side, else of first.
/// - Where all cells around it are tetrahedra: their gradients, weighted by volume (6.7).
/// - Where all are hexahedra or voxels: the gradient of each cell's isoparametric map at the point,
///   through the three edges that meet there, weighted by the volume that they span.
/// - Elsewhere, and where the above gives nothing: least squares over the points of the cells
///   around it, weighted by 1 / distance^2 and by the number of cells that both points share.
///
/// All are exact for linear fields, but for the rounding of the field's values. On smooth fields
/// the error falls with the square of the edges' length where the points around lie evenly (inside
/// of grids and their images under smooth maps, and at their boundaries where three points lie in a
/// line), elsewhere at least linearly.
///
/// What cannot be used is passed over: hidden cells, cells and tetrahedra without volume, edges of
/// no length, neighbours whose value is NaN. The gradient is NaN in all three components where the
/// point's own value is NaN, where no cell is around it, and where what is left lies in a plane: a
/// determinant of the directions below 1e-8 of the product of their lengths (of their normal matrix
/// below 1e-12 for least squares).
std::vector<float> point_gradients(const Mesh& mesh, const ScalarField& scalar);

}  // namespace plume
