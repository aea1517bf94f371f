#include <fmt/format.h>

#include "plume/lib/frame.h"
#include "plume/lib/make_tiles.h"
#include "plume/lib/render.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/several_check.h"
#include "plume/lib/several_tiles.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

const char* in_words(Overlap overlap) {
  switch (overlap) {
    case Overlap::add:
      break;
    case Overlap::first:
      return "the first of two is seen alone";
    case Overlap::refuse:
      return "there is no picture";
  }
  return "extinction and emission add up";
}

std::vector<std::string> plan_of(const std::vector<const Scene*>& scenes,
                                 const RenderSettings& settings) {
  std::vector<std::string> plan;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (const std::string& line : describe_plan(*scenes[i], settings))
      plan.push_back(fmt::format("{}: {}", name_of(scenes, i), line));
  plan.push_back(
      fmt::format("rays: one by one through {} meshes, whose parts are composited in the order "
                  "along the ray; where meshes overlap, {}",
                  scenes.size(), in_words(settings.overlap)));
  return plan;
}

// On the threads of the arena that it is called in.
RenderResult render_here(const std::vector<const Scene*>& scenes, const Camera& camera,
                         const RenderSettings& settings, const Progress& progress) {
  RenderSettings effective = settings;
  Frame frame(scenes, camera, effective);
  if (frame.channels().whole_rays()) effective.early_termination = 0;
  frame.set_opaque(find_opaque_pixels(frame));
  RenderResult result;
  RenderStatistics& statistics = result.statistics;
  statistics.order = effective.order;
  statistics.plan = plan_of(scenes, effective);
  SeveralTiles maker(frame);
  result.cancelled = make_tiles(frame, maker, progress, statistics);
  if (const auto& overlap = maker.overlap())
    throw Error(fmt::format(
        "{} and {} overlap: along the ray of pixel ({}, {}) both are between {:g} and {:g}; let "
        "their extinction add up (--overlap add), or the first be seen alone (--overlap first)",
        name_of(scenes, overlap->first), name_of(scenes, overlap->second), overlap->pixel.x,
        overlap->pixel.y, overlap->range.from, overlap->range.to));
  frame.put_surfaces();
  frame.shade_raw(statistics);
  statistics.rays = frame.pixel_count();
  if (statistics.rays_overlapping > 0)
    statistics.plan.push_back(
        fmt::format("overlap: of {} rays, {} meet places in more than one mesh", statistics.rays,
                    statistics.rays_overlapping));
  result.image = std::move(frame.image());
  return result;
}

}  // namespace

Bounds visible_bounds(const std::vector<const Scene*>& scenes) {
  Bounds bounds = scenes.front()->visible_bounds();
  for (const Scene* scene : scenes) bounds = united(bounds, scene->visible_bounds());
  return bounds;
}

RenderResult render(const std::vector<const Scene*>& scenes, const Camera& camera,
                    const RenderSettings& settings, const Progress& progress) {
  if (scenes.empty()) throw Error("a picture of no scene: give one at least");
  if (scenes.size() == 1) return render(*scenes.front(), camera, settings, progress);
  check_several(scenes, settings);
  return on_threads(settings.threads,
                    [&] { return render_here(scenes, camera, settings, progress); });
}

}  // namespace plume
