#include "plume/lib/render.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <type_traits>

#include "plume/lib/classified_pixel.h"
#include "plume/lib/packet_tile.h"
#include "plume/lib/pixel.h"
#include "plume/lib/rectilinear_tile.h"
#include "plume/lib/render_plan.h"
#include "plume/lib/scene_body.h"
#include "plume/mesh/error.h"
#include "plume/traverse/packets.h"

namespace plume {
namespace {

constexpr int kTile = 32;  // pixels along a tile's edge

// A tile's pixels along a Z-curve: neighbours in the list, which share packets, are neighbours in
// the picture, and meet the same cells.
struct TilePixel {
  int x, y;
};
constexpr std::array<TilePixel, kTile* kTile> kTileOrder = [] {
  std::array<TilePixel, kTile * kTile> order{};
  for (std::size_t place = 0; place < order.size(); ++place)
    for (int bit = 0; bit < 5; ++bit) {
      order[place].x |= static_cast<int>(place >> (2 * bit) & 1) << bit;
      order[place].y |= static_cast<int>(place >> (2 * bit + 1) & 1) << bit;
    }
  return order;
}();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Passages closer than this share of the mesh's diagonal are one, as far as intervals and
// isosurfaces are concerned: places on the faces of blocks that touch differ by rounding, which is
// some 1e-7 of the mesh.
constexpr double kGap = 1e-6;
const std::vector<std::string> kChannels{"depth",      "optical_depth", "cell_id",
                                         "cell_count", "isovalue",      "normal"};

void check(const Scene& scene, const RenderSettings& settings) {
  auto in_range = [](int pixels) { return pixels >= 1 && pixels <= 65536; };
  if (!in_range(settings.width) || !in_range(settings.height))
    throw Error(fmt::format("a picture of {}x{} pixels: each side must be 1 to 65536",
                            settings.width, settings.height));
  if (!(settings.early_termination >= 0 && settings.early_termination < 1))
    throw Error(fmt::format("early termination at {}: it must be at least 0 and below 1",
                            settings.early_termination));
  for (const ClipPlane& plane : settings.clip_planes)
    if (const auto problem = problem_of(plane)) throw Error(*problem);
  if (settings.threads < 0)
    throw Error(fmt::format("{} threads: it must be 1 or more, or 0 for all", settings.threads));
  if (const auto problem = settings.integrator.problem()) throw Error(*problem);
  if (settings.order < ScalarOrder::linear || settings.order > ScalarOrder::cubic)
    throw Error(fmt::format("order {}: it must be 1 (linear), 2 (quadratic) or 3 (cubic)",
                            static_cast<int>(settings.order)));
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
  if (settings.lighting)
    if (const auto problem = settings.lighting->problem())
      throw Error(fmt::format("light: {}", *problem));
}

struct Counts {
  std::uint64_t hit = 0, entries = 0, cells = 0, lost = 0, surfaces = 0, visits = 0;
  std::uint64_t in_packets = 0;

  void add(const TraceResult& trace) {
    hit += trace.entries > 0 ? 1 : 0;
    entries += trace.entries;
    cells += trace.cells;
    lost += trace.end == WalkEnd::lost ? 1 : 0;
  }
};

// Whether there are packets for what the scene is walked as.
bool has_packets(const Scene& scene) {
  return std::visit(
      [](const auto& walkable) {
        using Walker = typename std::decay_t<decltype(*walkable)>::Walker;
        if constexpr (std::is_same_v<Walker, CellWalker>)
          return !walkable->mesh.corner_cells.empty();
        if constexpr (std::is_same_v<Walker, RectilinearWalker>)
          return walked_by_packets(walkable->mesh);
        return true;
      },
      scene.body().walkable);
}

// One frame: shared by all tiles.
class Frame {
 public:
  Frame(const Scene& scene, const Camera& camera, const RenderSettings& settings)
      : scene_(scene),
        settings_(settings),
        rays_(camera, settings.width, settings.height),
        classified_(is_classified(scene, settings)),
        optics_(classified_ ? scene.classification() : Classification{}, settings.interval_form),
        tolerance_(1e-4 * (static_cast<double>(scene.field().high) - scene.field().low)) {
    image_.width = settings.width;
    image_.height = settings.height;
    image_.rgba.assign(4 * pixels(), 0);
    for (const std::string& name : settings.channels) {
      if (name != "normal") {
        channel_place(name);
        continue;
      }
      for (const char* component : {"normal.x", "normal.y", "normal.z"})
        normal_.push_back(channel_place(component));
    }
    if (settings.mode == Mode::maximum) raw_ = channel_place("maximum");
    if (settings.mode == Mode::integral) raw_ = channel_place("integral");
    if (settings.mode == Mode::depth) raw_ = channel_place("depth");
    depth_ = wanted("depth");
    optical_depth_ = wanted("optical_depth");
    cell_id_ = wanted("cell_id");
    cell_count_ = wanted("cell_count");
    isovalue_ = wanted("isovalue");
  }

