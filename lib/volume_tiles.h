/// Emission and absorption, ray by ray.
#pragma once

#include "plume/lib/follow_ray.h"
#include "plume/lib/tiles.h"

namespace plume {

/// A pixel of the mode volume.
template <class Walkable, class Integrator>
TraceResult volume_pixel(Frame& frame, const Walkable& walkable, const Integrator& integrator,
                         const PixelPlace& place) {
  VolumePixel<Integrator> pixel{integrator, static_cast<float>(frame.settings().early_termination),
                                frame.tolerance()};
  const TraceResult result = follow_ray(frame, walkable, place, pixel);
  float* rgba = frame.rgba(place);
  for (std::size_t c = 0; c < 3; ++c) rgba[c] = static_cast<float>(pixel.compositor.rgb[c]);
  rgba[3] = static_cast<float>(pixel.compositor.alpha());
  return result;
}

template <class Walkable, class Integrator>
class VolumeTiles : public TileMaker {
 public:
  VolumeTiles(Frame& frame, const Walkable& walkable, const Integrator& integrator)
      : frame_(frame), walkable_(walkable), integrator_(integrator) {}

  void make(const Tile& tile, Counts& counts) override {
    frame_.for_each_pixel(tile, [&](const PixelPlace& pixel) {
      counts.add(volume_pixel(frame_, walkable_, integrator_, pixel));
    });
  }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  const Integrator& integrator_;
};

}  // namespace plume
