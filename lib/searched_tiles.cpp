#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "plume/lib/classified_pixels.h"
#include "plume/lib/follow_ray.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/tile_bundles.h"
#include "plume/lib/tiles.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/traverse/cell_search.h"

namespace plume {
namespace {

using Tets = Walkable<TetWalker>;

// In the order in which they are looked for.
std::vector<SoughtIsovalue> sought_isovalues(const Classification& classification) {
  std::vector<SoughtIsovalue> sought;
  for (const Isosurface& surface : classification.isosurfaces)
    sought.push_back({surface.value, surface.opacity >= 1});
  std::sort(sought.begin(), sought.end(),
            [](const SoughtIsovalue& a, const SoughtIsovalue& b) { return a.value < b.value; });
  return sought;
}

template <class Integrator>
class SearchedTiles : public TileMaker {
 public:
  SearchedTiles(Frame& frame, const Tets& walkable, const CellHierarchy& hierarchy,
                const Integrator& integrator)
      : frame_(frame),
        walkable_(walkable),
        pixels_(frame, walkable, integrator),
        isovalues_(sought_isovalues(frame.scene().classification())),
        connected_(frame.gap()),
        bundles_([&] { return TileBundles(walkable.mesh, hierarchy); }) {}

  void make(const Tile& tile, Counts& counts) override {
    TileBundles& bundles = bundles_.local();
    auto walk = [&](const TileBundles::TileRay& ray) {
      counts.add(pixels_.make(ray.place, ray.ray, counts, [&](auto& pixel) {
        return trace_clipped(frame_, walkable_, ray.ray, pixel);
      }));
    };
    bundles.for_each(
        frame_, tile,
        [&] {
          find_isosurfaces(bundles.leaves, isovalues_, connected_, bundles.bundle, bundles.found);
        },
        [&](const TileBundles::TileRay& ray, std::size_t i) {
          const SearchedRay& found = bundles.found[i];
          if (found.declined()) return walk(ray);
          ++counts.searched;
          counts.add(pixels_.make(ray.place, ray.ray, counts,
                                  [&](auto& pixel) { return give(found, pixel); }));
        },
        walk);
  }

 private:
  template <class Pixel>
  static TraceResult give(const SearchedRay& found, Pixel& pixel) {
    TraceResult result;
    result.entries = static_cast<std::uint32_t>(found.entries());
    result.cells = found.cells();
    for (const Segment& segment : found.segments()) {
      pixel.pass_over();
      if (pixel(segment)) continue;
      result.end = WalkEnd::stopped;
      break;
    }
    return result;
  }

  Frame& frame_;
  const Tets& walkable_;
  ClassifiedPixels<Tets, Integrator> pixels_;
  const std::vector<SoughtIsovalue> isovalues_;
  const double connected_;
  tbb::enumerable_thread_specific<TileBundles> bundles_;
};

// The modes maximum and minimum.
template <class Pixel>
class ExtremeTiles : public TileMaker {
 public:
  ExtremeTiles(Frame& frame, const Tets& walkable, const CellHierarchy& hierarchy)
      : frame_(frame),
        walkable_(walkable),
        bundles_([&] { return TileBundles(walkable.mesh, hierarchy); }) {}

  void make(const Tile& tile, Counts& counts) override {
    TileBundles& bundles = bundles_.local();
    auto walk = [&](const TileBundles::TileRay& ray) {
      Pixel pixel;
      counts.add(follow_ray(frame_, walkable_, ray.place, pixel));
      frame_.put_raw(ray.place, pixel.value(), pixel.seen());
    };
    const auto find = frame_.settings().mode == Mode::maximum ? find_greatest : find_least;
    bundles.for_each(
        frame_, tile, [&] { find(bundles.leaves, bundles.bundle, bundles.found, bundles.values); },
        [&](const TileBundles::TileRay& ray, std::size_t i) {
          const SearchedRay& found = bundles.found[i];
          if (found.declined()) return walk(ray);
          ++counts.searched;
          TraceResult result;
          result.entries = static_cast<std::uint32_t>(found.entries());
          result.cells = found.cells();
          counts.add(result);
          // As if the best segment were the only one.
          Pixel pixel;
          const float value = bundles.values[i];
          if (std::isfinite(value)) pixel(Segment{0, 0, value, value, kNone});
          frame_.put_raw(ray.place, pixel.value(), pixel.seen());
        },
        walk);
  }

 private:
  Frame& frame_;
  const Tets& walkable_;
  tbb::enumerable_thread_specific<TileBundles> bundles_;
};

}  // namespace

std::optional<std::string> no_search(const Scene& scene, const RenderSettings& settings) {
  const Classification& classification = scene.classification();
  const bool extreme = settings.mode == Mode::maximum || settings.mode == Mode::minimum;
  if (!extreme && (!is_classified(scene, settings) || classification.isosurfaces.empty()))
    return "there is no isosurface to look for";
  if (!extreme && (classification.volume || !classification.intervals.empty()))
    return "all cells that are not empty are to be seen, not isosurfaces alone";
  if (!std::holds_alternative<std::unique_ptr<Tets>>(scene.body().walkable))
    return "it is for tetrahedra";
  if (std::get<std::unique_ptr<Tets>>(scene.body().walkable)->mesh.is_compact())
    return "compact tetrahedra are known only to who walks to them";
  if (scene.field().association == Association::cell) return "the scalar is constant in each cell";
  if (!settings.clip_planes.empty()) return "clip planes cut rays";
  if (scene.surface_triangle_count() > 0 || !settings.depth_limit.empty())
    return "rays end at what is opaque";
  if (settings.interval_way == IntervalWay::table) return "the interval tables are asked for";
  if (settings.scalar_twin) return "the scalar twin is asked for";
  const auto& channels = settings.channels;
  for (const char* name : {"optical_depth", "cell_count"})
    if (std::count(channels.begin(), channels.end(), name) > 0) return "a channel needs whole rays";
  return std::nullopt;
}

std::unique_ptr<TileMaker> searched_tiles(Frame& frame, const Integrator& integrator) {
  const Tets& walkable = *std::get<std::unique_ptr<Tets>>(frame.scene().body().walkable);
  const CellHierarchy& hierarchy =
      frame.scene().body().hierarchy.get([&] { return make_cell_hierarchy(walkable.mesh); });
  if (frame.settings().mode == Mode::maximum)
    return std::make_unique<ExtremeTiles<MaximumPixel>>(frame, walkable, hierarchy);
  if (frame.settings().mode == Mode::minimum)
    return std::make_unique<ExtremeTiles<MinimumPixel>>(frame, walkable, hierarchy);
  return std::visit(
      [&](const auto& chosen) -> std::unique_ptr<TileMaker> {
        return std::make_unique<SearchedTiles<std::decay_t<decltype(chosen)>>>(frame, walkable,
                                                                               hierarchy, chosen);
      },
      integrator);
}

}  // namespace plume