  bool whole_rays() const { return optical_depth_ || cell_count_; }
  Image& image() { return image_; }
  std::size_t pixels() const {
    return static_cast<std::size_t>(settings_.width) * static_cast<std::size_t>(settings_.height);
  }

  template <class Walkable, class Integrator>
  void render_tile(const Walkable& walkable, const Integrator& integrator, int tile_x, int tile_y,
                   Counts& counts) {
    const int end_x = std::min(tile_x + kTile, settings_.width);
    const int end_y = std::min(tile_y + kTile, settings_.height);
    for (int y = tile_y; y < end_y; ++y)
      for (int x = tile_x; x < end_x; ++x) {
        const std::size_t index =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(settings_.width) +
            static_cast<std::size_t>(x);
        counts.add(
            classified_
                ? classify_pixel(walkable, integrator, rays_(x + 0.5, y + 0.5), index, counts)
                : render_pixel(walkable, integrator, rays_(x + 0.5, y + 0.5), index));
      }
  }

  // The same by packets of rays; those that packets decline are left to the twin.
  template <class Walker, class Integrator>
  void render_tile(const Walkable<Walker>& walkable, const Integrator& integrator,
                   PacketTile<Walker>& packets, int tile_x, int tile_y, Counts& counts) {
    const int end_x = std::min(tile_x + kTile, settings_.width);
    const int end_y = std::min(tile_y + kTile, settings_.height);
    packets.clear();
    auto for_each_pixel = [&](auto&& visit) {
      for (const auto& [along, down] : kTileOrder) {
        const int x = tile_x + along, y = tile_y + down;
        if (x < end_x && y < end_y) visit(x, y);
      }
    };
    for_each_pixel([&](int x, int y) { packets.add(rays_(x + 0.5, y + 0.5)); });
    packets.composite();
    std::size_t ray = 0;
    for_each_pixel([&](int x, int y) {
      const std::size_t index =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(settings_.width) +
          static_cast<std::size_t>(x);
      const PacketResult result = packets.result(ray++);
      if (result.declined) {
        counts.add(render_pixel(walkable, integrator, rays_(x + 0.5, y + 0.5), index));
        return;
      }
      counts.add(result.trace);
      ++counts.in_packets;
      float* rgba = &image_.rgba[4 * index];
      rgba[0] = result.color.r;
      rgba[1] = result.color.g;
      rgba[2] = result.color.b;
      rgba[3] = 1 - result.color.transmittance;
    });
  }

  // Whether packets can render this frame: linear segments, nothing but a volume, whole rays,
  // closed form, no further channels.
  bool by_packets() const {
    const bool linear = settings_.order == ScalarOrder::linear ||
                        scene_.field().association == Association::cell ||
                        std::string(scene_.form()) == "tetrahedra";
    return linear && has_packets(scene_) && !classified_ && settings_.clip_planes.empty() &&
           !settings_.scalar_twin && settings_.mode == Mode::volume &&
           settings_.integrator.kind == IntegratorKind::closed_form && settings_.channels.empty();
  }

  // Modes whose shades depend on the whole picture's range.
  void shade_raw() {
    if (settings_.mode != Mode::integral && settings_.mode != Mode::depth) return;
    const auto& values = image_.channels[*raw_].values;
    float low = kInfinity, high = -kInfinity;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (image_.rgba[4 * i + 3] == 0) continue;
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    if (settings_.mode == Mode::integral) low = std::min(low, 0.0f);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (image_.rgba[4 * i + 3] == 0) continue;
      float shade = high > low ? (values[i] - low) / (high - low) : 1.0f;
      if (settings_.mode == Mode::depth && high > low) shade = 1 - shade;
      std::fill_n(&image_.rgba[4 * i], 3, shade);
    }
  }

 private:
  std::size_t channel_place(const std::string& name) {
    for (std::size_t i = 0; i < image_.channels.size(); ++i)
      if (image_.channels[i].name == name) return i;
    image_.channels.push_back({name, std::vector<float>(pixels(), 0)});
    return image_.channels.size() - 1;
  }
  std::optional<std::size_t> wanted(const std::string& name) {
    const auto& list = settings_.channels;
    if (std::find(list.begin(), list.end(), name) == list.end()) return std::nullopt;
    return channel_place(name);
  }

