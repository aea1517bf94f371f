#include "plume/lib/rectilinear_stream.h"

#include <cstdint>

namespace plume {

class PacketStream<RectilinearWalker>::Feeder : public PacketFeeder {
 public:
  Feeder(PacketStream& stream, StreamPixels& pixels) : stream_(stream), pixels_(pixels) {
    stream.lanes_.clear();
  }

  const PacketStart* next(const PacketStart* finished) override {
    const std::size_t place = stream_.lanes_.place(finished);
    if (finished != nullptr) put(place);
    for (; has_ray(); ++at_) {
      const PixelPlace& pixel = stream_.pixels_[at_];
      const Ray ray = stream_.block_.ray(at_);
      switch (stream_.lanes_.set(place, ray, static_cast<std::uint32_t>(place))) {
        case RectilinearRay::misses:
          pixels_.miss(pixel);
          continue;
        case RectilinearRay::declined:
          pixels_.decline(pixel);
          continue;
        case RectilinearRay::ready:
          break;
      }
      ++at_;
      const RectilinearStart* const start = stream_.lanes_.start(place);
      stream_.rays_[place] = {ray, start->walker->t_in(), pixel};
      stream_.colors_[place] = {};
      if (!stream_.visits_.empty()) stream_.visits_[place] = {};
      pixels_.begin(static_cast<std::uint32_t>(place));
      return start;
    }
    return nullptr;
  }

 private:
  bool has_ray() {
    if (at_ < size_) return true;
    at_ = 0;
    size_ = pixels_.next(stream_.pixels_, stream_.block_) ? stream_.block_.size : 0;
    return size_ > 0;
  }

  void put(std::size_t place) {
    const PacketColor& color = stream_.colors_[place];
    pixels_.put(stream_.rays_[place].pixel, color,
                {color.opaque ? WalkEnd::stopped : WalkEnd::left, 1, color.cells},
                static_cast<std::uint32_t>(place));
  }

  PacketStream& stream_;
  StreamPixels& pixels_;
  std::size_t at_ = 0, size_ = 0;  // of the block
};

void PacketStream<RectilinearWalker>::composite(PacketOptics optics, StreamPixels& pixels) {
  if (optics.classified != nullptr) {
    visits_.resize(kMostRays);
    optics.classified->visits = visits_;
  }
  walk_by(
      [&](std::span<PacketColor> colors, int, PacketFeeder& feeder) {
        optics.colors = colors;
        composite_packets(mesh_, optics, feeder);
      },
      pixels);
}

void PacketStream<RectilinearWalker>::walk_by(const PacketWalkOfRays& walk, StreamPixels& pixels) {
  Feeder feeder(*this, pixels);
  walk(colors_, 0, feeder);
}

}  // namespace plume
