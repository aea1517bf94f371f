#include <type_traits>

#include "plume/lib/mode_pixels.h"

namespace plume {

std::unique_ptr<TileMaker> mode_tiles(Frame& frame) {
  return with_mode_pixel(frame, [&](const auto& walkable, const auto& fresh) {
    return std::make_unique<
        ModeTiles<std::decay_t<decltype(walkable)>, std::decay_t<decltype(fresh)>>>(frame, walkable,
                                                                                    fresh);
  });
}

}  // namespace plume
