/// The ways to make a tile of a picture.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "plume/lib/frame.h"
#include "plume/preint/integrator.h"
#include "plume/preint/piece_table.h"

namespace plume {

/// Makes tiles; safe to call from several threads, each with a tile and counts of its own.
class TileMaker {
 public:
  virtual ~TileMaker() = default;
  virtual void make(const Tile& tile, Counts& counts) = 0;
};

// All keep references to what they are given. Each is for what walkable form the scene has.

/// Mode volume of a scene that shows a volume alone, ray by ray.
std::unique_ptr<TileMaker> volume_tiles(Frame& frame, const Integrator& integrator);

/// The same by packets of rays; those that packets decline are left to volume_tiles(). Requires
/// walked_in_packets(frame).
std::unique_ptr<TileMaker> packet_tiles(Frame& frame, const Integrator& integrator,
                                        const PieceTable& pieces);

/// Scenes with intervals or isosurfaces, in the modes volume and depth.
std::unique_ptr<TileMaker> classified_tiles(Frame& frame, const Integrator& integrator);

/// Scenes with isosurfaces alone, and the modes maximum and minimum, of tetrahedra, through a
/// hierarchy of cells; rays that it declines are walked. The same picture as by classified_tiles()
/// or mode_tiles(), bit for bit. Requires !no_search(...). Makes the hierarchy where the scene has
/// none yet.
std::unique_ptr<TileMaker> searched_tiles(Frame& frame, const Integrator& integrator);

/// Why a picture is not made through a hierarchy of cells; nothing where it is.
std::optional<std::string> no_search(const Scene& scene, const RenderSettings& settings);

/// The modes that show one number a ray.
std::unique_ptr<TileMaker> mode_tiles(Frame& frame);

/// Whether there are packets for what the scene is walked as.
bool has_packets(const Scene& scene);

/// Whether packets can render this frame: linear segments, nothing but a volume, whole rays, closed
/// form, no further channels.
bool walked_in_packets(const Frame& frame);

}  // namespace plume
