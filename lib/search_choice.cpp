#include "plume/lib/search_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <variant>

#include "plume/lib/render_plan.h"
#include "plume/lib/scene_body.h"
#include "plume/preint/visible_scalars.h"

namespace plume {
namespace {

// Of a grid of 512,000 cells an isosurface takes packets 1.0 to 1.4 times as long as the search, of
// 165,000 cells of all kinds 0.6 to 1.1 times; of fewer, they are faster. Of tetrahedra the search is, whatever their number: plume_frame_bench --hierarchy.
constexpr std::size_t kFewestBesidePackets = 300000;
// Of 10 million tetrahedra of which 2.3% may be seen packets take 1.0 to 2.0 times as long as the
// search, of which 3.8%, 0.6 to 1.0 times; a walk is as fast where a quarter of the cells may be
// seen: likewise.
constexpr double kMostBesidePackets = 0.025, kMostBesideWalk = 0.25;
// Cells that are looked at for that.
constexpr std::size_t kSample = 4096;

bool is_extreme(const RenderSettings& settings) {
  return settings.mode == Mode::maximum || settings.mode == Mode::minimum;
}

bool shows_isosurfaces_alone(const Classification& classification) {
  return !classification.volume && classification.intervals.empty();
}

template <class Visit>
void for_each_scalar(const WalkableTets& mesh, std::uint32_t cell, const Visit& visit) {
  for (const std::uint32_t point : mesh.points_of(cell)) visit(mesh.points[point].scalar);
}
template <class Mesh, class Visit>
void for_each_scalar(const Mesh& mesh, std::uint32_t cell, const Visit& visit) {
  for_each_point_of(mesh, cell, [&](std::uint32_t point) { visit(mesh.points[point].scalar); });
}

// Of a grid or of cells of any kind. All crooked cells on a ray are looked at before its greatest
// or least scalar is sought: the 3% of an O-grid, around its axis, made that 1.6 times as slow as a
// walk; 0.3% of a box did not hurt.
bool has_many_crooked_cells(const Scene& scene) {
  const auto many = [&](const auto& mesh) {
    std::size_t crooked = 0;
    const CellClusters& clusters =
        scene.body().clusters.get([&] { return make_cell_clusters(mesh); });
    for (const std::uint16_t bits : clusters.crooked)
      crooked += static_cast<std::size_t>(std::popcount(bits));
    return crooked > scene.cell_count() / 100;
  };
  const auto& form = scene.body().walkable;
  if (const auto* grid = std::get_if<std::unique_ptr<Walkable<GridWalker>>>(&form))
    return many((*grid)->mesh);
  if (const auto* cells = std::get_if<std::unique_ptr<Walkable<CellWalker>>>(&form))
    return many((*cells)->mesh);
  return false;
}

}  // namespace

std::vector<ScalarWindow> visible_windows(const Classification& classification) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Classification without_surfaces = classification;
  without_surfaces.isosurfaces.clear();
  std::vector<ScalarWindow> windows;
  const VisibleScalars visible(without_surfaces);
  for (const VisibleScalars::Range& range : visible.ranges())
    windows.push_back({range.low, std::nextafter(range.high, kInfinity)});
  for (const Isosurface& surface : classification.isosurfaces)
    if (!visible.meet(surface.value, surface.value))
      windows.push_back({surface.value, surface.value});
  std::sort(windows.begin(), windows.end(),
            [](const ScalarWindow& a, const ScalarWindow& b) { return a.from < b.from; });
  return windows;
}

