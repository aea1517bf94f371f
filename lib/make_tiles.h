/// All of a picture in parallel.
#pragma once

#include <tbb/task_arena.h>

#include <algorithm>

#include "plume/lib/frame.h"
#include "plume/lib/tiles.h"

namespace plume {

/// What make() returns, on so many threads, or on all that there are where it is 0.
template <class Make>
auto on_threads(int threads, const Make& make) {
  const int available = tbb::this_task_arena::max_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, available) : available);
  return arena.execute(make);
}

/// On the threads of the arena that it is called in. Adds up what rays came to. Returns whether
/// `progress` has asked to stop.
bool make_tiles(const Frame& frame, TileMaker& maker, const Progress& progress,
                RenderStatistics& statistics);

}  // namespace plume
