/// Compositing by packets of rays above order 1.
#pragma once

#include <span>
#include <type_traits>

#include "plume/lib/volume_packets.h"
#include "plume/traverse/cell_walker.h"
#include "plume/traverse/grid_walker.h"
#include "plume/traverse/segment.h"

namespace plume {

/// Whether there are packets above order 1. (Tetrahedra are linear.)
template <class Walkable>
inline constexpr bool kCurvedPackets = std::is_same_v<typename Walkable::Walker, GridWalker> ||
                                       std::is_same_v<typename Walkable::Walker, CellWalker>;

/// A volume along which the scalar is a polynomial in each cell.
struct CurvedPackets {
  const PieceTable* volume = nullptr;
  ScalarOrder order = ScalarOrder::quadratic;  ///< or cubic, or adaptive
  /// Of the linear parts of segments and, adaptive, of the cubics; in the field's unit.
  float tolerance = 0;
  /// Transmittance at which a ray ends.
  float early_termination = 0;
  std::span<PacketColor> colors;  ///< by PacketStart::ray
};

/// composite_packets() (volume_packets.h) above order 1, of a field on points. Scalars inside of
/// cells come from Newton's method in single precision (traverse/inner_lanes-inl.h), where that
/// does not answer from scalars_inside(); a segment without an answer is linear. Each is cut into
/// parts of equal length on which the scalar is linear within `tolerance`, with the polynomial's
/// mean.
///
/// Error against the scalar code at the same order and tolerance: both cut segments into linear
/// parts, but elsewhere, so that colours differ by what the tolerance makes of a scalar. In
/// tests/lib/curved_packets_test.cpp channels differ by less than twice the tolerance's share of
/// the field's range; on the benchmarks' meshes by 9e-7 RMS at the default of 1e-4.
void composite_curved_packets(const WalkableGrid& mesh, const CurvedPackets& packets, int axis,
                              PacketFeeder& feeder);
void composite_curved_packets(const WalkableCells& mesh, const CurvedPackets& packets, int axis,
                              PacketFeeder& feeder);

}  // namespace plume
