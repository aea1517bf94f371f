/// A look at a picture's error before it is rendered.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <vector>

#include "plume/lib/render.h"

namespace plume {

/// Compares settings with a reference on a few of a picture's pixels: on a small version of the
/// whole, and in windows of the picture itself around the places where that is worst. The same
/// pixels for the same pictures: there is no chance in it.
class Pilot {
 public:
  /// `reference` has the picture's size, and no window. Keeps references to the scene and camera.
  Pilot(const Scene& scene, const Camera& camera, const RenderSettings& reference);

  /// The greatest difference found (see greatest_difference() in planner.h). Settings of the
  /// reference's mode and size.
  double error_of(const RenderSettings& settings);

  /// Pixels compared for the last settings.
  std::size_t pixels() const { return pixels_; }

 private:
  struct Place {
    int x, y;
    auto operator<=>(const Place&) const = default;
  };
  RenderSettings small(RenderSettings settings) const;
  std::vector<Place> worst_places(const Image& picture) const;
  PixelWindow window_around(const Place& place) const;
  const Image& reference_in(const PixelWindow& window);

  const Scene& scene_;
  const Camera& camera_;
  RenderSettings reference_;
  int width_, height_;  // of the small version
  Image small_reference_;
  double shade_width_;
  std::map<Place, Image> window_references_;  // by the windows' first pixels
  std::size_t pixels_ = 0;
};

}  // namespace plume
