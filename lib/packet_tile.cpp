#include "plume/lib/packet_tile.h"

namespace plume {

// Sets up a ray's next passage. False where it has none, or none for packets.
bool PacketTile::prepare(std::size_t index, const std::optional<Entry>& entry, double seen_until) {
  TileRay& ray = rays_[index];
  if (!entry) return false;
  // Up to what single precision makes of one and the same place, an overlap is none.
  constexpr double kSame = 1e-6;
  const double overlap = (seen_until - entry->place.z) * ray.frame.sign();
  if (overlap > kSame) {
    ray.declined = true;
    return false;
  }
  TetWalker walker(mesh_, ray.frame);
  walker.enter(mesh_.boundary[entry->boundary], entry->rank);
  Crossing place = entry->place;
  if (overlap > 0) place.z = seen_until;
  ray.start = walker.packet_start(place, static_cast<std::uint32_t>(index));
  ++ray.entries;
  return true;
}

void PacketTile::add(const Ray& ray) {
  const std::size_t index = rays_.size();
  TileRay& added = rays_.emplace_back();
  if (!added.frame.set(ray, mesh_.frame)) return;
  const TetWalker walker(mesh_, added.frame);
  const auto entry = added.all_entries.first(boundary_, walker, added.frame);
  if (entry && added.frame.t(entry->place.z) < ray.t_min) {
    added.declined = true;
    return;
  }
  added.waiting = entry && prepare(index, entry, entry->place.z);
}

// Rays of one axis; one that has left is let in again where there is another entry.
class PacketTile::Feeder : public PacketFeeder {
 public:
  Feeder(PacketTile& tile, int axis) : tile_(tile), axis_(axis) {}

  const PacketStart* next(const PacketStart* finished) override {
    if (finished != nullptr) {
      TileRay& ray = tile_.rays_[finished->ray];
      const PacketColor& color = tile_.colors_[finished->ray];
      if (!color.opaque) {
        const TetWalker walker(tile_.mesh_, ray.frame);
        if (tile_.prepare(finished->ray, ray.all_entries.next(tile_.boundary_, walker, ray.frame),
                          color.z))
          return &ray.start;
      }
    }
    while (at_ < tile_.rays_.size()) {
      TileRay& ray = tile_.rays_[at_++];
      if (!ray.waiting || ray.frame.axis() != axis_) continue;
      ray.waiting = false;
      return &ray.start;
    }
    return nullptr;
  }

 private:
  PacketTile& tile_;
  const int axis_;
  std::size_t at_ = 0;
};

void PacketTile::composite() {
  colors_.assign(rays_.size(), PacketColor{});
  for (int axis = 0; axis < 3; ++axis) {
    Feeder feeder(*this, axis);
    composite_packets(mesh_, table_, axis, early_termination_, feeder, colors_);
  }
}

}  // namespace plume
