#include <type_traits>
#include <variant>

#include "plume/lib/follow_ray.h"
#include "plume/lib/tiles.h"

namespace plume {
namespace {

template <class Walkable, class Pixel>
class ModeTiles : public TileMaker {
 public:
  ModeTiles(Frame& frame, const Walkable& walkable, const Pixel& fresh)
      : frame_(frame), walkable_(walkable), fresh_(fresh) {}

  void make(const Tile& tile, Counts& counts) override {
    frame_.for_each_pixel(tile, [&](const PixelPlace& place) {
      Pixel pixel = fresh_;
      counts.add(follow_ray(frame_, walkable_, place, pixel));
      frame_.put_raw(place, pixel.value(), pixel.seen());
    });
  }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  const Pixel fresh_;
};

}  // namespace

std::unique_ptr<TileMaker> mode_tiles(Frame& frame) {
  return std::visit(
      [&](const auto& walkable) -> std::unique_ptr<TileMaker> {
        auto tiles_of = [&](const auto& fresh) -> std::unique_ptr<TileMaker> {
          return std::make_unique<
              ModeTiles<std::decay_t<decltype(*walkable)>, std::decay_t<decltype(fresh)>>>(
              frame, *walkable, fresh);
        };
        switch (frame.settings().mode) {
          case Mode::volume:
            break;
          case Mode::maximum:
            return tiles_of(MaximumPixel{});
          case Mode::minimum:
            return tiles_of(MinimumPixel{});
          case Mode::average:
            return tiles_of(AveragePixel{});
          case Mode::integral:
            return tiles_of(IntegralPixel{});
          case Mode::optical_depth:
            return tiles_of(OpticalDepthPixel{frame.optical_depth(), frame.tolerance()});
          case Mode::depth:
            return tiles_of(FirstPixel{frame.optical_depth(), frame.tolerance()});
          case Mode::cell_count:
            return tiles_of(CellCountPixel{});
        }
        return nullptr;
      },
      frame.scene().body().walkable);
}

}  // namespace plume
