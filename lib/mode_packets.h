/// The modes that show one number a ray, by packets of rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plume/lib/render.h"
#include "plume/lib/volume_packets.h"
#include "plume/preint/piece_table.h"
#include "plume/traverse/segment.h"

namespace plume {

/// What a ray's number is made of; to be begun with PacketNumber::before().
struct PacketNumber {
  /// The greatest or least scalar, a sum, or the distance to the first contribution.
  double value = 0;
  /// Where the scalar is known, in world units: mode average alone.
  double length = 0;

  /// Of a ray that has met nothing yet.
  static PacketNumber before(Mode mode);
};

/// A volume's extinction alone: PieceTable without its colours.
struct ExtinctionTable {
  struct Piece {
    float low, high, extinction, extinction_slope;
  };
  explicit ExtinctionTable(const PieceTable& table);

  std::vector<Piece> pieces;
};

/// Asked where a ray may meet its first contribution.
class PacketFirst {
 public:
  virtual ~PacketFirst() = default;
  /// Scalars strictly between these are transparent; none are where low >= high.
  struct Clear {
    float low = 1, high = 0;
  };
  /// Around a scalar.
  virtual Clear around(float scalar) const = 0;
  /// Whether a segment that ends at the local z contributes; takes it down if so. Of the segment
  /// t_in is 0, and t_out its length.
  virtual bool contributes(std::uint32_t ray, float z, const Segment& segment) const = 0;
};

/// What packets are to find. Spans are by PacketStart::ray.
struct ModePackets {
  Mode mode = Mode::maximum;                    ///< all but `volume`
  const ExtinctionTable* extinction = nullptr;  ///< mode optical_depth
  const PacketFirst* first = nullptr;           ///< mode depth
  ScalarOrder order = ScalarOrder::linear;      ///< or higher
  float tolerance = 0;                          ///< as CurvedPackets has it
  std::span<PacketNumber> numbers;
  std::span<PacketColor> colors;  ///< cells, z and opaque alone are used
};

/// Walks all rays of `feeder`, segments of order 1, and adds what they meet to their numbers. The
/// rays' longest axis must be `axis`, 0 to 2. Each mode is walked by code of its own: cells without
/// scalars, maxima without lengths, depths without colours.
///
/// Against the modes' consumers of segments (pixel.h) and the scalar walkers, which measure in
/// double: cells are the same, and so are maxima and minima of a field that is constant in cells;
/// other scalars differ by rounding, 1e-6 of the field's range in tests/lib/mode_packets_test.cpp;
/// sums are compensated, so that what they differ by does not grow with the number of cells: 1e-6
/// of the ray's way through the mesh's box times the largest scalar or extinction.
///
/// Tetrahedra are to be whole ones (!is_compact()).
void reduce_packets(const WalkableTets& mesh, const ModePackets& packets, int axis,
                    PacketFeeder& feeder);
void reduce_packets(const WalkableGrid& mesh, const ModePackets& packets, int axis,
                    PacketFeeder& feeder);
void reduce_packets(const WalkableCells& mesh, const ModePackets& packets, int axis,
                    PacketFeeder& feeder);
/// On rays of all axes together. Requires walked_by_packets(mesh).
void reduce_packets(const WalkableRectilinear& mesh, const ModePackets& packets,
                    PacketFeeder& feeder);

/// The same with segments of packets.order, quadratic or cubic, of a field on points, in all modes
/// but cell_count: maxima, minima and integrals are those of the polynomials. Scalars inside of
/// cells as composite_curved_packets() (curved_packets.h) has them.
void reduce_curved_packets(const WalkableGrid& mesh, const ModePackets& packets, int axis,
                           PacketFeeder& feeder);
void reduce_curved_packets(const WalkableCells& mesh, const ModePackets& packets, int axis,
                           PacketFeeder& feeder);

}  // namespace plume
