/// Rays of a picture of a rectilinear grid, walked by packets without a break.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "plume/lib/packet_stream.h"
#include "plume/traverse/rectilinear_start.h"
#include "plume/traverse/trace_rectilinear.h"

namespace plume {

/// As the streams of other meshes. A ray has one passage, found by the walker itself, and rays of
/// all axes share packets. One that starts or ends inside of the grid is declined.
///
/// Requires walked_by_packets(mesh).
template <>
class PacketStream<RectilinearWalker> {
 public:
  PacketStream(const WalkableRectilinear& mesh, const BoundaryIndex<RectilinearWalker>&,
               double /*gap*/)
      : mesh_(mesh), lanes_(mesh) {}

  static constexpr std::size_t kMostRays = kMaxPacketLanes;

  void composite(PacketOptics optics, StreamPixels& pixels);
  /// All rays with axis 0, which means nothing here.
  void walk_by(const PacketWalkOfRays& walk, StreamPixels& pixels);

  const Ray& ray(std::size_t number) const { return rays_[number].ray; }
  /// Of a place on the ray, `z` from where it comes in.
  double distance(std::size_t number, float z) const { return rays_[number].t_in + z; }

 private:
  struct StreamRay {
    Ray ray;
    double t_in = 0;
    PixelPlace pixel{};
  };
  class Feeder;

  const WalkableRectilinear& mesh_;
  RectilinearLanes lanes_;
  // By number, which is that of the lane.
  std::array<StreamRay, kMostRays> rays_;
  std::array<PacketColor, kMostRays> colors_;
  std::vector<PacketVisit> visits_;
  StreamPixels::Block pixels_;
  RayLanes block_;
};

}  // namespace plume
