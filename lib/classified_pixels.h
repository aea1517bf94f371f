/// What pixels of scenes with intervals or isosurfaces are made of segments by.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "plume/lib/classified_pixel.h"
#include "plume/lib/frame.h"
#include "plume/lib/scene_body.h"

namespace plume {

/// Passages closer than this share of the mesh's diagonal are one, as far as intervals and
/// isosurfaces are concerned: places on the faces of blocks that touch differ by rounding, which is
/// some 1e-7 of the mesh.
inline constexpr double kGap = 1e-6;

/// Makes pixels of the modes volume and depth, with their further channels. Keeps references.
template <class Walkable, class Integrator>
class ClassifiedPixels {
 public:
  ClassifiedPixels(Frame& frame, const Walkable& walkable, const Integrator& integrator)
      : frame_(frame),
        walkable_(walkable),
        integrator_(integrator),
        optics_(frame.scene().classification(), frame.settings().interval_form),
        lighting_(frame.settings().lighting) {
    const bool depth_alone = frame.settings().mode == Mode::depth;
    const bool whole_rays = frame.channels().whole_rays();
    pixel_settings_ = {frame.settings().early_termination,
                       frame.tolerance(),
                       kGap * frame.scene().bounds().diagonal(),
                       lighting_ && lighting_->intervals,
                       depth_alone && !whole_rays,
                       whole_rays};
  }

  /// `follow(pixel)` gives the segments of the ray to the ClassifiedPixel until that returns false.
  template <class Follow>
  TraceResult make(const PixelPlace& place, const Ray& ray, Counts& counts, const Follow& follow) {
    auto shade = [&](const SurfaceHit& hit) {
      return lighting_ ? shading_of(*lighting_, gradient_at(ray, hit), ray.direction) : Shading{};
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
    frame_.put(channels.cell_count, place, static_cast<double>(pixel.cells));
    frame_.put(channels.cell_id, place,
               pixel.first.is_one() ? walkable_.mesh.original_cell(pixel.first.cell) : -1.0);
    frame_.put(channels.isovalue, place, pixel.first.scalar);
    if (!channels.normal.empty()) put_normal(place, ray, pixel.first);
    return result;
  }

 private:
  using Gradient = std::array<double, 3>;

  Gradient gradient_at(const Ray& ray, const SurfaceHit& hit) const {
    std::array<double, 3> place;
    for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + hit.t * ray.direction[a];
    return frame_.scene().body().gradients->at(walkable_.mesh, hit.cell, place);
  }

  void put_normal(const PixelPlace& place, const Ray& ray, const SurfaceHit& hit) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Gradient gradient = hit.is_one() ? gradient_at(ray, hit) : Gradient{nan, nan, nan};
    const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
    for (std::size_t a = 0; a < 3; ++a)
      frame_.put(frame_.channels().normal[a], place, gradient[a] / length);
  }

  Frame& frame_;
  const Walkable& walkable_;
  const Integrator& integrator_;
  const ClassifiedOptics optics_;
  const std::optional<Lighting>& lighting_;
  ClassifiedPixelSettings pixel_settings_;
};

}  // namespace plume
