#include "plume/tests/bench/papers/frame_rates.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <functional>
#include <map>
#include <tuple>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/mesh/validate.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/timing.h"
#include "plume/traverse/boundary.h"

namespace plume::bench {
namespace {

// The first hits of all rays of a picture.
template <class Walker>
class FirstHits {
 public:
  FirstHits(const Mesh& mesh, Family family)
      : made_(make_bench_mesh(mesh, family)),
        mesh_(form_of<typename Walker::Mesh>(made_)),
        boundary_(mesh_) {}

  void find(const Camera& camera, int size, int threads) {
    const PixelRays rays(camera, size, size);
    tbb::task_arena(threads).execute([&] {
      tbb::parallel_for(tbb::blocked_range<int>(0, (size + kTile - 1) / kTile),
                        [&](const tbb::blocked_range<int>& range) {
                          for (int y = range.begin(); y != range.end(); ++y)
                            for (int x = 0; x < size; x += kTile)
                              find_in_tile(rays, x, y * kTile, tiles_.local());
                        });
    });
  }

 private:
  static constexpr int kTile = 16;
  struct Tile {
    std::array<ShearedFrame, kTile * kTile> frames;
    std::array<EntryList, kTile * kTile> lists;
    std::vector<const ShearedFrame*> frame_at;
    std::vector<EntryList*> list_at;
  };

  void find_in_tile(const PixelRays& rays, int x, int y, Tile& tile) const {
    tile.frame_at.clear();
    tile.list_at.clear();
    for (int i = 0; i < kTile * kTile; ++i) {
      const auto at = static_cast<std::size_t>(i);
      tile.lists[at].clear();
      if (!tile.frames[at].set(rays(x + i % kTile + 0.5, y + i / kTile + 0.5), mesh_.frame))
        continue;
      tile.frame_at.push_back(&tile.frames[at]);
      tile.list_at.push_back(&tile.lists[at]);
    }
    boundary_.first_entries(tile.frame_at, tile.list_at);
  }

  const BenchMesh made_;
  const typename Walker::Mesh& mesh_;
  const BoundaryIndex<Walker> boundary_;
  tbb::enumerable_thread_specific<Tile> tiles_;
};

// An opaque isosurface half way between the ends of the transfer function, and no volume.
Classification opaque_isosurface(const Scene& scene) {
  const auto& knots = scene.transfer_function().knots;
  return {std::nullopt,
          {},
          {{0.5f * (knots.front().scalar + knots.back().scalar), 1, {0.9f, 0.8f, 0.6f}}}};
}

template <class Walker>
FrameRates measure_frames(const Mesh& mesh, Family family, int size, int rounds) {
  Scene volume(mesh, {{}, false, CellData::constant, true});
  volume.set_transfer_function(seven_knots(volume));
  Scene surface(mesh, {{}, false, CellData::constant, true});
  surface.set_transfer_function(volume.transfer_function());
  surface.set_classification(opaque_isosurface(surface));
  FirstHits<Walker> first_hits(mesh, family);
  const auto settings = [size](int threads) {
    RenderSettings made;
    made.width = made.height = size;
    made.threads = threads;
    return made;
  };
  FrameRates rates;
  const auto views = frame_cameras(volume.bounds());
  for (std::size_t v = 0; v < 4; ++v) {
    const Camera& camera = views[v].camera;
    std::vector<std::function<void()>> tasks;
    std::vector<double*> found;
    const auto add = [&](double& rate, std::function<void()> task) {
      task();  // once beforehand: hierarchies are made when a picture needs them
      tasks.push_back(std::move(task));
      found.push_back(&rate);
    };
    for (int threads = 1; threads <= 2; ++threads) {
      const auto at = static_cast<std::size_t>(threads - 1);
      const RenderSettings plain = settings(threads);
      RenderSettings lit = plain, maximum = plain;
      lit.lighting = Lighting{};
      maximum.mode = plume::Mode::maximum;
      const auto picture = [&camera](const Scene& scene, const RenderSettings& how) {
        return [&scene, &camera, how] { render(scene, camera, how); };
      };
      add(rates.initial[at], [&, threads] { first_hits.find(camera, size, threads); });
      add(rates.isosurface[at], picture(surface, plain));
      add(rates.lit[at], picture(surface, lit));
      add(rates.maximum[at], picture(volume, maximum));
      add(rates.volume[at], picture(volume, plain));
      if (threads > 1) continue;
      RenderSettings scalar = plain;
      scalar.scalar_twin = true;
      add(rates.isosurface_scalar, picture(surface, scalar));
      add(rates.volume_scalar, picture(volume, scalar));
    }
    const auto seconds = take_turns(tasks, rounds, wall_seconds);
    for (std::size_t i = 0; i < tasks.size(); ++i) *found[i] += 0.25 / median(seconds[i]);
  }
  return rates;
}

}  // namespace

std::optional<FrameRates> frame_rates(const ThesisMesh& source, int size,
                                      const PaperOptions& options) {
  static std::map<std::tuple<std::string, Family, int>, FrameRates> known;
  const auto key = std::tuple(source.name, source.family, size);
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const std::optional<Mesh> mesh = source.load();
  if (!mesh) return std::nullopt;
  const FrameRates made =
      source.family == Family::hexahedra
          ? measure_frames<GridWalker>(*mesh, source.family, size, options.rounds)
          : measure_frames<TetWalker>(*mesh, source.family, size, options.rounds);
  return known.emplace(key, made).first->second;
}

}  // namespace plume::bench
