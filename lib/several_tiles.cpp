#include "plume/lib/several_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plume/lib/pixel.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/scene_body.h"

namespace plume {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool any_classified(const Frame& frame) {
  return std::any_of(frame.scenes().begin(), frame.scenes().end(),
                     [&](const Scene* scene) { return is_classified(*scene, frame.settings()); });
}

// Of all volumes one after the other, in any order.
template <class Pixel>
Pixel all_of(const std::vector<RayThrough>& throughs, Pixel pixel) {
  for (const RayThrough& through : throughs)
    for (const Segment& segment : through.segments) pixel(segment);
  return pixel;
}

double cells_of(const std::vector<RayThrough>& throughs) {
  double cells = 0;
  for (const RayThrough& through : throughs) {
    CellCountPixel count;
    for (const Segment& segment : through.segments) count(segment);
    cells += count.value();
  }
  return cells;
}

// The value of a Pixel of each volume's own optics, combined.
template <class Pixel, class Combine>
double each_of(const std::vector<VolumeOfSeveral>& volumes, const std::vector<RayThrough>& throughs,
               double value, const Combine& combine) {
  for (std::size_t v = 0; v < volumes.size(); ++v) {
    Pixel pixel{volumes[v].depth, volumes[v].tolerance};
    for (const Segment& segment : throughs[v].segments)
      if (!pixel(segment)) break;
    value = combine(value, pixel.value());
  }
  return value;
}

double first_of(const std::vector<VolumeOfSeveral>& volumes,
                const std::vector<RayThrough>& throughs) {
  return each_of<FirstPixel>(volumes, throughs, kInfinity,
                             [](double a, double b) { return std::min(a, b); });
}

double depth_of(const std::vector<VolumeOfSeveral>& volumes,
                const std::vector<RayThrough>& throughs) {
  return each_of<OpticalDepthPixel>(volumes, throughs, 0, [](double a, double b) { return a + b; });
}

}  // namespace

// What a thread needs for one ray after the other.
struct SeveralTiles::Rays {
  Ray ray;
  std::vector<RayThrough> throughs;
  std::vector<RayRange> covered;
  MixedVolumes mixed;

  explicit Rays(const SeveralTiles& tiles)
      : throughs(tiles.volumes_.size()), mixed(tiles.frame_, tiles.volumes_, tiles.hits_) {}
};

SeveralTiles::SeveralTiles(Frame& frame)
    : frame_(frame),
      volumes_(volumes_of(frame)),
      hits_(any_classified(frame)),
      mixed_(frame.settings().mode == Mode::volume || frame.settings().mode == Mode::depth) {}

void SeveralTiles::make(TileSource& tiles, Counts& counts) {
  Rays rays(*this);
  frame_.for_each_pixel(tiles, [&](const PixelPlace& place) {
    follow_all(place, rays, counts);
    settle_overlaps(place, rays, counts);
    if (mixed_)
      make_mixed(place, rays, counts);
    else
      make_number(place, rays);
    frame_.put(frame_.channels().cell_count, place, cells_of(rays.throughs));
  });
}

void SeveralTiles::follow_all(const PixelPlace& place, Rays& rays, Counts& counts) {
  const RenderSettings& settings = frame_.settings();
  rays.ray = frame_.ray(place);
  // What hides the rest, but where all overlaps are to be found.
  const bool ends_early = settings.mode == Mode::volume && !frame_.channels().whole_rays() &&
                          settings.overlap != Overlap::refuse;
  double limit = kInfinity;
  bool hit = false;
  for (std::size_t v = 0; v < volumes_.size(); ++v) {
    rays.throughs[v].clear();
    // What of a later volume is seen is not known yet where the first of two counts alone.
    const bool bounds = ends_early && (settings.overlap == Overlap::add || v == 0);
    const TraceResult result =
        follow(volumes_[v], frame_, rays.ray, bounds, limit, rays.throughs[v]);
    counts.entries += result.entries;
    counts.cells += result.cells;
    counts.lost += result.end == WalkEnd::lost ? 1 : 0;
    hit = hit || result.entries > 0;
  }
  counts.hit += hit ? 1 : 0;
}