  template <class Walkable, class Integrator>
  TraceResult render_pixel(const Walkable& walkable, const Integrator& integrator, const Ray& ray,
                           std::size_t index) {
    if (!(depth_ || cell_id_ || whole_rays()))
      return shade(walkable, integrator, ray, index, [](const Segment&) { return false; });
    ChannelPixel<Integrator> channels{{integrator, tolerance_}};
    const bool whole = whole_rays();
    const TraceResult result = shade(walkable, integrator, ray, index, [&](const Segment& segment) {
      channels(segment);
      return whole;
    });
    auto put = [&](const std::optional<std::size_t>& channel, double value) {
      if (channel) image_.channels[*channel].values[index] = static_cast<float>(value);
    };
    put(depth_, channels.first.depth);
    put(optical_depth_, channels.optical_depth);
    put(cell_count_, static_cast<double>(channels.cells));
    put(cell_id_,
        channels.first.cell == kNone ? -1.0 : walkable.mesh.original_cell(channels.first.cell));
    return result;
  }

  // Hands the segments of what clip planes keep of a ray to `visit`.
  template <class Walkable, class Visit>
  TraceResult trace_clipped(const Walkable& walkable, Ray ray, Visit&& visit) const {
    if (!clip(ray, settings_.clip_planes)) return {};
    return trace(walkable.mesh, walkable.boundary, ray, visit, settings_.order);
  }

  // A pixel of a scene with intervals or isosurfaces.
  template <class Walkable, class Integrator>
  TraceResult classify_pixel(const Walkable& walkable, const Integrator& integrator, const Ray& ray,
                             std::size_t index, Counts& counts) {
    const bool depth_alone = settings_.mode == Mode::depth;
    auto gradient_at = [&](const SurfaceHit& hit) {
      std::array<double, 3> place;
      for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + hit.t * ray.direction[a];
      return scene_.body().gradients->at(walkable.mesh, hit.cell, place);
    };
    auto shade = [&](const SurfaceHit& hit) {
      return settings_.lighting ? shading_of(*settings_.lighting, gradient_at(hit), ray.direction)
                                : Shading{};
    };
    ClassifiedPixel pixel(
        optics_, integrator, shade,
        {settings_.early_termination, tolerance_, kGap * scene_.bounds().diagonal(),
         settings_.lighting && settings_.lighting->intervals, depth_alone && !whole_rays(),
         whole_rays()});
    const TraceResult result = trace_clipped(walkable, ray, pixel);
    counts.surfaces += pixel.surfaces;
    counts.visits += pixel.visits;
    float* rgba = &image_.rgba[4 * index];
    if (depth_alone) {
      image_.channels[*raw_].values[index] = static_cast<float>(pixel.first.t);
      rgba[3] = pixel.first.is_one() ? 1.0f : 0.0f;
    } else {
      for (std::size_t c = 0; c < 3; ++c) rgba[c] = static_cast<float>(pixel.compositor.rgb[c]);
      rgba[3] = static_cast<float>(pixel.compositor.alpha());
    }
    auto put = [&](const std::optional<std::size_t>& channel, double value) {
      if (channel) image_.channels[*channel].values[index] = static_cast<float>(value);
    };
    put(depth_, pixel.first.t);
    put(optical_depth_, pixel.optical_depth);
    put(cell_count_, static_cast<double>(pixel.cells));
    put(cell_id_, pixel.first.is_one() ? walkable.mesh.original_cell(pixel.first.cell) : -1.0);
    put(isovalue_, pixel.first.scalar);
    if (!normal_.empty()) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      const auto gradient =
          pixel.first.is_one() ? gradient_at(pixel.first) : std::array<double, 3>{nan, nan, nan};
      const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
      for (std::size_t a = 0; a < 3; ++a) put(normal_[a], gradient[a] / length);
    }
    return result;
  }

  // Traces one ray and shades its pixel. `besides` sees every segment too; where it returns true
  // the ray goes on though the picture has seen enough.
  template <class Walkable, class Integrator, class Besides>
  TraceResult shade(const Walkable& walkable, const Integrator& integrator, const Ray& ray,
                    std::size_t index, const Besides& besides) {
    auto follow = [&](auto& pixel) {
      bool more = true;
      auto visit = [&](const Segment& segment) {
        const bool go_on = besides(segment);
        if (more) more = pixel(segment);
        return more || go_on;
      };
      return trace_clipped(walkable, ray, visit);
    };
    float* rgba = &image_.rgba[4 * index];
    TraceResult result;
    switch (settings_.mode) {
      case Mode::volume: {
        VolumePixel<Integrator> pixel{integrator, static_cast<float>(settings_.early_termination),
                                      tolerance_};
        result = follow(pixel);
        for (std::size_t c = 0; c < 3; ++c) rgba[c] = static_cast<float>(pixel.compositor.rgb[c]);
        rgba[3] = static_cast<float>(pixel.compositor.alpha());
        break;
      }
      case Mode::maximum: {
        MaximumPixel pixel;
        result = follow(pixel);
        const bool any = pixel.maximum > -kInfinity;
        image_.channels[*raw_].values[index] =
            any ? pixel.maximum : std::numeric_limits<float>::quiet_NaN();
        if (!any) break;
        const Optics optics = scene_.transfer_function().at(pixel.maximum);
        std::copy(optics.color.begin(), optics.color.end(), rgba);
        rgba[3] = 1;
        break;
      }
      case Mode::integral: {
        IntegralPixel pixel;
        result = follow(pixel);
        image_.channels[*raw_].values[index] = static_cast<float>(pixel.integral);
        rgba[3] = result.cells > 0 ? 1.0f : 0.0f;
        break;
      }
      case Mode::depth: {
        FirstPixel<Integrator> pixel{integrator, tolerance_};
        result = follow(pixel);
        image_.channels[*raw_].values[index] = static_cast<float>(pixel.depth);
        rgba[3] = pixel.depth < kInfinity ? 1.0f : 0.0f;
        break;
      }
    }
    return result;
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  PixelRays rays_;
  bool classified_;  // shows more than a volume, by optics_
  ClassifiedOptics optics_;
  double tolerance_;  // of the linear parts of segments, in the field's unit
  Image image_;
  std::optional<std::size_t> raw_, depth_, optical_depth_, cell_id_, cell_count_, isovalue_;
  std::vector<std::size_t> normal_;  // x, y and z, or none
};

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

}  // namespace