double visible_share(const Scene& scene, const std::vector<ScalarWindow>& windows) {
  return std::visit(
      [&](const auto& walkable) {
        using Form = std::decay_t<decltype(*walkable)>;
        if constexpr (std::is_same_v<typename Form::Walker, RectilinearWalker>) {
          return 1.0;
        } else {
          const std::size_t count = walkable->mesh.cell_count();
          const std::size_t sample = std::min(count, kSample);
          std::size_t visible = 0;
          for (std::size_t i = 0; i < sample; ++i) {
            float least = std::numeric_limits<float>::infinity(), greatest = -least;
            for_each_scalar(walkable->mesh, static_cast<std::uint32_t>(i * count / sample),
                            [&](float scalar) {
                              least = std::fmin(least, scalar);
                              greatest = std::fmax(greatest, scalar);
                            });
            visible += std::any_of(windows.begin(), windows.end(), [&](const ScalarWindow& w) {
              return least < w.below && greatest >= w.from;
            });
          }
          return static_cast<double>(visible) / static_cast<double>(sample);
        }
      },
      scene.body().walkable);
}

std::optional<std::string> cannot_search(const Scene& scene, const RenderSettings& settings) {
  if (settings.mode != Mode::volume && settings.mode != Mode::depth && !is_extreme(settings))
    return "all cells on a ray count";
  const auto& form = scene.body().walkable;
  if (std::holds_alternative<std::unique_ptr<Walkable<RectilinearWalker>>>(form))
    return "it is for cells between points, not between planes";
  const auto* tets = std::get_if<std::unique_ptr<Walkable<TetWalker>>>(&form);
  if (tets && (*tets)->mesh.is_compact())
    return "compact tetrahedra are known only to who walks to them";
  if (scene.field().association == Association::cell) return "the scalar is constant in each cell";
  if (!is_linear(scene, settings)) return "the scalar is not linear along segments";
  if (!settings.clip_planes.empty()) return "clip planes cut rays";
  if (scene.surface_triangle_count() > 0 || !settings.depth_limit.empty())
    return "rays end at what is opaque";
  if (settings.interval_way == IntervalWay::table) return "the interval tables are asked for";
  if (is_blurred(scene, settings))
    return "a table blurs where the transfer function is empty";
  if (settings.scalar_twin) return "the scalar twin is asked for";
  const auto& channels = settings.channels;
  if (is_extreme(settings) && !channels.empty())
    return "channels are of what rays meet on their way";
  for (const char* name : {"optical_depth", "cell_count"})
    if (std::count(channels.begin(), channels.end(), name) > 0) return "a channel needs whole rays";
  return std::nullopt;
}

SearchChoice choose_search(const Scene& scene, const RenderSettings& settings, bool by_packets) {
  const bool extreme = is_extreme(settings);
  const Classification& shown = scene.classification();
  const auto windows = visible_windows(shown);
  const bool all = windows.size() == 1 && windows[0].from <= scene.field().low &&
                   windows[0].below > scene.field().high;
  // Where all is to be seen, nobody expects a search but who asks for isosurfaces.
  const bool asked = !extreme && (!all || !shown.isosurfaces.empty());
  auto walk = [&](const std::string& why) { return SearchChoice{false, asked ? why : ""}; };
  if (const auto why = cannot_search(scene, settings)) return walk(*why);
  const bool tets =
      std::holds_alternative<std::unique_ptr<Walkable<TetWalker>>>(scene.body().walkable);
  if (by_packets && !tets && scene.cell_count() < kFewestBesidePackets)
    return walk("packets are faster through so few cells");
  if (extreme) {
    if (has_many_crooked_cells(scene))
      return walk("many cells are collapsed or inverted, and every ray would look at them");
    return {true, "only cells with a greater or lesser scalar need a look"};
  }
  if (shows_isosurfaces_alone(shown)) return {true, "only isosurfaces are to be seen"};
  if (all) return walk("all cells may be seen");
  const double share = visible_share(scene, windows);
  const std::string seen = fmt::format("{:.2g}% of the cells may be seen", 100 * share);
  if (share > (by_packets ? kMostBesidePackets : kMostBesideWalk))
    return walk(seen + ", too much for it to pay");
  return {true, "only " + seen};
}

}  // namespace plume
