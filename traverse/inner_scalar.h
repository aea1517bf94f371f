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
#include <cmath>
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

/// Cuts a linear segment in halves until in each part the cubic through four
/// equidistant values (or, where that will do, the chord) is within `tolerance` of the scalar at a
/// sixth, at half and at five sixths of the way, or the parts are 2^-12 of the segment (at a kink
/// inside of a polyhedron, say). Calls visit(const Segment&) for each part until that returns
/// false; returns whether all were visited. Parts join bit for bit. Where the inside has no answer
/// the part is linear. `place_at` gives the Place at a share of the way.
///
/// The tolerance holds where the scalar was looked at; what bends more between two such places is
/// not seen. Below 1e-6 of the field's range there is nothing but rounding.
template <class Mesh, class PlaceAt, class Visit>
bool for_each_close_part(const Mesh& mesh, const PlaceAt& place_at, double tolerance,
                         const Segment& whole, Visit&& visit) {
  constexpr int kDeepest = 12;
  auto part = [&](auto& self, double from, double to, float s_in, float s_out, int depth) -> bool {
    Segment segment = whole;
    const double length = whole.t_out - whole.t_in;
    if (from > 0) segment.t_in = whole.t_in + from * length;
    if (to < 1) segment.t_out = whole.t_in + to * length;
    segment.s_in = s_in;
    segment.s_out = s_out;
    std::array<Place, 5> places;  // at a sixth, two, three, four, five
    for (std::size_t i = 0; i < 5; ++i) {
      places[i] = place_at(from + (to - from) * static_cast<double>(i + 1) / 6);
    }
    std::array<float, 5> values;
    if (!scalars_inside(mesh, whole.cell, places, values.data())) return visit(segment);
    auto off_by = [&](std::size_t i) {
      return std::abs(scalar_at(segment, static_cast<double>(i + 1) / 6) - values[i]);
    };
    bool close = true;
    // What is no number is not close: the segment is then transparent, as those of other orders
    // are.
    for (std::size_t i = 0; i < 5; ++i) close = close && off_by(i) <= tolerance;
    if (close) return visit(segment);
    segment.order = ScalarOrder::cubic;
    segment.inner[0] = values[1];
    segment.inner[1] = values[3];
    if (depth == kDeepest ||
        !(off_by(0) > tolerance || off_by(2) > tolerance || off_by(4) > tolerance))
      return visit(segment);
    const double middle = from + (to - from) / 2;
    return self(self, from, middle, s_in, values[2], depth + 1) &&
           self(self, middle, to, values[2], s_out, depth + 1);
  };
  return part(part, 0, 1, whole.s_in, whole.s_out, 0);
}

}  // namespace plume
