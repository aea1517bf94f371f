/// Rays of a picture, walked by packets without a break.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "plume/lib/frame.h"
#include "plume/lib/volume_packets.h"
#include "plume/traverse/boundary.h"
#include "plume/traverse/segment.h"

namespace plume {

/// Where a stream's rays come from, and what is made of them.
class StreamPixels {
 public:
  using Block = std::array<PixelPlace, RayLanes::kRays>;

  virtual ~StreamPixels() = default;
  /// Up to sixteen further pixels and their rays, which see from their origin to infinity; false
  /// at the end.
  virtual bool next(Block& pixels, RayLanes& rays) = 0;
  /// A ray has got this number, its PacketStart::ray, until it has been put or declined.
  virtual void begin(std::uint32_t ray) = 0;
  /// What became of a ray that packets have walked to its end.
  virtual void put(const PixelPlace& pixel, const PacketColor& color, const TraceResult& trace,
                   std::uint32_t ray) = 0;
  /// The pixel's ray does not meet the mesh.
  virtual void miss(const PixelPlace& pixel) = 0;
  /// The pixel's ray is left to trace().
  virtual void decline(const PixelPlace& pixel) = 0;
};

/// Walks the rays of a feeder, whose longest axis that is, and puts what became of each, by
/// PacketStart::ray, into the colours: cells, z and opaque, and what it makes of the others.
using PacketWalkOfRays =
    std::function<void(std::span<PacketColor> colors, int axis, PacketFeeder& feeder)>;

/// Rays are set up when lanes ask for them, sixteen by sixteen, and forgotten when they have ended:
/// so lanes are never idle but at the picture's end, and what is kept of rays stays in the caches.
///
/// Packets walk a ray from entry to entry, each passage whole. A ray that starts inside of the
/// mesh, or one of whose passages begins before the last one ended (parts that overlap), needs its
/// segments cut: such rays are declined.
///
/// For TetWalker, GridWalker and CellWalker, whose twins the packets are.
template <class Walker>
class PacketStream {
 public:
  using Mesh = typename Walker::Mesh;

  /// Passages farther apart than `gap`, in world units, are different ones for intervals.
  PacketStream(const Mesh& mesh, const BoundaryIndex<Walker>& boundary, double gap);

  /// Rays' numbers are below this.
  static constexpr std::size_t kMostRays = 1024;

  /// All of the pixels. What the optics keep of each ray is the stream's.
  void composite(PacketOptics optics, StreamPixels& pixels);
  /// The same with whatever is to be done with their segments.
  void walk_by(const PacketWalkOfRays& walk, StreamPixels& pixels);

  /// Of rays that have begun and not ended.
  Ray ray(std::size_t number) const { return rays_[number].ray; }
  /// Of a place in the mesh's local frame, along the ray, in world units.
  double distance(std::size_t number, float z) const { return rays_[number].frame.t(z); }

 private:
  // One that meets the mesh.
  struct StreamRay {
    Ray ray;
    ShearedFrame frame;
    Entries<Walker> all_entries;
    StartOf<Mesh> start;
    PixelPlace pixel{};
    std::uint32_t entries = 0;
    bool declined = false;
  };
  // First in, first out.
  class Queue {
   public:
    bool empty() const { return at_ == rays_.size(); }
    std::size_t size() const { return rays_.size() - at_; }
    void push(std::uint32_t ray) { rays_.push_back(ray); }
    std::uint32_t pop() {
      const std::uint32_t ray = rays_[at_++];
      if (empty()) {
        rays_.clear();
        at_ = 0;
      }
      return ray;
    }

   private:
    std::vector<std::uint32_t> rays_;
    std::size_t at_ = 0;
  };
  class Feeder;

  std::optional<int> next_axis(StreamPixels& pixels);
  bool has_room() const;
  bool fetch(StreamPixels& pixels);
  std::uint32_t take_number();
  bool prepare(std::uint32_t number, const std::optional<Entry>& entry, double seen_until);
  void finish(std::uint32_t number, StreamPixels& pixels);

  const Mesh& mesh_;
  const BoundaryIndex<Walker>& boundary_;
  const double gap_;
  // By number. They stay where they are: starts refer to frames.
  std::vector<StreamRay> rays_;
  std::vector<std::uint32_t> free_;  // numbers that were used; the last one is the warmest
  std::array<Queue, 3> waiting_;     // by axis: rays that no lane has
  std::vector<PacketColor> colors_ = std::vector<PacketColor>(kMostRays);
  std::vector<PacketVisit> visits_;  // none for a volume alone
  StreamPixels::Block pixels_;
  RayLanes lanes_;
  FrameLanes frames_;
  std::array<EntryList, FrameLanes::kRays> found_;
};

extern template class PacketStream<TetWalker>;
extern template class PacketStream<GridWalker>;
extern template class PacketStream<CellWalker>;

}  // namespace plume
