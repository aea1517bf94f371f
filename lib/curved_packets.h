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
  ScalarOrder order = ScalarOrder::quadratic;  ///< or cubic
  /// Of the linear parts of segments, in the field's unit.
  float tolerance = 0;
  /// Transmittance at which a ray ends.
  float early_termination = 0;
  std::span<PacketColor> colors;  ///< by PacketStart::ray
};

/// composite_packets() (volume_packets.h) above order 1, of a field on points. Scalars inside of
/// cells come from Newton's method in single precision (traverse/inner_lanes-inl.h), where that
/// does not answer from scalars_inside(); a segment without an answer is linear. Each is cut into
/// parts of equal length on which the scalar is linear within `tolerance`.
///
/// Error against the scalar code at the same order and tolerance: below 2e-5 in each channel in
/// tests/lib/curved_packets_test.cpp at a tolerance of 1e-5 of the field's range; both cut segments
/// elsewhere, so that their colours are as far apart as a tolerance in the scalar makes them.
void composite_curved_packets(const WalkableGrid& mesh, const CurvedPackets& packets, int axis,
                              PacketFeeder& feeder);
void composite_curved_packets(const WalkableCells& mesh, const CurvedPackets& packets, int axis,
                              PacketFeeder& feeder);

}  // namespace plume
