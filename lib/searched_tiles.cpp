#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <variant>
#include <vector>

#include "plume/lib/classified_tiles.h"
#include "plume/lib/follow_ray.h"
#include "plume/lib/mode_pixels.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/search_choice.h"
#include "plume/lib/tile_bundles.h"
#include "plume/lib/tiles.h"
#include "plume/lib/volume_tiles.h"
#include "plume/mesh/cell_hierarchy.h"
#include "plume/traverse/cell_search.h"

namespace plume {
namespace {

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

TraceResult met(const SearchedRay& found) {
  TraceResult result;
  result.entries = static_cast<std::uint32_t>(found.entries());
  result.cells = found.cells();
  return result;
}

double greatest_extinction(const TransferFunction& transfer_function) {
  double greatest = 0;
  for (const auto& knot : transfer_function.knots)
    greatest = std::max<double>(greatest, knot.optics.extinction);
  return greatest;
}

// How much of what lies behind a segment that hides at the least, in a scene that shows a volume
// alone: as the pixel that it is given to says.
template <class Walkable, class Integrator>
std::function<double(const Segment&)> opacity_of(const Frame&,
                                                 const VolumeTiles<Walkable, Integrator>& tiles) {
  return [&tiles](const Segment& segment) {
    VolumePixel<Integrator> pixel = tiles.fresh();
    pixel(segment);
    return pixel.compositor.alpha();
  };
}

// The mode depth.
template <class Walkable>
std::function<double(const Segment&)> opacity_of(const Frame& frame,
                                                 const ModeTiles<Walkable, FirstPixel>&) {
  return [&optics = frame.optical_depth()](const Segment& segment) {
    return optics(segment.s_in, segment.s_out, segment_length(segment)) > 0 ? 1.0 : 0.0;
  };
}

// With isosurfaces and intervals. Of intervals it is not known without what lies before.
template <class Walkable, class Integrator>
std::function<double(const Segment&)> opacity_of(
    const Frame& frame, const ClassifiedTiles<Walkable, Integrator>& tiles) {
  const Classification& classification = frame.scene().classification();
  const bool ends_at_first = frame.settings().mode == Mode::depth;
  return [&, ends_at_first, ranges = ScalarRanges(classification)](const Segment& segment) {
    const float low = std::min(segment.s_in, segment.s_out);
    const float high = std::max(segment.s_in, segment.s_out);
    for (const Isosurface& surface : classification.isosurfaces)
      if (low < surface.value && surface.value <= high &&
          (surface.opacity >= 1 || (ends_at_first && surface.opacity > 0)))
        return 1.0;
    const std::size_t range = ranges.range_of(low);
    if (ends_at_first || !classification.volume || range != ranges.range_of(high) ||
        ranges.interval_of(range) != ScalarRanges::kNothing)
      return 0.0;
    return static_cast<double>(
        tiles.integrator().integrate(segment.s_in, segment.s_out, segment_length(segment)).alpha);
  };
}

// `Pixels` makes pixels of segments, and walks the rays that are declined.
template <class Walkable, class Pixels>
class SearchedTiles : public TileMaker {
  using Bundles = TileBundles<typename Searched<Walkable>::Cache>;

 public:
  SearchedTiles(Frame& frame, const Walkable& walkable, Pixels pixels)
      : frame_(frame),
        pixels_(std::move(pixels)),
        windows_(visible_windows(frame.scene().classification())),
        background_(frame.settings().mode == Mode::volume && frame.settings().channels.empty()),
        bundles_([&] {
          return Bundles(walkable.mesh, Searched<Walkable>::of(frame.scene(), walkable));
        }) {
    Searched<Walkable>::of(frame.scene(), walkable);
    sought_.windows = windows_;
    sought_.opacity = opacity_of(frame, pixels_);
    // Pixels stop at that; products are rounded.
    const double stops_at = frame.settings().early_termination;
    if (frame.settings().mode == Mode::volume)
      sought_.least_transmittance =
          (1 - 1e-9) * std::min(stops_at, double{static_cast<float>(stops_at)});
    if (!is_classified(frame.scene(), frame.settings()) && frame.settings().mode == Mode::volume)
      sought_.greatest_extinction = greatest_extinction(frame.scene().transfer_function());
    // What a ray carries from passage to passage, where there are intervals and isosurfaces.
    sought_.connected = is_classified(frame.scene(), frame.settings()) ? frame.gap() : -1;
  }

