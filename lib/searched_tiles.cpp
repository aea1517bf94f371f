#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <bit>
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

// Of a grid of 512,000 cells an isosurface takes packets 1.0 to 1.4 times as long as the search, of
// 165,000 cells of all kinds 0.6 to 1.1 times; of fewer, they are
// faster. Of tetrahedra the search is, whatever their number: plume_frame_bench --hierarchy.
constexpr std::size_t kFewestBesidePackets = 300000;

// What is searched of a scene's form, and what of it a thread keeps.
template <class Walkable>
struct Searched {
  using Hierarchy = CellClusters;
  using Cache = ClusterCache<typename Walkable::Walker>;
  static const Hierarchy& of(const Scene& scene, const Walkable& walkable) {
    return scene.body().clusters.get([&] { return make_cell_clusters(walkable.mesh); });
  }
};
template <>
struct Searched<Walkable<TetWalker>> {
  using Hierarchy = CellHierarchy;
  using Cache = LeafCache;
  static const Hierarchy& of(const Scene& scene, const Walkable<TetWalker>& walkable) {
    return scene.body().hierarchy.get([&] { return make_cell_hierarchy(walkable.mesh); });
  }
};

// In the order in which they are looked for.
std::vector<SoughtIsovalue> sought_isovalues(const Classification& classification) {
  std::vector<SoughtIsovalue> sought;
  for (const Isosurface& surface : classification.isosurfaces)
    sought.push_back({surface.value, surface.opacity >= 1});
  std::sort(sought.begin(), sought.end(),
            [](const SoughtIsovalue& a, const SoughtIsovalue& b) { return a.value < b.value; });
  return sought;
}

TraceResult met(const SearchedRay& found) {
  TraceResult result;
  result.entries = static_cast<std::uint32_t>(found.entries());
  result.cells = found.cells();
  return result;
}

template <class Walkable, class Integrator>
class SearchedTiles : public TileMaker {
  using Bundles = TileBundles<typename Searched<Walkable>::Cache>;

 public:
  SearchedTiles(Frame& frame, const Walkable& walkable, const Integrator& integrator)
      : frame_(frame),
        walkable_(walkable),
        pixels_(frame, walkable, integrator),
        isovalues_(sought_isovalues(frame.scene().classification())),
        connected_(frame.gap()),
        background_(frame.settings().mode == Mode::volume && frame.settings().channels.empty()),
        bundles_([&] {
          return Bundles(walkable.mesh, Searched<Walkable>::of(frame.scene(), walkable));
        }) {
    Searched<Walkable>::of(frame.scene(), walkable);
  }

  void make(const Tile& tile, Counts& counts) override {
    Bundles& bundles = bundles_.local();
    auto walk = [&](const typename Bundles::TileRay& ray) {
      counts.add(pixels_.make(ray.place, ray.ray, counts, [&](auto& pixel) {
        return trace_clipped(frame_, walkable_, ray.ray, pixel);
      }));
    };
    bundles.for_each(
        frame_, tile,
        [&] {
          find_isosurfaces(bundles.leaves, isovalues_, connected_, bundles.bundle, bundles.found);
        },
        [&](const typename Bundles::TileRay& ray, std::size_t i) {
          const SearchedRay& found = bundles.found[i];
          if (found.declined()) return walk(ray);
          ++counts.searched;
          if (found.segments().empty() && background_) return counts.add(met(found));
          counts.add(pixels_.make(ray.place, ray.ray, counts,
                                  [&](auto& pixel) { return give(found, pixel); }));
        },
        walk);
  }

 private:
  template <class Pixel>
  static TraceResult give(const SearchedRay& found, Pixel& pixel) {
    TraceResult result = met(found);
    for (const Segment& segment : found.segments()) {
      pixel.pass_over();
      if (pixel(segment)) continue;
      result.end = WalkEnd::stopped;
      break;
    }
    return result;
  }

  Frame& frame_;
  const Walkable& walkable_;
  ClassifiedPixels<Walkable, Integrator> pixels_;
  const std::vector<SoughtIsovalue> isovalues_;
  const double connected_;
  const bool background_;  // a pixel is the image's background until something is put there
  tbb::enumerable_thread_specific<Bundles> bundles_;
};

// The modes maximum and minimum.
template <class Walkable, class Pixel>
class ExtremeTiles : public TileMaker {
  using Bundles = TileBundles<typename Searched<Walkable>::Cache>;

