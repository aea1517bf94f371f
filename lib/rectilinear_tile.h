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
             double /*gap*/)
      : mesh_(mesh), lanes_(mesh) {}

  void clear() { rays_.clear(); }
  /// Rays that see from their origin to infinity.
  void add(const RayLanes& rays) {
    for (std::size_t i = 0; i < rays.size; ++i) rays_.push_back({rays.ray(i)});
  }
  void composite(PacketOptics optics);
  /// All rays with axis 0, which means nothing here.
  void walk_by(const PacketWalkOfRays& walk);

  const Ray& ray(std::size_t index) const { return rays_[index].ray; }
  /// Of a place on the ray, `z` from where it comes in.
  double distance(std::size_t index, float z) const { return rays_[index].t_in + z; }
  bool meets(std::size_t ray) const { return rays_[ray].answer != RectilinearRay::misses; }
  std::size_t index(std::size_t number) const { return number; }
  PacketResult result(std::size_t ray) const;

 private:
  struct TileRay {
    Ray ray;
    RectilinearRay answer = RectilinearRay::misses;
    double t_in = 0;
  };
  class Feeder;

  const WalkableRectilinear& mesh_;
  RectilinearLanes lanes_;
  std::vector<TileRay> rays_;
  std::vector<PacketColor> colors_;
  std::vector<PacketVisit> visits_;
};

}  // namespace plume
