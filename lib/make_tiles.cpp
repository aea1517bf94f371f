#include "plume/lib/make_tiles.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <mutex>

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

}  // namespace

bool make_tiles(const Frame& frame, TileMaker& maker, const Progress& progress,
                RenderStatistics& statistics) {
  const int across = frame.tiles_across(), tiles = across * frame.tiles_down();
  ProgressReport report(progress, tiles);
  tbb::enumerable_thread_specific<Counts> counts;
  tbb::parallel_for(tbb::blocked_range<int>(0, tiles, 1), [&](const auto& range) {
    for (int tile = range.begin(); tile != range.end(); ++tile) {
      if (report.cancelled()) return;
      maker.make({tile % across * kTile, tile / across * kTile}, counts.local());
      report.tile_done();
    }
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
