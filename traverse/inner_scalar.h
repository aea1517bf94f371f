/// The scalar inside of cells, and so the inner values of segments of order 2 and 3.
///
/// | cell | scalar |
/// |---|---|
/// | tetrahedron | linear |
/// | hexahedron (a parallelepiped: trilinear), wedge, pyramid | isoparametric (isoparametric.h) |
/// | everything else | linear from the cell's centre to its faces |
///
/// The last is linear over tetrahedra between the centre of the cell, the centre of a face (means
/// of their points) and an edge (Bailey, Adams, Yang, Zika, "A piecewise linear finite element
/// discretization of the diffusion equation for arbitrary polyhedral grids", Journal of
/// Computational Physics 227, 2008), but over a quadrilateral they make one pyramid, which is
/// isoparametric. On a face all of these are what the face is measured by (measure.h), so cells
/// agree with their neighbours. A linear field is reproduced by all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/traverse/isoparametric.h"
#include "plume/traverse/segment.h"
#include "plume/traverse/sheared_frame.h"

namespace plume {

/// Writes the scalar at each of some places of a cell, in local coordinates; NaN where a value of
/// the cell is. Accurate to kParameterTolerance times the differences of the cell's values, and
/// single precision. Places up to kFarthestOutside of the cell's size outside of it are
/// extrapolated.
///
/// False, and nothing is promised of `scalars`, where the scalar is linear in all of the cell (a
/// tetrahedron), or where a place has no answer (invert() in isoparametric.h; a place in none of
/// the parts of a cell that its centre does not see the whole of).
bool scalars_inside(const WalkableGrid& mesh, std::uint32_t cell, std::span<const Place> places,
                    float* scalars);
bool scalars_inside(const WalkableCells& mesh, std::uint32_t cell, std::span<const Place> places,
                    float* scalars);
inline bool scalars_inside(const WalkableTets&, std::uint32_t, std::span<const Place>, float*) {
  return false;
}

/// Gives a linear segment from z_in to z_out its inner values. Where one has no answer it stays
/// linear, as does a segment of no length, and one through a field that is constant in each cell.
template <class Mesh>
void sample_inside(const Mesh& mesh, const ShearedFrame& frame, double z_in, double z_out,
                   ScalarOrder order, Segment& segment) {
  if (order == ScalarOrder::linear || !mesh.cell_values.empty() || z_in == z_out) return;
  const std::size_t count = order == ScalarOrder::quadratic ? 1 : 2;
  std::array<Place, 2> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(count + 1);
    places[i] = frame.local(z_in + share * (z_out - z_in));
  }
  if (scalars_inside(mesh, segment.cell, {places.data(), count}, segment.inner))
    segment.order = order;
}

}  // namespace plume
