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
      : frame_(frame), walkable_(walkable), pixels_(frame, walkable, integrator) {}

  void make(const Tile& tile, Counts& counts) override {
    frame_.for_each_pixel(tile, [&](const PixelPlace& place) { make_pixel(place, counts); });
  }

  void make_pixel(const PixelPlace& place, Counts& counts) {
    const Ray ray = frame_.ray(place);
    counts.add(pixels_.make(place, ray, counts, [&](auto& pixel) {
      return trace_clipped(frame_, walkable_, ray, pixel);
    }));
  }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  ClassifiedPixels<Walkable, Integrator> pixels_;
};

}  // namespace plume
