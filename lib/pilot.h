/// A look at a picture's error before it is rendered.
#pragma once

#include <compare>
#include <cstddef>
#include <limits>
#include <map>
#include <mutex>
#include <vector>

#include "plume/lib/render.h"

namespace plume {

/// What a pilot found.
struct PilotError {
  double found = 0;        ///< the greatest difference
  double estimate = 0;     ///< of the greatest difference in the whole picture; see Pilot
  std::size_t pixels = 0;  ///< compared
  bool all = false;        ///< of the picture: the estimate is then what was found
};

/// Compares settings with a reference on some of a picture's pixels: on a small version of the
/// whole, then in windows of the picture itself around the 64 places where that is worst, each
/// moved uphill while its worst pixel is at its rim. The same pixels for the same pictures: there
/// is no chance in it. Small pictures are compared as a whole.
///
/// **The estimate** of the greatest error e_1 that no pixel exceeds is what the windows' worst
/// pixels e_1 >= e_2 >= ... say of how the tail ends: e_1 + 3 (e_1 - e_12), after Robson and
/// Whitlock's bound of a truncation point by the largest observations (Biometrika 51, 1964). Where
/// the worst stands alone, worse ones may have been missed. Where many are alike, they may all be
/// of one ridge, and say nothing of others: it is twice e_1 at least. docs/evidence.md says how
/// often it is exceeded.
class Pilot {
 public:
  /// How much of the picture is looked at.
  enum class Look {
    full,  ///< one in four of the pixels along each side
    brief  ///< one in eight, and fewer windows: a check of what is known from another picture
  };

  /// `reference` has the picture's size, and no window. Keeps references to the scene and camera.
  Pilot(const Scene& scene, const Camera& camera, const RenderSettings& reference,
        Look look = Look::full);

  /// Compares settings of the reference's mode and size. Looks no further once more than `enough`
  /// was found: the estimate is then what was found.
  PilotError error_of(const RenderSettings& settings,
                      double enough = std::numeric_limits<double>::infinity());

 private:
  struct Place {
    int x, y;
    auto operator<=>(const Place&) const = default;
  };
  RenderSettings small(RenderSettings settings) const;
  /// Pixels of the picture, where the small version is worst.
  std::vector<Place> worst_places(const std::vector<double>& errors) const;
  PixelWindow window_around(const Place& place) const;
  const Image& reference_in(const PixelWindow& window);
  /// The greatest difference in a window around a place, moved uphill.
  double climb_from(Place place, const RenderSettings& settings, std::size_t& pixels);

  const Scene& scene_;
  const Camera& camera_;
  RenderSettings reference_;
  std::size_t windows_;
  int width_, height_;  // of the small version
  Image small_reference_;
  double shade_width_;
  std::mutex guard_;
  std::map<Place, Image> window_references_;  // by the windows' first pixels
};

}  // namespace plume
