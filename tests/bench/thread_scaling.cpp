#include "plume/tests/bench/thread_scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

// What is left when nothing else disturbs.
double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

bool compare_on(const std::string& name, const Mesh& mesh, const ThreadScalingOptions& options) {
  const Scene scene(mesh);
  Camera camera = named_view("iso", scene.bounds());
  orbit(camera, 3, 2);
  RenderSettings settings;
  settings.width = settings.height = options.size;
  settings.early_termination = 0;
  std::vector<double> wall[2], cpu[2], machine;
  bool same = true;
  Image single;
  for (int round = -1; round < options.rounds; ++round) {  // the first is not measured
    for (int threads = 1; threads <= 2; ++threads) {
      settings.threads = threads;
      const double wall_start = wall_seconds(), cpu_start = process_seconds();
      Image image = render(scene, camera, settings).image;
      const double wall_taken = wall_seconds() - wall_start;
      const double cpu_taken = process_seconds() - cpu_start;
      if (threads == 1) single = std::move(image);
      if (threads == 2 && image.rgba != single.rgba) same = false;
      if (round < 0) continue;
      wall[threads - 1].push_back(wall_taken);
      cpu[threads - 1].push_back(cpu_taken);
    }
    settings.threads = 1;
    const double start = wall_seconds();
    std::thread other([&] { render(scene, camera, settings); });
    render(scene, camera, settings);
    other.join();
    if (round < 0) continue;
    machine.push_back(2 * wall[0].back() / (wall_seconds() - start));
  }
  fmt::print("{:<12}{:>12.1f}{:>12.1f}{:>12.1f}{:>12.1f}{:>9.2f}{:>9.2f}{:>9.2f}{}\n", name,
             1e3 * median(wall[0]), 1e3 * median(cpu[0]), 1e3 * median(wall[1]),
             1e3 * median(cpu[1]), median(wall[0]) / median(wall[1]),
             least(wall[0]) / least(wall[1]), median(machine), same ? "" : "  PICTURES DIFFER");
  std::fflush(stdout);
  return same;
}

}  // namespace

bool compare_threads(const ThreadScalingOptions& options) {
  fmt::print("\nOne thread and two, {0} x {0} pixels, view iso; medians of {1} frames in turns\n\n",
             options.size, options.rounds);
  fmt::print("{:<12}{:>12}{:>12}{:>12}{:>12}{:>9}{:>9}{:>9}\n", "mesh", "1: ms, wall", "ms, cpu",
             "2: ms, wall", "ms, cpu", "ratio", "of least", "machine");
  bool same = true;
  for (const MeshSource& source : mesh_sources()) {
    if (source.name != "blunt-fin" && source.name != "box-1M") continue;
    const std::optional<Mesh> mesh = source.load();
    if (mesh) same = compare_on(source.name, *mesh, options) && same;
  }
  return same;
}

}  // namespace plume::bench
