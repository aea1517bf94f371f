/// The modes that show one number a ray, ray by ray.
#pragma once

#include <variant>

#include "plume/lib/follow_ray.h"
#include "plume/lib/tiles.h"

namespace plume {

template <class Walkable, class Pixel>
class ModeTiles : public TileMaker {
 public:
  ModeTiles(Frame& frame, const Walkable& walkable, const Pixel& fresh)
      : frame_(frame), walkable_(walkable), fresh_(fresh) {}

  void make(TileSource& tiles, Counts& counts) override {
    frame_.for_each_pixel(tiles, [&](const PixelPlace& place) { make_pixel(place, counts); });
  }

  void make_pixel(const PixelPlace& place, Counts& counts) {
    make_pixel(place, counts, [&](auto& visit) {
      return trace_clipped(frame_, walkable_, frame_.ray(place), visit);
    });
  }

  /// Of the segments that follow_segments() is given.
  template <class Follow>
  void make_pixel(const PixelPlace& place, Counts& counts, const Follow& follow) {
    Pixel pixel = fresh_;
    counts.add(follow_segments(frame_, walkable_, place, pixel, follow));
    frame_.put_raw(place, pixel.value(), pixel.seen());
  }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  const Pixel fresh_;
};

/// Calls make(walkable, pixel) with what the frame's scene is walked as and a fresh pixel of its
/// mode, which is not Mode::volume.
template <class Make>
std::unique_ptr<TileMaker> with_mode_pixel(const Frame& frame, const Make& make) {
  return std::visit(
      [&](const auto& walkable) -> std::unique_ptr<TileMaker> {
        switch (frame.settings().mode) {
          case Mode::volume:
            break;
          case Mode::maximum:
            return make(*walkable, MaximumPixel{});
          case Mode::minimum:
            return make(*walkable, MinimumPixel{});
          case Mode::average:
            return make(*walkable, AveragePixel{});
          case Mode::integral:
            return make(*walkable, IntegralPixel{});
          case Mode::optical_depth:
            return make(*walkable, OpticalDepthPixel{frame.optical_depth(), frame.tolerance()});
          case Mode::depth:
            return make(*walkable, FirstPixel{frame.optical_depth(), frame.tolerance()});
          case Mode::cell_count:
            return make(*walkable, CellCountPixel{});
        }
        return nullptr;
      },
      frame.scene().body().walkable);
}

}  // namespace plume