void SeveralTiles::settle_overlaps(const PixelPlace& place, Rays& rays, Counts& counts) {
  const Overlap wanted = frame_.settings().overlap;
  bool any = false;
  rays.covered.clear();
  for (std::size_t v = 0; v < volumes_.size(); ++v) {
    RayThrough& through = rays.throughs[v];
    if (through.segments.empty()) continue;
    for_each_overlap(through.passages, rays.covered, frame_.gap(),
                     [&](const RayRange&) { any = true; });
    if (any && wanted == Overlap::refuse)
      for (std::size_t before = 0; before < v; ++before)
        for_each_overlap(through.passages, rays.throughs[before].passages, frame_.gap(),
                         [&](const RayRange& range) {
                           note({place, before, v, range});
                         });
    const std::vector<RayRange> passages = through.passages;
    if (wanted == Overlap::first && !rays.covered.empty())
      leave_out(through, rays.covered, frame_.gap());
    join(rays.covered, passages);
  }
  counts.overlapping += any ? 1 : 0;
}

// The first of the first pixel, whichever thread finds it when.
void SeveralTiles::note(const FoundOverlap& found) {
  const std::lock_guard lock(guard_);
  if (!overlap_ || found.pixel.index < overlap_->pixel.index) overlap_ = found;
}

void SeveralTiles::make_mixed(const PixelPlace& place, Rays& rays, Counts& counts) {
  const MixedRay& mixed = rays.mixed.make(rays.ray, rays.throughs, counts);
  const MixedHit& hit = mixed.first_hit();
  const double first = hits_ ? hit.t : mixed.first_extinction();
  if (frame_.settings().mode == Mode::depth) {
    frame_.put_raw(place, first, first < kInfinity);
  } else {
    float* rgba = frame_.rgba(place);
    for (std::size_t c = 0; c < 3; ++c) rgba[c] = static_cast<float>(mixed.color().rgb[c]);
    rgba[3] = static_cast<float>(mixed.color().alpha);
  }
  const ChannelPlaces& channels = frame_.channels();
  frame_.put(channels.depth, place, first);
  frame_.put(channels.optical_depth, place, mixed.optical_depth());
  frame_.put(channels.isovalue, place, hit.scalar);
  if (channels.normal.empty()) return;
  const auto normal = rays.mixed.normal(hit);
  for (std::size_t a = 0; a < 3; ++a) frame_.put(channels.normal[a], place, normal[a]);
}

void SeveralTiles::make_number(const PixelPlace& place, const Rays& rays) {
  const auto put = [&](const auto& pixel) { frame_.put_raw(place, pixel.value(), pixel.seen()); };
  const bool any = std::any_of(rays.throughs.begin(), rays.throughs.end(),
                               [](const RayThrough& through) { return !through.segments.empty(); });
  switch (frame_.settings().mode) {
    case Mode::volume:
    case Mode::depth:
      break;
    case Mode::maximum:
      put(all_of(rays.throughs, MaximumPixel{}));
      break;
    case Mode::minimum:
      put(all_of(rays.throughs, MinimumPixel{}));
      break;
    case Mode::average:
      put(all_of(rays.throughs, AveragePixel{}));
      break;
    case Mode::integral:
      put(all_of(rays.throughs, IntegralPixel{}));
      break;
    case Mode::optical_depth:
      frame_.put_raw(place, depth_of(volumes_, rays.throughs), any);
      break;
    case Mode::cell_count:
      frame_.put_raw(place, cells_of(rays.throughs), any);
      break;
  }
  const ChannelPlaces& channels = frame_.channels();
  if (channels.depth) frame_.put(channels.depth, place, first_of(volumes_, rays.throughs));
  if (channels.optical_depth)
    frame_.put(channels.optical_depth, place, depth_of(volumes_, rays.throughs));
}

}  // namespace plume
