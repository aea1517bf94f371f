#include <type_traits>
#include <variant>

#include "plume/lib/classified_pixels.h"
#include "plume/lib/follow_ray.h"
#include "plume/lib/tiles.h"

namespace plume {
namespace {

template <class Walkable, class Integrator>
class ClassifiedTiles : public TileMaker {
 public:
  ClassifiedTiles(Frame& frame, const Walkable& walkable, const Integrator& integrator)
      : frame_(frame), walkable_(walkable), pixels_(frame, walkable, integrator) {}

  void make(const Tile& tile, Counts& counts) override {
    frame_.for_each_pixel(tile, [&](const PixelPlace& place) {
      const Ray ray = frame_.ray(place);
      counts.add(pixels_.make(place, ray, counts, [&](auto& pixel) {
        return trace_clipped(frame_, walkable_, ray, pixel);
      }));
    });
  }

 private:
  Frame& frame_;
  const Walkable& walkable_;
  ClassifiedPixels<Walkable, Integrator> pixels_;
};

}  // namespace

std::unique_ptr<TileMaker> classified_tiles(Frame& frame, const Integrator& integrator) {
  return std::visit(
      [&](const auto& walkable, const auto& chosen) -> std::unique_ptr<TileMaker> {
        return std::make_unique<
            ClassifiedTiles<std::decay_t<decltype(*walkable)>, std::decay_t<decltype(chosen)>>>(
            frame, *walkable, chosen);
      },
      frame.scene().body().walkable, integrator);
}

}  // namespace plume
