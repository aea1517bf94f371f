#include "plume/lib/rectilinear_tile.h"

#include <cstdint>

namespace plume {

// Rays are set up when a lane asks for one.
class PacketTile<RectilinearWalker>::Feeder : public PacketFeeder {
 public:
  explicit Feeder(PacketTile& tile) : tile_(tile) { tile.lanes_.clear(); }

  const PacketStart* next(const PacketStart* finished) override {
    const std::size_t place = tile_.lanes_.place(finished);
    while (at_ < tile_.rays_.size()) {
      TileRay& ray = tile_.rays_[at_];
      ray.answer = tile_.lanes_.set(place, ray.ray, static_cast<std::uint32_t>(at_));
      ++at_;
      if (ray.answer != RectilinearRay::ready) continue;
      ray.t_in = tile_.lanes_.start(place)->walker->t_in();
      return tile_.lanes_.start(place);
    }
    return nullptr;
  }

 private:
  PacketTile& tile_;
  std::size_t at_ = 0;
};

void PacketTile<RectilinearWalker>::composite(PacketOptics optics) {
  visits_.assign(optics.classified != nullptr ? rays_.size() : 0, PacketVisit{});
  if (optics.classified != nullptr) optics.classified->visits = visits_;
  walk_by([&](std::span<PacketColor> colors, int, PacketFeeder& feeder) {
    optics.colors = colors;
    composite_packets(mesh_, optics, feeder);
  });
}

void PacketTile<RectilinearWalker>::walk_by(const PacketWalkOfRays& walk) {
  colors_.assign(rays_.size(), PacketColor{});
  Feeder feeder(*this);
  walk(colors_, 0, feeder);
}

PacketResult PacketTile<RectilinearWalker>::result(std::size_t ray) const {
  const RectilinearRay answer = rays_[ray].answer;
  const PacketColor& color = colors_[ray];
  TraceResult trace;
  trace.end = color.opaque ? WalkEnd::stopped : WalkEnd::left;
  trace.entries = answer == RectilinearRay::ready ? 1 : 0;
  trace.cells = color.cells;
  return {color, trace, answer == RectilinearRay::declined};
}

}  // namespace plume