RenderResult render(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                    const Progress& progress) {
  check(scene, settings);
  RenderSettings effective = settings;
  Frame frame(scene, camera, effective);
  RenderResult result;
  result.statistics.plan = describe_plan(scene, settings);
  if (has_packets(scene))
    result.statistics.plan.push_back(
        frame.by_packets() ? fmt::format("rays: in packets, {}", packet_instruction_set())
                           : "rays: one by one (packets serve the volume mode by the closed form, "
                             "at order 1, without intervals, isosurfaces, clip planes and further "
                             "channels)");
  if (frame.whole_rays() && settings.mode == Mode::volume) {
    effective.early_termination = 0;
    result.statistics.plan.push_back("early termination: off, as a channel needs whole rays");
  } else if (settings.mode == Mode::volume) {
    result.statistics.plan.push_back(
        fmt::format("early termination: at a transmittance of {:g}", settings.early_termination));
  }

  const int tiles_x = (settings.width + kTile - 1) / kTile;
  const int tiles_y = (settings.height + kTile - 1) / kTile;
  ProgressReport report(progress, tiles_x * tiles_y);
  tbb::enumerable_thread_specific<Counts> counts;
  const PieceTable pieces(scene.transfer_function());
  // A table is built only where the picture needs what is in it: colours.
  if (settings.mode != Mode::volume || !scene.classification().volume)
    effective.integrator.kind = IntegratorKind::closed_form;
  const auto integrator =
      scene.body().integrators.get(scene.transfer_function(), effective.integrator);
  if (auto table = describe_table(*integrator)) result.statistics.plan.push_back(*table);
  const int available = tbb::this_task_arena::max_concurrency();
  tbb::task_arena arena(settings.threads > 0 ? std::min(settings.threads, available) : available);
  auto for_each_tile = [&](const auto& body) {
    arena.execute([&] {
      tbb::parallel_for(tbb::blocked_range<int>(0, tiles_x * tiles_y, 1), [&](const auto& range) {
        for (int tile = range.begin(); tile != range.end(); ++tile) {
          if (report.cancelled()) return;
          body(tile % tiles_x * kTile, tile / tiles_x * kTile);
          report.tile_done();
        }
      });
    });
  };
  std::visit(
      [&](const auto& walkable, const auto& chosen) {
        using Form = typename std::decay_t<decltype(*walkable)>::Walker;
        if (frame.by_packets()) {
          tbb::enumerable_thread_specific<PacketTile<Form>> packets([&] {
            return PacketTile<Form>(walkable->mesh, walkable->boundary, pieces,
                                    static_cast<float>(effective.early_termination));
          });
          for_each_tile([&](int x, int y) {
            frame.render_tile(*walkable, chosen, packets.local(), x, y, counts.local());
          });
          return;
        }
        for_each_tile(
            [&](int x, int y) { frame.render_tile(*walkable, chosen, x, y, counts.local()); });
      },
      scene.body().walkable, *integrator);
  frame.shade_raw();

  for (const Counts& part : counts) {
    result.statistics.rays_hit += part.hit;
    result.statistics.entries += part.entries;
    result.statistics.cells_visited += part.cells;
    result.statistics.lost_rays += part.lost;
    result.statistics.rays_in_packets += part.in_packets;
    result.statistics.surfaces += part.surfaces;
    result.statistics.visits += part.visits;
  }
  result.statistics.rays = frame.pixels();
  result.cancelled = report.cancelled();
  result.image = std::move(frame.image());
  return result;
}

}  // namespace plume