  void make(TileSource& tiles, Counts& counts) override {
    Bundles& bundles = bundles_.local();
    auto walk = [&](const typename Bundles::TileRay& ray) {
      pixels_.make_pixel(ray.place, counts);
    };
    while (const auto tile = tiles.next())
      bundles.for_each(
          frame_, *tile,
          [&] { find_segments(bundles.leaves, sought_, bundles.bundle, bundles.found); },
          [&](const typename Bundles::TileRay& ray, std::size_t i) {
            const SearchedRay& found = bundles.found[i];
            if (found.declined()) return walk(ray);
            ++counts.searched;
            if (found.segments().empty() && background_) return counts.add(met(found));
            pixels_.make_pixel(ray.place, counts, [&](auto& visit) { return give(found, visit); });
          },
          walk);
  }

 private:
  template <class Visit>
  static TraceResult give(const SearchedRay& found, Visit& visit) {
    TraceResult result = met(found);
    for (const FoundSegment& segment : found.segments()) {
      if constexpr (requires { visit.pass_over(); })
        if (!segment.follows) visit.pass_over();
      if (visit(static_cast<const Segment&>(segment))) continue;
      result.end = WalkEnd::stopped;
      break;
    }
    return result;
  }

  Frame& frame_;
  Pixels pixels_;
  const std::vector<ScalarWindow> windows_;
  SoughtSegments sought_;
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

  void make(TileSource& tiles, Counts& counts) override {
    Bundles& bundles = bundles_.local();
    auto walk = [&](const typename Bundles::TileRay& ray) {
      Pixel pixel;
      counts.add(follow_ray(frame_, walkable_, ray.place, pixel));
      frame_.put_raw(ray.place, pixel.value(), pixel.seen());
    };
    const bool greatest = frame_.settings().mode == Mode::maximum;
    while (const auto tile = tiles.next())
      bundles.for_each(
          frame_, *tile,
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

template <class Walkable>
std::unique_ptr<TileMaker> tiles_of(Frame& frame, const Walkable& walkable,
                                    const Integrator& integrator) {
  if (frame.settings().mode == Mode::maximum)
    return std::make_unique<ExtremeTiles<Walkable, MaximumPixel>>(frame, walkable);
  if (frame.settings().mode == Mode::minimum)
    return std::make_unique<ExtremeTiles<Walkable, MinimumPixel>>(frame, walkable);
  auto with = [&](auto pixels) -> std::unique_ptr<TileMaker> {
    return std::make_unique<SearchedTiles<Walkable, decltype(pixels)>>(frame, walkable,
                                                                       std::move(pixels));
  };
  const bool classified = is_classified(frame.scene(), frame.settings());
  if (!classified && frame.settings().mode == Mode::depth)
    return with(ModeTiles<Walkable, FirstPixel>(
        frame, walkable, FirstPixel{frame.optical_depth(), frame.tolerance()}));
  return std::visit(
      [&](const auto& chosen) {
        using Chosen = std::decay_t<decltype(chosen)>;
        return classified ? with(ClassifiedTiles<Walkable, Chosen>(frame, walkable, chosen))
                          : with(VolumeTiles<Walkable, Chosen>(frame, walkable, chosen));
      },
      integrator);
}

}  // namespace

std::unique_ptr<TileMaker> searched_tiles(Frame& frame, const Integrator& integrator) {
  return std::visit(
      [&](const auto& walkable) -> std::unique_ptr<TileMaker> {
        using Form = std::decay_t<decltype(*walkable)>;
        if constexpr (std::is_same_v<Form, Walkable<RectilinearWalker>>)
          return nullptr;  // cannot_search()
        else
          return tiles_of(frame, *walkable, integrator);
      },
      frame.scene().body().walkable);
}

}  // namespace plume
