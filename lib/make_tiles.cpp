#include "plume/lib/make_tiles.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

namespace plume {
namespace {

// Calls the user's progress function with growing shares, one thread at a time.
class ProgressReport {
 public:
  ProgressReport(const Progress& progress, int tiles) : progress_(progress), tiles_(tiles) {}

  void tile_done() {
    if (!progress_) return;
    const std::lock_guard lock(guard_);
    ++done_;
    if (!cancelled_ && !progress_(static_cast<double>(done_) / tiles_)) cancelled_ = true;
  }
  bool cancelled() const { return cancelled_; }

 private:
  const Progress& progress_;
  const int tiles_;
  std::mutex guard_;
  int done_ = 0;
  std::atomic<bool> cancelled_ = false;
};

// One thread's: whoever asks first gets a tile.
class SharedTiles : public TileSource {
 public:
  SharedTiles(const Frame& frame, std::atomic<int>& given, ProgressReport& report)
      : across_(frame.tiles_across()),
        tiles_(across_ * frame.tiles_down()),
        given_(given),
        report_(report) {}

  std::optional<Tile> next() override {
    if (has_tile_) report_.tile_done();
    const int tile = report_.cancelled() ? tiles_ : given_++;
    has_tile_ = tile < tiles_;
    if (!has_tile_) return std::nullopt;
    return Tile{tile % across_ * kTile, tile / across_ * kTile};
  }

 private:
  const int across_, tiles_;
  std::atomic<int>& given_;
  ProgressReport& report_;
  bool has_tile_ = false;
};

}  // namespace

bool make_tiles(const Frame& frame, TileMaker& maker, const Progress& progress,
                RenderStatistics& statistics) {
  const int tiles = frame.tiles_across() * frame.tiles_down();
  ProgressReport report(progress, tiles);
  std::atomic<int> given = 0;
  tbb::enumerable_thread_specific<Counts> counts;
  // A source for each thread; what no thread comes to is empty by then.
  const int threads = std::min(tbb::this_task_arena::max_concurrency(), tiles);
  tbb::parallel_for(0, threads, [&](int) {
    SharedTiles source(frame, given, report);
    maker.make(source, counts.local());
  });
  for (const Counts& part : counts) {
    statistics.rays_hit += part.hit;
    statistics.entries += part.entries;
    statistics.cells_visited += part.cells;
    statistics.lost_rays += part.lost;
    statistics.rays_in_packets += part.in_packets;
    statistics.rays_searched += part.searched;
    statistics.surfaces += part.surfaces;
    statistics.visits += part.visits;
    statistics.rays_overlapping += part.overlapping;
  }
  return report.cancelled();
}

}  // namespace plume
