#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <string>
#include <variant>
#include <vector>

#include "plume/lib/classified_pixels.h"
#include "plume/lib/follow_ray.h"
#include "plume/lib/render_plan.h"
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
        connected_(kGap * frame.scene().bounds().diagonal()),
        searches_([&] { return Search(walkable.mesh, hierarchy); }) {}

  void make(const Tile& tile, Counts& counts) override {
    Search& search = searches_.local();
    search.size = 0;
    frame_.for_each_pixel(tile, [&](const PixelPlace& place) {
      if (search.size == search.rays.size()) search.rays.emplace_back();
      TileRay& added = search.rays[search.size++];
      added.place = place;
      added.ray = frame_.ray(place);
      added.valid = added.frame.set(added.ray, walkable_.mesh.frame);
    });
    std::size_t first = 0;
    for (std::size_t i = 0; i < search.size; ++i) {
      TileRay& ray = search.rays[i];
      if (ray.valid && search.bundle.takes(ray.frame)) {
        search.bundle.add(ray.ray, ray.frame);
      } else {
        finish(search, first, counts);
        first = i;
        if (ray.valid) {
          search.bundle.add(ray.ray, ray.frame);
        } else {
          walk(ray, counts);
          first = i + 1;
        }
      }
    }
    finish(search, first, counts);
  }

 private:
  struct TileRay {
    PixelPlace place;
    Ray ray;
    ShearedFrame frame;
    bool valid = false;
  };
  // What each thread has of its own.
  struct Search {
    Search(const WalkableTets& mesh, const CellHierarchy& hierarchy) : leaves(mesh, hierarchy) {}
    LeafCache leaves;
    RayBundle bundle;
    std::array<SearchedRay, RayBundle::kRays> found;
    std::vector<TileRay> rays;  // the first `size`: what there is is used again as it is
    std::size_t size = 0;
  };

  // Makes the pixels of the rays in the bundle, which begin with that one.
  void finish(Search& search, std::size_t first, Counts& counts) {
    const std::size_t size = search.bundle.size();
    find_isosurfaces(search.leaves, isovalues_, connected_, search.bundle, search.found);
    for (std::size_t i = 0; i < size; ++i) {
      const TileRay& ray = search.rays[first + i];
      const SearchedRay& found = search.found[i];
      if (found.declined()) {
        walk(ray, counts);
        continue;
      }
      ++counts.searched;
      counts.add(pixels_.make(ray.place, ray.ray, counts, [&](auto& pixel) {
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
      }));
    }
    search.bundle.clear();
  }

  void walk(const TileRay& ray, Counts& counts) {
    counts.add(pixels_.make(ray.place, ray.ray, counts, [&](auto& pixel) {
      return trace_clipped(frame_, walkable_, ray.ray, pixel);
    }));
  }

  Frame& frame_;
  const Tets& walkable_;
  ClassifiedPixels<Tets, Integrator> pixels_;
  const std::vector<SoughtIsovalue> isovalues_;
  const double connected_;
  tbb::enumerable_thread_specific<Search> searches_;
};

}  // namespace

std::optional<std::string> no_search(const Scene& scene, const RenderSettings& settings) {
  const Classification& classification = scene.classification();
  if (!is_classified(scene, settings) || classification.isosurfaces.empty())
    return "there is no isosurface to look for";
  if (classification.volume || !classification.intervals.empty())
    return "all cells that are not empty are to be seen, not isosurfaces alone";
  if (!std::holds_alternative<std::unique_ptr<Tets>>(scene.body().walkable))
    return "it is for tetrahedra";
  if (scene.field().association == Association::cell) return "the scalar is constant in each cell";
  if (!settings.clip_planes.empty()) return "clip planes cut rays";
  if (settings.scalar_twin) return "the scalar twin is asked for";
  const auto& channels = settings.channels;
  for (const char* name : {"optical_depth", "cell_count"})
    if (std::count(channels.begin(), channels.end(), name) > 0) return "a channel needs whole rays";
  return std::nullopt;
}

std::unique_ptr<TileMaker> searched_tiles(Frame& frame, const Integrator& integrator) {
  const Tets& walkable = *std::get<std::unique_ptr<Tets>>(frame.scene().body().walkable);
  const CellHierarchy& hierarchy = frame.scene().body().hierarchy.of(walkable.mesh);
  return std::visit(
      [&](const auto& chosen) -> std::unique_ptr<TileMaker> {
        return std::make_unique<SearchedTiles<std::decay_t<decltype(chosen)>>>(frame, walkable,
                                                                               hierarchy, chosen);
      },
      integrator);
}

}  // namespace plume