 public:
  ExtremeTiles(Frame& frame, const Walkable& walkable)
      : frame_(frame), walkable_(walkable), bundles_([&] {
          return Bundles(walkable.mesh, Searched<Walkable>::of(frame.scene(), walkable));
        }) {
    Searched<Walkable>::of(frame.scene(), walkable);
  }

  void make(const Tile& tile, Counts& counts) override {
    Bundles& bundles = bundles_.local();
    auto walk = [&](const typename Bundles::TileRay& ray) {
      Pixel pixel;
      counts.add(follow_ray(frame_, walkable_, ray.place, pixel));
      frame_.put_raw(ray.place, pixel.value(), pixel.seen());
    };
    const bool greatest = frame_.settings().mode == Mode::maximum;
    bundles.for_each(
        frame_, tile,
        [&] {
          if (greatest)
            find_greatest(bundles.leaves, bundles.bundle, bundles.found, bundles.values);
          else
            find_least(bundles.leaves, bundles.bundle, bundles.found, bundles.values);
        },
        [&](const typename Bundles::TileRay& ray, std::size_t i) {
          const SearchedRay& found = bundles.found[i];
          if (found.declined()) return walk(ray);
          ++counts.searched;
          counts.add(met(found));
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
  const Walkable& walkable_;
  tbb::enumerable_thread_specific<Bundles> bundles_;
};

// Of a grid or of cells of any kind. All crooked cells on a ray are looked at before its greatest
// or least scalar is sought: the 3% of an O-grid, around its axis, made that 1.6 times as slow as a
// walk; 0.3% of a box did not hurt.
bool has_many_crooked_cells(const Scene& scene) {
  return std::visit(
      [&](const auto& walkable) {
        using Form = std::decay_t<decltype(*walkable)>;
        std::size_t crooked = 0;
        if constexpr (std::is_same_v<typename Form::Walker, GridWalker> ||
                      std::is_same_v<typename Form::Walker, CellWalker>)
          for (const std::uint16_t bits : Searched<Form>::of(scene, *walkable).crooked)
            crooked += static_cast<std::size_t>(std::popcount(bits));
        return crooked > scene.cell_count() / 100;
      },
      scene.body().walkable);
}

}  // namespace

std::optional<std::string> no_search(const Scene& scene, const RenderSettings& settings,
                                     bool by_packets) {
  const Classification& classification = scene.classification();
  const bool extreme = settings.mode == Mode::maximum || settings.mode == Mode::minimum;
  if (!extreme && (!is_classified(scene, settings) || classification.isosurfaces.empty()))
    return "there is no isosurface to look for";
  if (!extreme && (classification.volume || !classification.intervals.empty()))
    return "all cells that are not empty are to be seen, not isosurfaces alone";
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
  if (settings.scalar_twin) return "the scalar twin is asked for";
  const auto& channels = settings.channels;
  if (extreme && !channels.empty()) return "channels are of what rays meet on their way";
  for (const char* name : {"optical_depth", "cell_count"})
    if (std::count(channels.begin(), channels.end(), name) > 0) return "a channel needs whole rays";
  if (by_packets && !tets && scene.cell_count() < kFewestBesidePackets)
    return "packets are faster through so few cells";
  if (extreme && !tets && has_many_crooked_cells(scene))
    return "many cells are collapsed or inverted, and every ray would have to look at them";
  return std::nullopt;
}

namespace {

template <class Walkable>
std::unique_ptr<TileMaker> tiles_of(Frame& frame, const Walkable& walkable,
                                    const Integrator& integrator) {
  if (frame.settings().mode == Mode::maximum)
    return std::make_unique<ExtremeTiles<Walkable, MaximumPixel>>(frame, walkable);
  if (frame.settings().mode == Mode::minimum)
    return std::make_unique<ExtremeTiles<Walkable, MinimumPixel>>(frame, walkable);
  return std::visit(
      [&](const auto& chosen) -> std::unique_ptr<TileMaker> {
        using Chosen = std::decay_t<decltype(chosen)>;
        return std::make_unique<SearchedTiles<Walkable, Chosen>>(frame, walkable, chosen);
      },
      integrator);
}

}  // namespace

std::unique_ptr<TileMaker> searched_tiles(Frame& frame, const Integrator& integrator) {
  return std::visit(
      [&](const auto& walkable) -> std::unique_ptr<TileMaker> {
        using Form = std::decay_t<decltype(*walkable)>;
        if constexpr (std::is_same_v<Form, Walkable<RectilinearWalker>>)
          return nullptr;  // no_search()
        else
          return tiles_of(frame, *walkable, integrator);
      },
      frame.scene().body().walkable);
}

}  // namespace plume
