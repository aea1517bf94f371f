/// All tiles of a picture, in parallel.
#pragma once

#include "plume/lib/frame.h"
#include "plume/lib/tiles.h"

namespace plume {

/// Adds up what rays came to. Returns whether `progress` has asked to stop.
bool make_tiles(const Frame& frame, TileMaker& maker, const Progress& progress,
                RenderStatistics& statistics);

}  // namespace plume
