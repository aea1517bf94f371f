// Cost against pixels, threads and knots of the transfer function, of one mesh each.

#include <tbb/global_control.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/scaling/scaling_frames.h"
#include "plume/tests/bench/scaling/scaling_series.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

const std::vector<std::string> kKinds{"tetrahedra", "hexahedra"};

double cells_of(const ScalingOptions& options) { return options.quick ? 3e3 : 1e6; }

// As opaque on average for any number of knots.
TransferFunction random_knots(const Scene& scene, int count) {
  const TransferFunction range = seven_knots(scene);
  const float low = range.knots.front().scalar, high = range.knots.back().scalar;
  const auto most = static_cast<float>(4 / scene.bounds().diagonal());
  std::mt19937_64 random(static_cast<std::uint64_t>(count));
  std::uniform_real_distribution<float> unit(0, 1);
  TransferFunction made;
  for (int i = 0; i < count; ++i) {
    Optics optics;
    optics.extinction = most * unit(random);
    optics.color = {unit(random), unit(random), unit(random)};
    made.knots.push_back(
        {low + (high - low) * static_cast<float>(i) / static_cast<float>(count - 1), optics});
  }
  return made;
}

}  // namespace

void scale_pixels(const ScalingOptions& options, const SeriesMade& made) {
  for (const std::string& kind : kKinds) {
    Scene scene(unit_cube(kind, cells_of(options)));
    scene.set_transfer_function(seven_knots(scene));
    std::vector<ScalingFrame> frames;
    for (int size = options.quick ? 16 : 64; size <= (options.quick ? 32 : 2048); size *= 2)
      frames.push_back(iso_frame(scene, size));
    ScalingSeries series{
        "pixels", kind, "pixels", {"frame, ms", "ns a pixel", "ns a cell met"}, {}};
    const auto costs = frame_costs(frames, options.rounds);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const double side = frames[i].settings.width, pixels = side * side;
      series.points.push_back(
          {pixels,
           {1e3 * costs[i].seconds, 1e9 * costs[i].seconds / pixels, costs[i].ns_per_cell()}});
    }
    made(series);
  }
}

void scale_threads(const ScalingOptions& options, const SeriesMade& made) {
  const int most = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  for (const std::string& kind : kKinds) {
    const Mesh mesh = unit_cube(kind, cells_of(options));
    Scene scene(mesh);
    scene.set_transfer_function(seven_knots(scene));
    std::vector<ScalingFrame> frames;
    std::vector<std::function<void()>> tasks;
    for (int threads = 1; threads <= most; ++threads) {
      frames.push_back(iso_frame(scene, options.quick ? 32 : 1024));
      frames.back().settings.threads = threads;
    }
    for (const ScalingFrame& frame : frames) {
      tasks.emplace_back([&frame] { render(*frame.scene, frame.camera, frame.settings); });
      tasks.emplace_back([&frame, &mesh] {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(frame.settings.threads));
        const Scene built(mesh);
      });
    }
    const auto seconds = take_turns(tasks, options.rounds, wall_seconds);
    ScalingSeries series{"threads", kind, "threads", {"frame, ms", "build, ms"}, {}};
    for (std::size_t i = 0; i < frames.size(); ++i)
      series.points.push_back({static_cast<double>(frames[i].settings.threads),
                               {1e3 * median(seconds[2 * i]), 1e3 * median(seconds[2 * i + 1])}});
    made(series);
  }
}

void scale_knots(const ScalingOptions& options, const SeriesMade& made) {
  const std::vector<double> meshes =
      options.quick ? std::vector<double>{3e3} : std::vector<double>{3e4, 1e6};
  for (const double cells : meshes) {
    const Mesh mesh = unit_cube("tetrahedra", cells);
    std::vector<std::unique_ptr<Scene>> scenes;
    std::vector<ScalingFrame> frames;
    for (int knots = 2; knots <= (options.quick ? 4 : 256); knots *= 2) {
      scenes.push_back(std::make_unique<Scene>(mesh));
      scenes.back()->set_transfer_function(random_knots(*scenes.back(), knots));
      frames.push_back(iso_frame(*scenes.back(), options.quick ? 32 : 512));
    }
    ScalingSeries series{"knots",
                         std::to_string(mesh.cell_count()) + " tetrahedra",
                         "knots",
                         {"frame, ms", "ns a cell met"},
                         {}};
    const auto costs = frame_costs(frames, options.rounds);
    for (std::size_t i = 0; i < frames.size(); ++i)
      series.points.push_back({static_cast<double>(scenes[i]->transfer_function().knots.size()),
                               {1e3 * costs[i].seconds, costs[i].ns_per_cell()}});
    made(series);
  }
}

}  // namespace plume::bench
