/// Compositing by packets of rays.
#pragma once

#include <cstdint>
#include <span>

#include "plume/lib/shading.h"
#include "plume/mesh/walkable_cells.h"
#include "plume/mesh/walkable_grid.h"
#include "plume/mesh/walkable_rectilinear.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/preint/classified_pieces.h"
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

/// What a ray carries through intervals from one passage to the next, as IntervalState does. To be
/// made anew where a gap lies between them.
struct PacketVisit {
  /// Of the last scalar; see classified_form-inl.h. A side of 0: no scalar was seen yet.
  std::uint32_t piece = 0;
  float last = 0, reached = 0, side = 0;
  Shading shading;
};

/// Asked for light where rays meet isosurfaces and come into intervals.
class PacketLight {
 public:
  virtual ~PacketLight() = default;
  /// At `back` in world units before the local z, in a cell of the walkable mesh.
  virtual Shading at(std::uint32_t ray, float z, float back, std::uint32_t cell) const = 0;
};

/// For scenes with intervals or isosurfaces.
struct ClassifiedPackets {
  const ClassifiedPieces& pieces;
  std::span<PacketVisit> visits;  ///< by PacketStart::ray
  const PacketLight* light = nullptr;
  bool light_intervals = false;
  /// Added to: isosurfaces crossed and visits to intervals.
  std::uint64_t surfaces_crossed = 0, intervals_visited = 0;
};

/// What packets composite: a volume alone, or a whole classification.
struct PacketOptics {
  const PieceTable* volume = nullptr;
  ClassifiedPackets* classified = nullptr;
  /// Transmittance at which a ray ends.
  float early_termination = 0;
  std::span<PacketColor> colors;  ///< by PacketStart::ray
};

/// Walks all rays of `feeder` and composites the closed form of their segments into
/// colors[PacketStart::ray]. The rays' longest axis must be `axis`, 0 to 2.
///
/// Error against ClosedForm and the scalar walker in double: below 1e-5 in each channel in
/// tests/lib/packets_test.cpp and classified_packets_test.cpp, but where extinction changes by more
/// than the rounding of a scalar to a float allows (a narrow spike, a narrow interval that a ray
/// turns back in).
void composite_packets(const WalkableTets& mesh, const PacketOptics& optics, int axis,
                       PacketFeeder& feeder);
/// composite_packets() where there is a classification: compiled by itself, as tetrahedra have most
/// forms.
void composite_classified(const WalkableTets& mesh, const PacketOptics& optics, int axis,
                          PacketFeeder& feeder);
void composite_packets(const WalkableGrid& mesh, const PacketOptics& optics, int axis,
                       PacketFeeder& feeder);
void composite_packets(const WalkableCells& mesh, const PacketOptics& optics, int axis,
                       PacketFeeder& feeder);
/// On rays of all axes together. Requires walked_by_packets(mesh).
void composite_packets(const WalkableRectilinear& mesh, const PacketOptics& optics,
                       PacketFeeder& feeder);

}  // namespace plume
