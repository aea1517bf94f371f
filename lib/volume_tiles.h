/// Emission and absorption, ray by ray.
#pragma once

#include "plume/lib/follow_ray.h"
#include "plume/lib/tiles.h"

namespace plume {

/// The mode volume of a scene that shows a volume alone.
template <class Walkable, class Integrator>
class VolumeTiles : public TileMaker {
 public:
  VolumeTiles(Frame& frame, const Walkable& walkable, const Integrator& integrator)
      : frame_(frame), walkable_(walkable), integrator_(integrator) {}

  void make(const Tile& tile, Counts& counts) override {
    frame_.for_each_pixel(tile, [&](const PixelPlace& pixel) { make_pixel(pixel, counts); });
  }

  void make_pixel(const PixelPlace& place, Counts& counts) {
    VolumePixel<Integrator> pixel{
        integrator_, static_cast<float>(frame_.settings().early_termination), frame_.tolerance()};
    counts.add(follow_ray(frame_, walkable_, place, pixel));
    float* rgba = frame_.rgba(place);
    for (std::size_t c = 0; c < 3; ++c) rgba[c] = static_cast<float>(pixel.compositor.rgb[c]);
    rgba[3] = static_cast<float>(pixel.compositor.alpha());
  }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  const Integrator& integrator_;
};

}  // namespace plume
