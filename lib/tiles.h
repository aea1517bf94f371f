/// The ways to make a tile of a picture.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "plume/lib/frame.h"
#include "plume/preint/classified_pieces.h"
#include "plume/preint/integrator.h"
#include "plume/preint/piece_table.h"

namespace plume {

/// Makes tiles; safe to call from several threads, each with a source and counts of its own.
class TileMaker {
 public:
  virtual ~TileMaker() = default;
  /// All tiles that the source has.
  virtual void make(TileSource& tiles, Counts& counts) = 0;
};

// All keep references to what they are given. Each is for what walkable form the scene has.

/// Mode volume of a scene that shows a volume alone, ray by ray.
std::unique_ptr<TileMaker> volume_tiles(Frame& frame, const Integrator& integrator);

/// What packets composite, cut into pieces: of a volume alone, or of a whole classification.
using PacketPieces = std::variant<PieceTable, ClassifiedPieces>;

/// The pieces with which packets can render this frame, or nothing where they cannot: they serve
/// the mode volume, linear segments (of curvilinear grids and mixed cells also quadratic and cubic
/// ones, where the volume is alone), the closed form, the exponential form of intervals, no clip
/// planes and no further channels.
std::optional<PacketPieces> pieces_for_packets(const Frame& frame);

/// Either by packets of rays; those that packets decline are left to the other makers' code.
std::unique_ptr<TileMaker> packet_tiles(Frame& frame, const Integrator& integrator,
                                        const PacketPieces& pieces);

/// Scenes with intervals or isosurfaces, in the modes volume and depth.
std::unique_ptr<TileMaker> classified_tiles(Frame& frame, const Integrator& integrator);

/// The modes volume, depth, maximum and minimum through a hierarchy of cells, past those in which
/// nothing is to be seen; rays that it declines are walked. The same picture as by volume_tiles(),
/// classified_tiles() or mode_tiles(), bit for bit. Requires !cannot_search(...). Makes the
/// hierarchy where the scene has none yet.
std::unique_ptr<TileMaker> searched_tiles(Frame& frame, const Integrator& integrator);

/// Scenes with intervals or isosurfaces in the mode volume, by IntervalWay::table.
std::unique_ptr<TileMaker> table_tiles(Frame& frame);

/// The modes that show one number a ray.
std::unique_ptr<TileMaker> mode_tiles(Frame& frame);

/// Whether packets can make those modes' pictures: of a volume alone, without clip planes and
/// further channels, of segments of the orders that there are packets for.
bool has_mode_packets(const Frame& frame);

/// By how much a channel of such a picture may differ from that made in double: numbers by 1e-5 of
/// the field's range or of the picture's greatest (mode_packets.h; plume_frame_bench --modes),
/// those of one place on a ray above order 1 by 2.5e-5 (2.3e-5 was met on the combustor), and their
/// colours as the transfer function makes of that.
double mode_packet_error(const Scene& scene, const RenderSettings& settings);

/// The same pictures by packets of rays. Requires has_mode_packets(frame).
std::unique_ptr<TileMaker> mode_packet_tiles(Frame& frame);

/// Whether there are packets for what the scene is walked as.
bool has_packets(const Scene& scene);
/// And whether they are for the scalar's order, of a scene that has them.
bool has_packets_of_order(const Scene& scene, const RenderSettings& settings);

}  // namespace plume
