/// A tile of a picture, its rays walked by packets.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "plume/lib/volume_packets.h"
#include "plume/traverse/boundary.h"
#include "plume/traverse/segment.h"

namespace plume {

/// What became of a ray of a tile.
struct PacketResult {
  PacketColor color;
  TraceResult trace;
  /// The ray is left to trace().
  bool declined = false;
};

/// Walks the rays of a feeder, whose longest axis that is, and puts what became of each, by
/// PacketStart::ray, into the colours: cells, z and opaque, and what it makes of the others.
using PacketWalkOfRays =
    std::function<void(std::span<PacketColor> colors, int axis, PacketFeeder& feeder)>;

/// Rays of a tile: added sixteen by sixteen, then composited together. Reused from tile to tile.
///
/// Packets walk a ray from entry to entry, each passage whole. A ray that starts inside of the
/// mesh, or one of whose passages begins before the last one ended (parts that overlap), needs its
/// segments cut: such rays are left to trace(), and `colors` has nothing for them.
///
/// For TetWalker, GridWalker and CellWalker, whose twins the packets are.
template <class Walker>
class PacketTile {
 public:
  using Mesh = typename Walker::Mesh;

  /// Passages farther apart than `gap`, in world units, are different ones for intervals.
  PacketTile(const Mesh& mesh, const BoundaryIndex<Walker>& boundary, double gap)
      : mesh_(mesh), boundary_(boundary), gap_(gap) {}

  static constexpr std::size_t kMostRays = 1024;

  void clear();
  /// Rays that see from their origin to infinity, kMostRays between one clear() and the next.
  void add(const RayLanes& rays);
  /// What the optics keep of each ray is the tile's. They number rays that meet the mesh, which is
  /// what ray() and distance() expect.
  void composite(PacketOptics optics);
  /// The same with whatever is to be done with their segments.
  void walk_by(const PacketWalkOfRays& walk);

  Ray ray(std::size_t index) const { return rays_[index].ray; }
  /// Of a place in the mesh's local frame, along the ray, in world units.
  double distance(std::size_t index, float z) const { return rays_[index].frame.t(z); }

  /// Whether a ray meets the mesh; rays are counted in the order in which they were added.
  bool meets(std::size_t number) const { return places_[number] != kMisses; }
  /// Of one that does: its PacketStart::ray.
  std::size_t index(std::size_t number) const { return places_[number]; }
  PacketResult result(std::size_t number) const;

 private:
  // One that meets the mesh.
  struct TileRay {
    Ray ray;
    ShearedFrame frame;
    Entries<Walker> all_entries;
    StartOf<Mesh> start;
    std::uint32_t entries = 0;
    bool declined = false;
    bool waiting = false;  // has an entry that was not walked yet
  };
  static constexpr std::uint32_t kMisses = ~std::uint32_t{0};
  class Feeder;

  bool prepare(std::size_t index, const std::optional<Entry>& entry, double seen_until);

  const Mesh& mesh_;
  const BoundaryIndex<Walker>& boundary_;
  const double gap_;
  std::vector<std::uint32_t> places_;  // in rays_, of all that were added
  // The first size_ of them, used again as they are. They stay where they are: starts refer to
  // frames.
  std::vector<TileRay> rays_ = std::vector<TileRay>(kMostRays);
  std::size_t size_ = 0;
  std::vector<PacketColor> colors_;
  std::vector<PacketVisit> visits_;  // none for a volume alone
  FrameLanes frames_;
  std::array<EntryList, FrameLanes::kRays> found_;
};

extern template class PacketTile<TetWalker>;
extern template class PacketTile<GridWalker>;
extern template class PacketTile<CellWalker>;

}  // namespace plume
