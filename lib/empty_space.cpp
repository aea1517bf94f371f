#include "plume/lib/empty_space.h"

#include <fmt/format.h>

#include <algorithm>

#include "plume/lib/render_plan.h"
#include "plume/lib/scene_body.h"

namespace plume {
namespace {

using Grid = Walkable<RectilinearWalker>;

// Above this share of the cells packets are faster: plume_frame_bench --empty-space.
constexpr double kMostBesidePackets = 0.03;
// Above this one there is next to nothing to gain.
constexpr double kMost = 0.9;

// Not the optical depth: a ray that meets the mesh is seen there, even where it is 0.
bool shows_classification(Mode mode) { return mode == Mode::volume || mode == Mode::depth; }

bool has_surfaces(const Scene& scene) {
  return !scene.classification().intervals.empty() || !scene.classification().isosurfaces.empty();
}

bool may_pass_over(const Scene& scene, const RenderSettings& settings, const Grid& grid) {
  const bool extreme = settings.mode == Mode::maximum || settings.mode == Mode::minimum;
  if (!shows_classification(settings.mode) && !extreme) return false;
  if (is_blurred(scene, settings)) return false;
  const auto& channels = settings.channels;
  auto asked = [&](const char* name) { return std::count(channels.begin(), channels.end(), name); };
  if (asked("cell_count") || asked("optical_depth")) return false;
  // They are of the classification, whatever the mode shows.
  if (extreme && (asked("depth") || asked("cell_id"))) return false;
  // Between cells that are constant the scalar jumps, from one block to the next as well.
  if (scene.field().association == Association::cell && is_classified(scene, settings))
    return false;
  return !settings.scalar_twin && settings.interval_way == IntervalWay::split &&
         (is_linear(scene, settings) || settings.order != ScalarOrder::quadratic) &&
         grid.mesh.hidden.empty();
}

}  // namespace

std::optional<EmptySpace> find_empty_space(const Scene& scene, const RenderSettings& settings,
                                           bool by_packets, std::vector<std::string>& plan) {
  const auto* grid = std::get_if<std::unique_ptr<Grid>>(&scene.body().walkable);
  if (!grid || !may_pass_over(scene, settings, **grid)) return std::nullopt;
  EmptySpace space{};
  if (shows_classification(settings.mode)) {
    space.visible = is_classified(scene, settings) || !has_surfaces(scene)
                        ? VisibleScalars(scene.classification())
                        : VisibleScalars(scene.transfer_function());
    const auto ranges = space.visible->ranges();
    if (ranges.size() == 1 && ranges[0].low <= scene.field().low &&
        ranges[0].high >= scene.field().high)
      return std::nullopt;
  }
  const bool made = scene.body().ranges.made();
  const RangeTree& tree = scene.body().ranges.get([&] { return RangeTree((*grid)->mesh); });
  space.tree = &tree;
  const char* when = made ? "made before" : "made for this picture";
  if (!space.visible) {
    plan.push_back(fmt::format(
        "empty space: blocks of cells without a greater or lesser scalar are passed over, by a "
        "tree of ranges ({})",
        when));
    return space;
  }
  const double share = tree.share_of(
      [&](float least, float greatest) { return space.visible->meet(least, greatest); });
  const bool worth_it = share < (by_packets ? kMostBesidePackets : kMost);
  plan.push_back(fmt::format(
      "empty space: {:.3g}% of the cells may be seen by a tree of ranges "
      "({}): {}",
      100 * share, when,
      worth_it ? "the others are passed over" : "too much for passing over the others to pay"));
  if (!worth_it) return std::nullopt;
  return space;
}

}  // namespace plume
