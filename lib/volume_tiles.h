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

  void make(TileSource& tiles, Counts& counts) override {
    frame_.for_each_pixel(tiles, [&](const PixelPlace& pixel) { make_pixel(pixel, counts); });
  }

  void make_pixel(const PixelPlace& place, Counts& counts) {
    make_pixel(place, counts, [&](auto& visit) {
      return trace_clipped(frame_, walkable_, frame_.ray(place), visit);
    });
  }

  /// Of the segments that follow_segments() is given.
  template <class Follow>
  void make_pixel(const PixelPlace& place, Counts& counts, const Follow& follow) {
    VolumePixel<Integrator> pixel = fresh();
    counts.add(follow_segments(frame_, walkable_, place, pixel, follow));
    float* rgba = frame_.rgba(place);
    for (std::size_t c = 0; c < 3; ++c) rgba[c] = static_cast<float>(pixel.compositor.rgb[c]);
    rgba[3] = static_cast<float>(pixel.compositor.alpha());
  }

  VolumePixel<Integrator> fresh() const {
    return {integrator_, static_cast<float>(frame_.settings().early_termination),
            frame_.tolerance()};
  }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  const Integrator& integrator_;
};

}  // namespace plume
