#include "plume/tests/bench/papers/frame_rates.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <utility>
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
    FrameLanes frames;
    std::array<EntryList, FrameLanes::kRays> lists;
  };

  void find_in_tile(const PixelRays& rays, int x, int y, Tile& tile) const {
    for (int row = 0; row < kTile; ++row) {
      RayLanes lanes;
      for (int i = 0; i < kTile; ++i) lanes.add(rays(x + i + 0.5, y + row + 0.5));
      tile.frames.set(lanes, mesh_.frame);
      boundary_.first_entries(tile.frames, tile.lists);
    }
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
class Frames {
 public:
  Frames(const Mesh& mesh, Family family)
      : volume_(mesh, {{}, false, CellData::constant, true}),
        surface_(mesh, {{}, false, CellData::constant, true}),
        first_hits_(mesh, family) {
    volume_.set_transfer_function(seven_knots(volume_));
    surface_.set_transfer_function(volume_.transfer_function());
    surface_.set_classification(opaque_isosurface(surface_));
  }

  FrameRates rates(int size, int rounds) {
    FrameRates rates;
    const auto views = frame_cameras(volume_.bounds());
    for (std::size_t v = 0; v < 4; ++v) {
      for (int threads = 1; threads <= 2; ++threads) {
        std::vector<Task> tasks;
        add_tasks(rates, views[v].camera, size, threads, tasks);
        std::vector<std::function<void()>> todo;
        for (const Task& task : tasks) {
          if (v == 0) task.todo();  // once beforehand: hierarchies are made when they are needed
          todo.push_back(task.todo);
        }
        const auto seconds = take_turns(todo, rounds, threads == 1 ? thread_seconds : wall_seconds);
        for (std::size_t i = 0; i < tasks.size(); ++i) *tasks[i].rate += 0.25 / median(seconds[i]);
      }
    }
    return rates;
  }

 private:
  struct Task {
    double* rate;
    std::function<void()> todo;
  };

  void add_tasks(FrameRates& rates, const Camera& camera, int size, int threads,
                 std::vector<Task>& tasks) {
    const auto at = static_cast<std::size_t>(threads - 1);
    RenderSettings plain;
    plain.width = plain.height = size;
    plain.threads = threads;
    RenderSettings lit = plain, maximum = plain, scalar = plain;
    lit.lighting = Lighting{};
    maximum.mode = plume::Mode::maximum;
    scalar.scalar_twin = true;
    const auto add = [&](double& rate, const Scene& scene, const RenderSettings& how) {
      tasks.push_back({&rate, [&scene, &camera, how] { render(scene, camera, how); }});
    };
    tasks.push_back({&rates.initial[at],
                     [this, &camera, size, threads] { first_hits_.find(camera, size, threads); }});
    add(rates.isosurface[at], surface_, plain);
    add(rates.lit[at], surface_, lit);
    add(rates.maximum[at], volume_, maximum);
    add(rates.volume[at], volume_, plain);
    if (threads > 1) return;
    add(rates.isosurface_scalar, surface_, scalar);
    add(rates.volume_scalar, volume_, scalar);
  }

  Scene volume_, surface_;
  FirstHits<Walker> first_hits_;
};

template <class Walker>
std::array<FrameRates, 2> measure_frames(const ThesisMesh& source, const Mesh& mesh,
                                         const PaperOptions& options) {
  Frames<Walker> frames(mesh, source.family);
  std::array<FrameRates, 2> rates;
  for (std::size_t s = 0; s < 2; ++s)
    rates[s] = frames.rates(options.quick ? kThesisSizes[s] / 32 : kThesisSizes[s], options.rounds);
  return rates;
}

}  // namespace

std::optional<std::array<FrameRates, 2>> frame_rates(const ThesisMesh& source,
                                                     const PaperOptions& options) {
  static std::map<std::pair<std::string, Family>, std::array<FrameRates, 2>> known;
  const auto key = std::pair(source.name, source.family);
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const std::optional<Mesh> mesh = source.load();
  if (!mesh) return std::nullopt;
  const auto made = source.family == Family::hexahedra
                        ? measure_frames<GridWalker>(source, *mesh, options)
                        : measure_frames<TetWalker>(source, *mesh, options);
  return known.emplace(key, made).first->second;
}

}  // namespace plume::bench
