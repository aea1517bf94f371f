/// A tile of a picture of a rectilinear grid, its rays walked by packets.
#pragma once

#include <cstddef>
#include <vector>

#include "plume/lib/packet_tile.h"
#include "plume/traverse/rectilinear_start.h"
#include "plume/traverse/trace_rectilinear.h"

namespace plume {

/// As the tiles of other meshes. A ray has one passage, found by the walker itself, and rays of all
/// axes share packets. One that starts or ends inside of the grid is left to trace().
///
/// Requires walked_by_packets(mesh).
template <>
class PacketTile<RectilinearWalker> {
 public:
  PacketTile(const WalkableRectilinear& mesh, const BoundaryIndex<RectilinearWalker>&,
             const PieceTable& table, float early_termination)
      : mesh_(mesh), table_(table), early_termination_(early_termination), lanes_(mesh) {}

  void clear() { rays_.clear(); }
  void add(const Ray& ray) { rays_.push_back({ray, RectilinearRay::misses}); }
  void composite();
  PacketResult result(std::size_t ray) const;

 private:
  struct TileRay {
    Ray ray;
    RectilinearRay answer;
  };
  class Feeder;

  const WalkableRectilinear& mesh_;
  const PieceTable& table_;
  const float early_termination_;
  RectilinearLanes lanes_;
  std::vector<TileRay> rays_;
  std::vector<PacketColor> colors_;
};

}  // namespace plume
