#include "plume/lib/render.h"

#include <fmt/format.h>
#include <tbb/tick_count.h>

#include "plume/lib/frame.h"
#include "plume/lib/make_tiles.h"
#include "plume/lib/planner.h"
#include "plume/lib/render_check.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/scene_body.h"
#include "plume/lib/search_choice.h"
#include "plume/lib/tiles.h"
#include "plume/traverse/packets.h"

namespace plume {
namespace {

bool has_hierarchy(const Scene& scene) {
  return scene.body().hierarchy.made() || scene.body().clusters.made() ||
         scene.body().ranges.made();
}

// On the threads of the arena that it is called in.
RenderResult render_here(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                         const Progress& progress) {
  RenderResult result;
  std::vector<std::string> reasons;
  RenderSettings effective = settings;
  if (settings.tolerance) {
    const tbb::tick_count start = tbb::tick_count::now();
    Plan planned = scene.body().plans.get(scene, camera, settings);
    result.statistics.seconds_planning = (tbb::tick_count::now() - start).seconds();
    result.statistics.error_estimate = planned.error;
    result.statistics.keeps_tolerance = planned.keeps;
    effective = std::move(planned.settings);
    reasons = std::move(planned.reasons);
  }
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
  const bool had_hierarchy = has_hierarchy(scene);
  std::optional<PacketPieces> pieces = pieces_for_packets(frame);
  // Numbers in single precision, where that is no more than a share of what was asked for.
  const bool single_will_do = !settings.tolerance || mode_packet_error(scene, effective) <=
                                                         settings.tolerance->max_error / 4;
  bool by_packets = pieces || (single_will_do && has_mode_packets(frame));
  const SearchChoice choice = choose_search(scene, effective, by_packets);
  frame.set_empty_space(find_empty_space(scene, effective, by_packets, plan));
  by_packets = by_packets && !frame.empty_space();
  if (choice.search)
    plan.push_back(fmt::format("rays: through a hierarchy of cells ({}), as {}",
                               had_hierarchy ? "made before" : "made for this picture",
                               choice.why));
  else if (has_packets(scene) && !frame.empty_space())
    plan.push_back(
        by_packets ? fmt::format("rays: in packets, {}", packet_instruction_set())
                   : "rays: one by one (packets serve volumes by the closed form, of order 1 or in "
                     "grids and mixed cells, without tables or the linear form of intervals, clip "
                     "planes and further channels)");
  if (!choice.search && !choice.why.empty())
    plan.push_back(fmt::format("rays: walked, not through a hierarchy of cells: {}", choice.why));
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
  const bool by_table =
      is_classified(scene, settings) && settings.interval_way == IntervalWay::table;
  const auto maker = by_table                         ? table_tiles(frame)
                     : choice.search                  ? searched_tiles(frame, integrator)
                     : by_packets && pieces           ? packet_tiles(frame, integrator, *pieces)
                     : by_packets                     ? mode_packet_tiles(frame)
                     : is_classified(scene, settings) ? classified_tiles(frame, integrator)
                     : settings.mode != Mode::volume  ? mode_tiles(frame)
                                                      : volume_tiles(frame, integrator);
  result.statistics.hierarchy_made = !had_hierarchy && has_hierarchy(scene);
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
  return on_threads(settings.threads,
                    [&] { return render_here(scene, camera, settings, progress); });
}

}  // namespace plume
