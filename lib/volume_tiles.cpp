#include "plume/lib/volume_tiles.h"

#include <variant>

#include "plume/lib/tiles.h"

namespace plume {

std::unique_ptr<TileMaker> volume_tiles(Frame& frame, const Integrator& integrator) {
  return std::visit(
      [&](const auto& walkable, const auto& chosen) -> std::unique_ptr<TileMaker> {
        return std::make_unique<
            VolumeTiles<std::decay_t<decltype(*walkable)>, std::decay_t<decltype(chosen)>>>(
            frame, *walkable, chosen);
      },
      frame.scene().body().walkable, integrator);
}

}  // namespace plume
