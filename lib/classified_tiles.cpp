#include "plume/lib/classified_tiles.h"

#include <type_traits>
#include <variant>

namespace plume {

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
