#include "plume/tests/bench/build_bench.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "plume/mesh/validate.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/counted_memory.h"

namespace plume::bench {
namespace {

bool failed = false;

double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Input {
  explicit Input(const MeshSource& source)
      : name(source.name),
        mesh(source.load().value()),
        bounds(check_structure(mesh)),
        field(select_field(mesh)) {}

  std::string name;
  Mesh mesh;
  Bounds bounds;
  ScalarField field;
};

// The one that is in memory: benchmarks run in the order in which they are registered.
const Input& input_of(const MeshSource& source) {
  static std::unique_ptr<Input> current;
  if (!current || current->name != source.name) {
    current.reset();
    current = std::make_unique<Input>(source);
  }
  return *current;
}

void run(benchmark::State& state, const MeshSource& source, bool one_thread) {
  const Input& input = input_of(source);
  const auto cells = static_cast<double>(input.mesh.cell_count());
  std::optional<tbb::global_control> limit;
  if (one_thread) limit.emplace(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<double> wall, cpu;
  double kept = 0, peak = 0;
  for (auto unused : state) {
    (void)unused;
    const std::size_t before = counted_bytes();
    forget_peak();
    const double cpu_start = seconds(CLOCK_PROCESS_CPUTIME_ID);
    const double start = seconds(CLOCK_MONOTONIC);
    const WalkableTets tets = make_walkable_tets(input.mesh, input.field, input.bounds, false);
    wall.push_back(seconds(CLOCK_MONOTONIC) - start);
    cpu.push_back(seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_start);
    peak = static_cast<double>(counted_peak() - before) / cells;
    kept = static_cast<double>(tets.bytes()) / cells;
    state.SetIterationTime(one_thread ? cpu.back() : wall.back());
  }
  const auto rate = [cells](std::vector<double>& times) {
    std::sort(times.begin(), times.end());
    return 1e-6 * cells / times[times.size() / 2];
  };
  state.counters["Mcells/s"] = rate(one_thread ? cpu : wall);
  state.counters["Mcells/s/core"] = rate(cpu);
  state.counters["bytes/cell"] = kept;
  state.counters["peak_bytes/cell"] = peak;
  if (kept <= kMostBytesPerCell && kept <= peak) return;
  failed = true;
  const std::string what = fmt::format(
      "{}: the walkable form takes {:.1f} bytes a cell, at most {} are promised; {:.1f} at the "
      "peak",
      source.name, kept, kMostBytesPerCell, peak);
  std::fprintf(stderr, "plume_bench: %s\n", what.c_str());
  state.SkipWithError(what.c_str());
}

}  // namespace

void register_build_benchmarks(const BuildBenchOptions& options) {
  for (const MeshSource& source : mesh_sources()) {
    if (source.name != "box-1M" && !(options.all && source.name == "box-10M")) continue;
    for (const bool one_thread : {true, false}) {
      const std::string name =
          fmt::format("build/tetrahedra/{}/threads:{}", source.name, one_thread ? "1" : "all");
      benchmark::RegisterBenchmark(
          name.c_str(),
          [&source, one_thread](benchmark::State& state) { run(state, source, one_thread); })
          ->UseManualTime()
          ->Iterations(options.rounds)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

bool build_bench_failed() { return failed; }

}  // namespace plume::bench
