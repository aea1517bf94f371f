#include "plume/tests/bench/tet_bench.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <memory>

#include "plume/tests/bench/interleaved.h"

namespace plume::bench {
namespace {

std::vector<TetResult> results;
bool failed = false;

// A mesh with its views and what was measured on it.
class Bench {
 public:
  Bench(const MeshSource& source, const TetBenchOptions& options)
      : source_(source), rounds_(options.rounds) {
    {
      const std::optional<Mesh> mesh = source.load();
      if (!mesh) return;
      std::fprintf(stderr, "plume_bench: making %s (%zu cells)\n", source.name.c_str(),
                   mesh->cell_count());
      mesh_ = std::make_unique<BenchMesh>(make_bench_mesh(*mesh, source.order));
    }
    const std::uint64_t tiles = options.all ? source.tiles : source.quick_tiles;
    views_ = make_views(*mesh_, source.resolution, tiles);
    const Agreement agreement = drop_lost(*mesh_, views_);
    std::fprintf(stderr,
                 "plume_bench: %s: 4 views of %d x %d pixels%s, %zu passages; the Plücker baseline "
                 "loses %zu of them (left out of the timing) and goes around the other side of an "
                 "edge in %zu\n",
                 source.name.c_str(), source.resolution, source.resolution,
                 tiles > 1 ? fmt::format(", one tile in {}", tiles).c_str() : "", agreement.total(),
                 agreement.different.size(), agreement.other_way);
    lost_ = agreement.different.size();
    wrong_ = problem(baseline(), Mode::integral, agreement);
  }

  const MeshSource& source() const { return source_; }

  void run(benchmark::State& state, Mode mode, const BenchWalker& walker) {
    if (!mesh_) return state.SkipWithError("skipped for lack of data");
    if (!wrong_.empty()) return fail(state, wrong_);
    const auto& times = times_of(mode);
    const auto of = [&times](const BenchWalker& wanted) -> const WalkerTimes& {
      for (const WalkerTimes& one : times)
        if (one.walker == &wanted) return one;
      return times.front();
    };
    const WalkerTimes& own = of(walker);
    if (!own.problem.empty()) return fail(state, own.problem);
    std::size_t round = 0;
    for (auto unused : state) {
      (void)unused;
      state.SetIterationTime(own.rounds[round++ % own.rounds.size()]);
    }
    TetResult result{source_.name, walker.name, mode, mesh_->tets.cell_count(), 0, 0, 0, 0};
    result.million_cells_per_second = own.million_cells_per_second();
    result.ratio_to_walk =
        own.million_cells_per_second() / times_of(Mode::cells).front().million_cells_per_second();
    result.bytes_per_cell =
        static_cast<double>(walker.bytes(*mesh_)) / static_cast<double>(result.mesh_cells);
    result.ratio = own.million_cells_per_second() / of(baseline()).million_cells_per_second();
    results.push_back(result);
    state.counters["Mcells/s"] = result.million_cells_per_second;
    state.counters["ns/cell"] = 1e3 / result.million_cells_per_second;
    state.counters["bytes/cell"] = result.bytes_per_cell;
    state.counters["x_plucker"] = result.ratio;
    state.counters["x_walk"] = result.ratio_to_walk;
    state.counters["plucker_lost"] = static_cast<double>(lost_);
  }

 private:
  const std::vector<WalkerTimes>& times_of(Mode mode) {
    auto& times = times_[mode];
    if (times.empty()) times = measure(*mesh_, views_, mode, rounds_);
    return times;
  }

  static void fail(benchmark::State& state, const std::string& what) {
    failed = true;
    std::fprintf(stderr, "plume_bench: %s\n", what.c_str());
    state.SkipWithError(what.c_str());
  }

  const MeshSource& source_;
  int rounds_;
  std::unique_ptr<BenchMesh> mesh_;
  std::vector<BenchView> views_;
  std::map<Mode, std::vector<WalkerTimes>> times_;
  std::size_t lost_ = 0;
  std::string wrong_;
};

// The one that is in memory: benchmarks run in the order in which they are registered.
Bench& bench_of(const MeshSource& source, const TetBenchOptions& options) {
  static std::unique_ptr<Bench> current;
  if (!current || &current->source() != &source) {
    current.reset();
    current = std::make_unique<Bench>(source, options);
  }
  return *current;
}

}  // namespace

void register_tet_benchmarks(const TetBenchOptions& options) {
  for (const MeshSource& source : mesh_sources()) {
    if (source.quick_tiles == 0 && !options.all) continue;
    for (const Mode mode : kModes)
      for (const BenchWalker& walker : walkers()) {
        if (!walker.has(mode)) continue;
        const std::string name =
            fmt::format("tetrahedra/{}/{}/{}", source.name, mode_name(mode), walker.name);
        benchmark::RegisterBenchmark(name.c_str(),
                                     [&source, mode, &walker, options](benchmark::State& state) {
                                       bench_of(source, options).run(state, mode, walker);
                                     })
            ->UseManualTime()
            ->Iterations(options.rounds)
            ->Unit(benchmark::kMillisecond);
      }
  }
}

const std::vector<TetResult>& tet_results() { return results; }
bool tet_bench_failed() { return failed; }

}  // namespace plume::bench
