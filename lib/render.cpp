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
  }
  return report.cancelled();
}

// On the threads of the arena that it is called in.
RenderResult render_here(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                         const Progress& progress) {
  RenderResult result;
  std::vector<std::string> reasons;
  const tbb::tick_count start = tbb::tick_count::now();
  RenderSettings effective =
      settings.tolerance ? plan_for(scene, camera, settings, reasons) : settings;
  result.statistics.seconds_planning = (tbb::tick_count::now() - start).seconds();
  result.statistics.order = effective.order;
  Frame frame(scene, camera, effective);
  frame.set_opaque(find_opaque_pixels(frame));
  std::vector<std::string>& plan = result.statistics.plan;
  // Where segments are linear, or cut into linear parts, the closed form is all there is to it.
  const bool unbent = is_linear(scene, effective) || is_classified(scene, effective);
  if (unbent && effective.integrator.kind == IntegratorKind::second_order_table)
    effective.integrator.kind = IntegratorKind::closed_form;
  plan = describe_plan(scene, effective);
  plan.insert(plan.begin(), reasons.begin(), reasons.end());
  const auto why_walked = no_search(scene, effective);
  const std::optional<PacketPieces> pieces = pieces_for_packets(frame);
  if (!why_walked)
    plan.push_back(fmt::format(
        "rays: through a hierarchy of cells ({}), as only {}",
        scene.body().hierarchy.made() ? "made before" : "made for this picture",
        is_classified(scene, settings) ? "isosurfaces are to be seen"
                                       : "cells with a greater or lesser scalar need a look"));
  else if (has_packets(scene))
    plan.push_back(
        pieces ? fmt::format("rays: in packets, {}", packet_instruction_set())
               : "rays: one by one (packets serve the volume mode by the closed form, "
                 "at order 1, without tables or the linear form of intervals, clip planes and "
                 "further channels)");
  if (why_walked && is_classified(scene, settings) && !scene.classification().isosurfaces.empty())
    plan.push_back(fmt::format("rays: walked, not through a hierarchy of cells: {}", *why_walked));
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
  const auto kept = scene.body().integrators.get(scene.transfer_function(), effective.integrator);
  const Integrator& integrator = *kept;
  if (const auto table = describe_table(integrator)) plan.push_back(*table);
  const bool had_hierarchy = scene.body().hierarchy.made();
  const bool by_table =
      is_classified(scene, settings) && settings.interval_way == IntervalWay::table;
  const auto maker = by_table                         ? table_tiles(frame)
                     : !why_walked                    ? searched_tiles(frame, integrator)
                     : pieces                         ? packet_tiles(frame, integrator, *pieces)
                     : is_classified(scene, settings) ? classified_tiles(frame, integrator)
                     : settings.mode != Mode::volume  ? mode_tiles(frame)
                                                      : volume_tiles(frame, integrator);
  result.statistics.hierarchy_made = !had_hierarchy && scene.body().hierarchy.made();
  result.cancelled = make_tiles(frame, *maker, progress, result.statistics);
  frame.put_surfaces();
  frame.shade_raw(result.statistics);
  result.statistics.rays = frame.pixel_count();
  result.image = std::move(frame.image());
  return result;
}

}  // namespace

RenderResult render(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                    const Progress& progress) {
  check_settings(scene, settings);
  const int available = tbb::this_task_arena::max_concurrency();
  tbb::task_arena arena(settings.threads > 0 ? std::min(settings.threads, available) : available);
  return arena.execute([&] { return render_here(scene, camera, settings, progress); });
}

}  // namespace plume
