/// Scenes with intervals or isosurfaces, ray by ray.
#pragma once

#include "plume/lib/classified_pixels.h"
#include "plume/lib/follow_ray.h"
#include "plume/lib/tiles.h"

namespace plume {

template <class Walkable, class Integrator>
class ClassifiedTiles : public TileMaker {
 public:
  ClassifiedTiles(Frame& frame, const Walkable& walkable, const Integrator& integrator)
      : frame_(frame),
        walkable_(walkable),
        integrator_(integrator),
        pixels_(frame, walkable, integrator) {}

  void make(TileSource& tiles, Counts& counts) override {
    frame_.for_each_pixel(tiles, [&](const PixelPlace& place) { make_pixel(place, counts); });
  }

  void make_pixel(const PixelPlace& place, Counts& counts) {
    const Ray ray = frame_.ray(place);
    make_pixel(place, counts,
               [&](auto& pixel) { return trace_clipped(frame_, walkable_, ray, pixel); });
  }

  /// Of the segments that follow(pixel) gives to the ClassifiedPixel until that returns false.
  template <class Follow>
  void make_pixel(const PixelPlace& place, Counts& counts, const Follow& follow) {
    counts.add(pixels_.make(place, frame_.ray(place), counts, follow));
  }

  const Integrator& integrator() const { return integrator_; }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  const Integrator& integrator_;
  ClassifiedPixels<Walkable, Integrator> pixels_;
};

}  // namespace plume
