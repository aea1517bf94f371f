#include "plume/lib/packet_stream.h"

#include <algorithm>

namespace plume {

template <class Walker>
PacketStream<Walker>::PacketStream(const Mesh& mesh, const BoundaryIndex<Walker>& boundary,
                                   double gap)
    : mesh_(mesh), boundary_(boundary), gap_(gap) {
  rays_.reserve(kMostRays);
}

// Whether a block of rays finds numbers, and whatever lanes hold besides.
template <class Walker>
bool PacketStream<Walker>::has_room() const {
  return rays_.size() - free_.size() + RayLanes::kRays <= kMostRays;
}

template <class Walker>
std::uint32_t PacketStream<Walker>::take_number() {
  if (free_.empty()) {
    rays_.emplace_back();
    return static_cast<std::uint32_t>(rays_.size() - 1);
  }
  const std::uint32_t number = free_.back();
  free_.pop_back();
  return number;
}

// Sets up the next rays; those that meet the mesh wait. False at the end.
template <class Walker>
bool PacketStream<Walker>::fetch(StreamPixels& pixels) {
  if (!pixels.next(pixels_, lanes_)) return false;
  frames_.set(lanes_, mesh_.frame);
  boundary_.first_entries(frames_, found_);
  for (std::size_t i = 0; i < lanes_.size; ++i) {
    if (found_[i].size == 0) {
      pixels.miss(pixels_[i]);
      continue;
    }
    const std::uint32_t number = take_number();
    StreamRay& ray = rays_[number];
    ray.ray = lanes_.ray(i);
    frames_.put(i, ray.frame);
    ray.all_entries.list() = found_[i];
    ray.pixel = pixels_[i];
    ray.entries = 0;
    ray.declined = false;
    colors_[number] = {};
    if (!visits_.empty()) visits_[number] = {};
    pixels.begin(number);
    const auto entry = ray.all_entries.first();
    ray.declined = ray.frame.t(entry->place.z) < ray.ray.t_min;
    if (!ray.declined && prepare(number, entry, entry->place.z))
      waiting_[static_cast<std::size_t>(ray.frame.axis())].push(number);
    else
      finish(number, pixels);
  }
  return true;
}

// Sets up a ray's next passage. False where it has none, or none for packets.
template <class Walker>
bool PacketStream<Walker>::prepare(std::uint32_t number, const std::optional<Entry>& entry,
                                   double seen_until) {
  StreamRay& ray = rays_[number];
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
    visits_[number] = {};
  set_start(ray.start, mesh_, ray.frame, mesh_.boundary[entry->boundary], place, entry->rank,
            number);
  ++ray.entries;
  return true;
}

template <class Walker>
void PacketStream<Walker>::finish(std::uint32_t number, StreamPixels& pixels) {
  const StreamRay& ray = rays_[number];
  const PacketColor& color = colors_[number];
  if (ray.declined)
    pixels.decline(ray.pixel);
  else
    pixels.put(ray.pixel, color,
               {color.opaque ? WalkEnd::stopped : WalkEnd::left, ray.entries, color.cells}, number);
  free_.push_back(number);
}

// Rays of one axis; one that has left is let in again where there is another entry.
template <class Walker>
class PacketStream<Walker>::Feeder : public PacketFeeder {
 public:
  Feeder(PacketStream& stream, int axis, StreamPixels& pixels)
      : stream_(stream),
        waiting_(stream.waiting_[static_cast<std::size_t>(axis)]),
        pixels_(pixels) {}

  const PacketStart* next(const PacketStart* finished) override {
    if (finished != nullptr && goes_on(finished->ray)) return finished;
    // Where rays of other axes have taken all the room, lanes run empty and it is their turn.
    if (waiting_.empty())
      while (waiting_.size() < kAhead && !ends_)
        ends_ = !stream_.has_room() || !stream_.fetch(pixels_);
    if (waiting_.empty()) return nullptr;
    return &stream_.rays_[waiting_.pop()].start;
  }

 private:
  // Rays set up at a time: setting up and walking then take turns less often (1% of a frame).
  static constexpr std::size_t kAhead = 64;

  bool goes_on(std::uint32_t number) {
    StreamRay& ray = stream_.rays_[number];
    const PacketColor& color = stream_.colors_[number];
    if (!color.opaque) {
      const Walker walker(stream_.mesh_, ray.frame);
      if (stream_.prepare(number, ray.all_entries.next(stream_.boundary_, walker, ray.frame),
                          color.z))
        return true;
    }
    stream_.finish(number, pixels_);
    return false;
  }

  PacketStream& stream_;
  Queue& waiting_;
  StreamPixels& pixels_;
  bool ends_ = false;
};

// That of most rays; nothing at the end.
template <class Walker>
std::optional<int> PacketStream<Walker>::next_axis(StreamPixels& pixels) {
  for (;;) {
    const auto most = std::max_element(
        waiting_.begin(), waiting_.end(),
        [](const Queue& one, const Queue& other) { return one.size() < other.size(); });
    if (!most->empty()) return static_cast<int>(most - waiting_.begin());
    if (!fetch(pixels)) return std::nullopt;
  }
}

template <class Walker>
void PacketStream<Walker>::walk_by(const PacketWalkOfRays& walk, StreamPixels& pixels) {
  while (const std::optional<int> axis = next_axis(pixels)) {
    Feeder feeder(*this, *axis, pixels);
    walk(colors_, *axis, feeder);
  }
}

template <class Walker>
void PacketStream<Walker>::composite(PacketOptics optics, StreamPixels& pixels) {
  if (optics.classified != nullptr) {
    visits_.resize(kMostRays);
    optics.classified->visits = visits_;
  }
  walk_by(
      [&](std::span<PacketColor> colors, int axis, PacketFeeder& feeder) {
        optics.colors = colors;
        composite_packets(mesh_, optics, axis, feeder);
      },
      pixels);
}

template class PacketStream<TetWalker>;
template class PacketStream<GridWalker>;
template class PacketStream<CellWalker>;

}  // namespace plume
