/// What pixels of scenes with intervals or isosurfaces are made of segments by.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "plume/lib/classified_pixel.h"
#include "plume/lib/frame.h"
#include "plume/lib/scene_body.h"
#include "plume/lib/surface_light.h"

namespace plume {

/// Makes pixels of the modes volume and depth, with their further channels. Keeps references.
template <class Walkable, class Integrator>
class ClassifiedPixels {
 public:
  ClassifiedPixels(Frame& frame, const Walkable& walkable, const Integrator& integrator)
      : frame_(frame),
        walkable_(walkable),
        integrator_(integrator),
        optics_(frame.scene().classification(), frame.settings().interval_form),
        light_(frame, walkable) {
    const bool depth_alone = frame.settings().mode == Mode::depth;
    const bool whole_rays = frame.channels().whole_rays();
    pixel_settings_ = {
        frame.settings().early_termination, frame.tolerance(), frame.gap(), light_.on_intervals(),
        depth_alone && !whole_rays,         whole_rays};
  }

  /// `follow(pixel)` gives the segments of the ray to the ClassifiedPixel until that returns false.
  template <class Follow>
  TraceResult make(const PixelPlace& place, const Ray& ray, Counts& counts, const Follow& follow) {
    auto shade = [&](const SurfaceHit& hit) {
      return light_.is_on() ? light_.shading(ray, hit.t, hit.cell) : Shading{};
    };
    ClassifiedPixel pixel(optics_, integrator_, shade, pixel_settings_);
    const TraceResult result = follow(pixel);
    counts.surfaces += pixel.surfaces;
    counts.visits += pixel.visits;
    if (frame_.settings().mode == Mode::depth) {
      frame_.put_raw(place, pixel.first.t, pixel.first.is_one());
    } else {
      float* rgba = frame_.rgba(place);
      for (std::size_t c = 0; c < 3; ++c) rgba[c] = static_cast<float>(pixel.compositor.rgb[c]);
      rgba[3] = static_cast<float>(pixel.compositor.alpha());
    }
    const ChannelPlaces& channels = frame_.channels();
    frame_.put(channels.depth, place, pixel.first.t);
    frame_.put(channels.optical_depth, place, pixel.optical_depth);
    frame_.put(channels.cell_count, place, static_cast<double>(pixel.cells()));
    frame_.put(channels.cell_id, place,
               pixel.first.is_one() ? walkable_.mesh.original_cell(pixel.first.cell) : -1.0);
    frame_.put(channels.isovalue, place, pixel.first.scalar);
    if (!channels.normal.empty()) put_normal(place, ray, pixel.first);
    return result;
  }

 private:
  void put_normal(const PixelPlace& place, const Ray& ray, const SurfaceHit& hit) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::array<double, 3> gradient =
        hit.is_one() ? light_.gradient(ray, hit.t, hit.cell) : std::array<double, 3>{nan, nan, nan};
    const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
    for (std::size_t a = 0; a < 3; ++a)
      frame_.put(frame_.channels().normal[a], place, gradient[a] / length);
  }

  Frame& frame_;
  const Walkable& walkable_;
  const Integrator& integrator_;
  const ClassifiedOptics optics_;
  const SurfaceLight<Walkable> light_;
  ClassifiedPixelSettings pixel_settings_;
};

}  // namespace plume
