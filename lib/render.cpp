#include "plume/lib/render.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/tick_count.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#include "plume/lib/frame.h"
#include "plume/lib/planner.h"
#include "plume/lib/render_check.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/scene_body.h"
#include "plume/lib/tiles.h"
#include "plume/traverse/packets.h"

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

// Makes all tiles; returns whether that was cancelled.
bool make_tiles(const Frame& frame, TileMaker& maker, const Progress& progress,
                RenderStatistics& statistics) {
  const int across = frame.tiles_across(), tiles = across * frame.tiles_down();
  ProgressReport report(progress, tiles);
  tbb::enumerable_thread_specific<Counts> counts;
  const int available = tbb::this_task_arena::max_concurrency();
  const int threads = frame.settings().threads;
  tbb::task_arena arena(threads > 0 ? std::min(threads, available) : available);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<int>(0, tiles, 1), [&](const auto& range) {
      for (int tile = range.begin(); tile != range.end(); ++tile) {
        if (report.cancelled()) return;
        maker.make({tile % across * kTile, tile / across * kTile}, counts.local());
        report.tile_done();
      }
    });
  });
  for (const Counts& part : counts) {
    statistics.rays_hit += part.hit;
    statistics.entries += part.entries;
    statistics.cells_visited += part.cells;
    statistics.lost_rays += part.lost;
    statistics.rays_in_packets += part.in_packets;
    statistics.surfaces += part.surfaces;
    statistics.visits += part.visits;
  }
  return report.cancelled();
}

}  // namespace

RenderResult render(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                    const Progress& progress) {
  check_settings(scene, settings);
  RenderResult result;
  std::vector<std::string> reasons;
  const tbb::tick_count start = tbb::tick_count::now();
  RenderSettings effective =
      settings.tolerance ? plan_for(scene, camera, settings, reasons) : settings;
  result.statistics.seconds_planning = (tbb::tick_count::now() - start).seconds();
  result.statistics.order = effective.order;
  Frame frame(scene, camera, effective);
  std::vector<std::string>& plan = result.statistics.plan;
  plan = describe_plan(scene, effective);
  plan.insert(plan.begin(), reasons.begin(), reasons.end());
  const std::optional<PacketPieces> pieces = pieces_for_packets(frame);
  if (has_packets(scene))
    plan.push_back(
        pieces ? fmt::format("rays: in packets, {}", packet_instruction_set())
               : "rays: one by one (packets serve the volume mode by the closed form, "
                 "at order 1, without tables or the linear form of intervals, clip planes and "
                 "further channels)");
  if (settings.mode == Mode::volume) {
    if (frame.channels().whole_rays()) effective.early_termination = 0;
    plan.push_back(frame.channels().whole_rays()
                       ? "early termination: off, as a channel needs whole rays"
                       : fmt::format("early termination: at a transmittance of {:g}",
                                     effective.early_termination));
  }

  // A table is built only where the picture needs what is in it: colours.
  if (settings.mode != Mode::volume || !scene.classification().volume)
    effective.integrator.kind = IntegratorKind::closed_form;
  const Integrator integrator = make_integrator(scene.transfer_function(), effective.integrator);
  const bool by_table =
      is_classified(scene, settings) && settings.interval_way == IntervalWay::table;
  const auto maker = by_table                         ? table_tiles(frame)
                     : pieces                         ? packet_tiles(frame, integrator, *pieces)
                     : is_classified(scene, settings) ? classified_tiles(frame, integrator)
                     : settings.mode != Mode::volume  ? mode_tiles(frame)
                                                      : volume_tiles(frame, integrator);
  result.cancelled = make_tiles(frame, *maker, progress, result.statistics);
  result.statistics.values = frame.shade_raw();
  result.statistics.rays = frame.pixel_count();
  result.image = std::move(frame.image());
  return result;
}

}  // namespace plume
