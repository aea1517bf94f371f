/// Volume compositing by packets of rays.
#pragma once

#include <cstdint>
#include <span>

#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/mesh/walkable_rectilinear.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/preint/piece_table.h"
#include "plume/traverse/packet_start.h"

namespace plume {

/// A ray's sums, front to back, from one passage to the next.
struct PacketColor {
  float r = 0, g = 0, b = 0, transmittance = 1;
  /// Cells walked through.
  std::uint32_t cells = 0;
  /// Local z where the ray was last.
  float z = 0;
  /// Seen through by no more than the threshold of early termination.
  bool opaque = false;
};

/// Walks all rays of `feeder` and composites the closed form of their segments into
/// colors[PacketStart::ray]. The rays' longest axis must be `axis`, 0 to 2. A ray ends once its
/// transmittance is at most `early_termination`.
///
/// Error against ClosedForm and the scalar walker in double: below 1e-5 in each channel in
/// tests/lib/packets_test.cpp, but where extinction changes by more than the rounding of a scalar
/// to a float allows (a narrow spike).
void composite_packets(const WalkableTets& mesh, const PieceTable& table, int axis,
                       float early_termination, PacketFeeder& feeder,
                       std::span<PacketColor> colors);
void composite_packets(const WalkableGrid& mesh, const PieceTable& table, int axis,
                       float early_termination, PacketFeeder& feeder,
                       std::span<PacketColor> colors);
void composite_packets(const WalkableCells& mesh, const PieceTable& table, int axis,
                       float early_termination, PacketFeeder& feeder,
                       std::span<PacketColor> colors);
/// On rays of all axes together. Requires walked_by_packets(mesh).
void composite_packets(const WalkableRectilinear& mesh, const PieceTable& table,
                       float early_termination, PacketFeeder& feeder,
                       std::span<PacketColor> colors);

}  // namespace plume
