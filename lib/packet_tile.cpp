#include "plume/lib/packet_tile.h"

#include <cassert>

namespace plume {

template <class Walker>
void PacketTile<Walker>::clear() {
  size_ = 0;
  places_.clear();
  visits_.clear();
}

template <class Walker>
void PacketTile<Walker>::add(const RayLanes& rays) {
  frames_.set(rays, mesh_.frame);
  boundary_.first_entries(frames_, found_);
  for (std::size_t i = 0; i < rays.size; ++i) {
    if (found_[i].size == 0) {
      places_.push_back(kMisses);
      continue;
    }
    places_.push_back(static_cast<std::uint32_t>(size_));
    assert(size_ < kMostRays);
    TileRay& added = rays_[size_++];
    added.ray = rays.ray(i);
    frames_.put(i, added.frame);
    added.all_entries.list() = found_[i];
    added.entries = 0;
    added.declined = added.waiting = false;
    // At once, while all that it takes is near.
    const auto entry = added.all_entries.first();
    if (added.frame.t(entry->place.z) < added.ray.t_min)
      added.declined = true;
    else
      added.waiting = prepare(size_ - 1, entry, entry->place.z);
  }
}

// Sets up a ray's next passage. False where it has none, or none for packets.
template <class Walker>
bool PacketTile<Walker>::prepare(std::size_t index, const std::optional<Entry>& entry,
                                 double seen_until) {
  TileRay& ray = rays_[index];
  if (!entry) return false;
  // Up to what single precision makes of one and the same place, an overlap is none.
  constexpr double kSame = 1e-6;
  const double overlap = (seen_until - entry->place.z) * ray.frame.sign();
  if (overlap > kSame) {
    ray.declined = true;
    return false;
  }
  Crossing place = entry->place;
  if (overlap > 0) place.z = seen_until;
  if (!visits_.empty() && ray.frame.t(place.z) - ray.frame.t(seen_until) > gap_)
    visits_[index] = {};
  set_start(ray.start, mesh_, ray.frame, mesh_.boundary[entry->boundary], place, entry->rank,
            static_cast<std::uint32_t>(index));
  ++ray.entries;
  return true;
}

// Rays of one axis; one that has left is let in again where there is another entry.
template <class Walker>
class PacketTile<Walker>::Feeder : public PacketFeeder {
 public:
  Feeder(PacketTile& tile, int axis) : tile_(tile), axis_(axis) {}

  const PacketStart* next(const PacketStart* finished) override {
    if (finished != nullptr) {
      TileRay& ray = tile_.rays_[finished->ray];
      const PacketColor& color = tile_.colors_[finished->ray];
      if (!color.opaque) {
        const Walker walker(tile_.mesh_, ray.frame);
        if (tile_.prepare(finished->ray, ray.all_entries.next(tile_.boundary_, walker, ray.frame),
                          color.z))
          return &ray.start;
      }
    }
    while (at_ < tile_.size_) {
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

template <class Walker>
void PacketTile<Walker>::composite(PacketOptics optics) {
  visits_.assign(optics.classified != nullptr ? size_ : 0, PacketVisit{});
  if (optics.classified != nullptr) optics.classified->visits = visits_;
  walk_by([&](std::span<PacketColor> colors, int axis, PacketFeeder& feeder) {
    optics.colors = colors;
    composite_packets(mesh_, optics, axis, feeder);
  });
}

template <class Walker>
void PacketTile<Walker>::walk_by(const PacketWalkOfRays& walk) {
  colors_.assign(size_, PacketColor{});
  for (int axis = 0; axis < 3; ++axis) {
    Feeder feeder(*this, axis);
    walk(colors_, axis, feeder);
  }
}

template <class Walker>
PacketResult PacketTile<Walker>::result(std::size_t number) const {
  const std::uint32_t place = places_[number];
  const PacketColor& color = colors_[place];
  const TileRay& ray = rays_[place];
  return {color,
          {ray.entries > 0 && color.opaque ? WalkEnd::stopped : WalkEnd::left, ray.entries,
           color.cells},
          ray.declined};
}

template class PacketTile<TetWalker>;
template class PacketTile<GridWalker>;
template class PacketTile<CellWalker>;

}  // namespace plume
