/// A ray through a rectilinear grid, ready to be walked by packets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "plume/traverse/packet_start.h"
#include "plume/traverse/rectilinear_walker.h"

namespace plume {

/// Whether packets walk a grid: one without hidden cells and with no more than 2^31 points.
inline bool walked_by_packets(const WalkableRectilinear& mesh) {
  return mesh.hidden.empty() && mesh.point_count() <= std::size_t{1} << 31;
}

/// z is the way from where the ray comes in, in world units.
struct RectilinearStart : PacketStart {
  /// In the ray's first cell; must stay there as long as the start is in use.
  const RectilinearWalker* walker = nullptr;
};

enum class RectilinearRay {
  misses,    ///< is in no cell
  declined,  ///< starts or ends inside of the grid: not for packets
  ready
};

/// Starts `walker` on the ray and makes `start` refer to it. Requires walked_by_packets(mesh); the
/// start is of use only where the answer is `ready`.
inline RectilinearRay set_start(RectilinearStart& start, RectilinearWalker& walker,
                                const WalkableRectilinear& mesh, const Ray& ray,
                                std::uint32_t number) {
  if (!walker.start(ray)) return RectilinearRay::misses;
  if (walker.t_in() < ray.t_min || !(walker.end() < ray.t_max)) return RectilinearRay::declined;
  start.walker = &walker;
  start.cell = walker.cell();
  start.z = 0;
  start.t_per_z = 1;
  start.scalar = mesh.point_values.empty() ? 0 : walker.entry_scalar();
  start.ray = number;
  return RectilinearRay::ready;
}

/// Room for the rays that packets hold at a time, each set up when its lane asks for it. For one
/// feeder; the mesh must outlive it.
class RectilinearLanes {
 public:
  explicit RectilinearLanes(const WalkableRectilinear& mesh)
      : mesh_(mesh), starts_(kMaxPacketLanes) {
    walkers_.reserve(kMaxPacketLanes);
    while (walkers_.size() < kMaxPacketLanes) walkers_.emplace_back(mesh);
  }
  RectilinearLanes(const RectilinearLanes&) = delete;
  RectilinearLanes& operator=(const RectilinearLanes&) = delete;

  /// All places are free again.
  void clear() { used_ = 0; }
  /// The place of the lane that asks: where what it has finished was, another where that is null.
  std::size_t place(const PacketStart* finished) {
    if (finished == nullptr) return used_++;
    return static_cast<std::size_t>(static_cast<const RectilinearStart*>(finished) -
                                    starts_.data());
  }
  RectilinearRay set(std::size_t place, const Ray& ray, std::uint32_t number) {
    return set_start(starts_[place], walkers_[place], mesh_, ray, number);
  }
  const RectilinearStart* start(std::size_t place) const { return &starts_[place]; }

 private:
  const WalkableRectilinear& mesh_;
  std::vector<RectilinearWalker> walkers_;
  std::vector<RectilinearStart> starts_;  // refer to the walkers
  std::size_t used_ = 0;
};

}  // namespace plume
