/// The pixels of a picture's tiles by packets, those that packets decline by their twin.
#pragma once

#include <cstddef>

#include "plume/lib/frame.h"
#include "plume/lib/packet_stream.h"
#include "plume/lib/rectilinear_stream.h"

namespace plume {

template <class Walkable>
using PacketStreamOf = PacketStream<typename Walkable::Walker>;

/// All that does not depend on what a pixel shows. `twin` makes pixels ray by ray; references are
/// kept.
template <class Twin>
class PacketPixels : public StreamPixels {
 public:
  PacketPixels(const Frame& frame, TileSource& tiles, Twin& twin, Counts& counts)
      : frame_(frame), tiles_(tiles), twin_(twin), counts_(counts) {}

  bool next(Block& pixels, RayLanes& rays) final {
    if (!has_pixel()) return false;
    std::size_t size = 0;
    if (is_clear_ && at_ + pixels.size() <= kPixels) {
      size = pixels.size();
      frame_.rays(tile_, at_, pixels, rays);
      at_ += size;
    } else {
      for (; size < pixels.size() && has_pixel(); ++at_)
        if (const auto pixel = frame_.pixel(tile_, at_)) {
          // Packets walk whole passages: rays that end inside are walked one by one.
          if (frame_.sees_endlessly(*pixel))
            pixels[size++] = *pixel;
          else
            twin_.make_pixel(PixelPlace(*pixel), counts_);
        }
      frame_.rays({pixels.data(), size}, rays);
    }
    counts_.in_packets += size;
    return size > 0;
  }

  void decline(const PixelPlace& pixel) final {
    --counts_.in_packets;
    twin_.make_pixel(pixel, counts_);
  }

 protected:
  void count(const TraceResult& trace) { counts_.add(trace); }

 private:
  static constexpr std::size_t kPixels = std::size_t{kTile} * kTile;

  bool has_pixel() {
    if (at_ < kPixels) return true;
    const auto tile = tiles_.next();
    if (!tile) return false;
    tile_ = *tile;
    is_clear_ = frame_.is_clear(tile_);
    at_ = 0;
    return true;
  }

  const Frame& frame_;
  TileSource& tiles_;
  Twin& twin_;
  Counts& counts_;
  Tile tile_;
  bool is_clear_ = false;
  std::size_t at_ = kPixels;
};

}  // namespace plume
