#include "plume/lib/render_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "plume/lib/render_plan.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

const std::vector<std::string> kChannels{"depth",      "optical_depth", "cell_id",
                                         "cell_count", "isovalue",      "normal"};

void check_channels(const Scene& scene, const RenderSettings& settings) {
  for (const std::string& channel : settings.channels)
    if (std::find(kChannels.begin(), kChannels.end(), channel) == kChannels.end())
      throw Error(
          fmt::format("no channel '{}'; there are: {}", channel, fmt::join(kChannels, " ")));
  for (const std::string& channel : settings.channels)
    if ((channel == "isovalue" || channel == "normal") && !is_classified(scene, settings))
      throw Error(fmt::format(
          "channel '{}': it is of isosurfaces and intervals, in the modes volume and depth; give "
          "the scene's classification one",
          channel));
  const bool normals = std::count(settings.channels.begin(), settings.channels.end(), "normal") > 0;
  if ((settings.lighting || normals) && !scene.has_gradients())
    throw Error(fmt::format("{} the scene keeps no gradients; set SceneOptions::keep_gradients",
                            settings.lighting ? "light:" : "channel 'normal':"));
}

// A way that is there to compare does no more than that needs.
void check_interval_way(const Scene& scene, const RenderSettings& settings) {
  if (settings.interval_way == IntervalWay::split || !is_classified(scene, settings)) return;
  const char* const what = settings.mode != Mode::volume ? "the mode depth"
                           : settings.lighting           ? "light"
                           : !settings.channels.empty()  ? "further channels"
                           : settings.interval_form == IntervalForm::linear
                               ? "the linear form of intervals"
                               : nullptr;
  if (what != nullptr)
    throw Error(
        fmt::format("intervals from tables have no {}; leave it out, or split them in data "
                    "space, as is done by default",
                    what));
  const IntervalTableSettings& table = settings.interval_table;
  if (table.scalar_count < 2 || table.length_count < 2 || table.scalar_count > 1024 ||
      table.length_count > 256)
    throw Error(
        fmt::format("a table of intervals of {0} x {0} scalars and {1} lengths: 2 to 1024 and "
                    "2 to 256",
                    table.scalar_count, table.length_count));
}

void check_window(const PixelWindow& window, const RenderSettings& settings) {
  const bool inside = window.x >= 0 && window.y >= 0 && window.width >= 1 && window.height >= 1 &&
                      window.width <= settings.width - window.x &&
                      window.height <= settings.height - window.y;
  if (!inside)
    throw Error(fmt::format(
        "a window of {}x{} pixels at ({}, {}): it must lie in the picture of {}x{}", window.width,
        window.height, window.x, window.y, settings.width, settings.height));
}

}  // namespace

void check_settings(const Scene& scene, const RenderSettings& settings) {
  auto in_range = [](int pixels) { return pixels >= 1 && pixels <= 65536; };
  if (!in_range(settings.width) || !in_range(settings.height))
    throw Error(fmt::format("a picture of {}x{} pixels: each side must be 1 to 65536",
                            settings.width, settings.height));
  if (!(settings.early_termination >= 0 && settings.early_termination < 1))
    throw Error(fmt::format("early termination at {}: it must be at least 0 and below 1",
                            settings.early_termination));
  for (const ClipPlane& plane : settings.clip_planes)
    if (const auto problem = problem_of(plane)) throw Error(*problem);
  if (const auto& gray = settings.gray_range)
    if (!((*gray)[0] < (*gray)[1]) || !std::isfinite((*gray)[1] - (*gray)[0]))
      throw Error(
          fmt::format("shades of gray from {:g} to {:g}: the first must be below the second",
                      (*gray)[0], (*gray)[1]));
  if (settings.threads < 0)
    throw Error(fmt::format("{} threads: it must be 1 or more, or 0 for all", settings.threads));
  if (const auto problem = settings.integrator.problem()) throw Error(*problem);
  if (settings.order < ScalarOrder::linear || settings.order > ScalarOrder::adaptive)
    throw Error(
        fmt::format("order {}: it must be 1 (linear), 2 (quadratic), 3 (cubic) or 4 (adaptive)",
                    static_cast<int>(settings.order)));
  if (!(settings.scalar_tolerance > 0 && settings.scalar_tolerance < 1))
    throw Error(fmt::format("a scalar tolerance of {}: it must be above 0 and below 1",
                            settings.scalar_tolerance));
  if (settings.tolerance &&
      !(settings.tolerance->max_error >= 0 && settings.tolerance->max_error < 1))
    throw Error(fmt::format("a tolerance of {}: it must be at least 0 (the reference) and below 1",
                            settings.tolerance->max_error));
  const auto pixels =
      static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
  if (!settings.depth_limit.empty() && settings.depth_limit.size() != pixels)
    throw Error(fmt::format("depth_limit has {} values for {} pixels: give one for each, or none",
                            settings.depth_limit.size(), pixels));
  if (settings.window) check_window(*settings.window, settings);
  check_channels(scene, settings);
  check_interval_way(scene, settings);
  if (settings.lighting)
    if (const auto problem = settings.lighting->problem())
      throw Error(fmt::format("light: {}", *problem));
}

}  // namespace plume
