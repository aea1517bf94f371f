#include "plume/tests/bench/walker_bench.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>

#include "plume/tests/bench/interleaved.h"

namespace plume::bench {
namespace {

std::vector<WalkerResult> results;
bool failed = false;

// A mesh with its views and what was measured on it.
class Bench {
 public:
  Bench(const MeshSource& source, const WalkerBenchOptions& options)
      : source_(source), rounds_(options.rounds) {
    {
      const std::optional<Mesh> mesh = source.load();
      if (!mesh) return;
      std::fprintf(stderr, "plume_bench: making %s (%zu cells)\n", source.name.c_str(),
                   mesh->cell_count());
      mesh_ = std::make_unique<BenchMesh>(make_bench_mesh(*mesh, source.family, source.order));
    }
    const std::uint64_t tiles = options.all ? source.tiles : source.quick_tiles;
    const int resolution = options.resolution > 0 ? options.resolution : source.resolution;
    views_ = make_views(*mesh_, resolution, tiles);
    const Agreement agreement = drop_lost(*mesh_, views_);
    lost_ = agreement.different.size();
    std::size_t left_out = 0;
    for (const BenchView& view : views_) left_out += view.left_out;
    fmt::print(
        stderr,
        "plume_bench: {0}: 4 views of {1} x {1} pixels{2}, {3} passages; the baseline {4} "
        "loses {5} of them (left out of the timing) and meets another number of cells in "
        "{6}{7}\n",
        source.name, resolution, tiles > 1 ? fmt::format(", one tile in {}", tiles) : "",
        agreement.total(), baseline(source.family).name, lost_, agreement.other_way,
        left_out > 0 ? fmt::format("; {} more are not there for all walkers", left_out) : "");
    wrong_ = problem(baseline(source.family), source.family, Mode::integral, agreement);
    if (source.family != Family::hexahedra) return;
    fmt::print(stderr, "plume_bench: {}: {} of {} cells are in the box of twisted faces\n",
               source.name, mesh_->grid.twisted.cell_count(), mesh_->grid.cell_count());
  }

  const MeshSource& source() const { return source_; }

  void run(benchmark::State& state, Mode mode, const BenchWalker& walker) {
    if (!mesh_) return state.SkipWithError("skipped for lack of data");
    if (!wrong_.empty()) return fail(state, wrong_);
    const std::vector<WalkerTimes>& times = times_of(mode).walkers;
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
    const WalkerTimes& base = of(baseline(source_.family));
    if (!base.problem.empty()) return fail(state, base.problem);
    const WalkerResult result = result_of(mode, own, base);
    if (result.bytes_per_point > kMostGridBytesPerPoint)
      return fail(state, fmt::format("{}: {:.3f} bytes a point, at most {:.3f} are promised",
                                     source_.name, result.bytes_per_point, kMostGridBytesPerPoint));
    results.push_back(result);
    state.counters["Mcells/s"] = result.million_cells_per_second;
    state.counters["ns/cell"] = 1e3 / result.million_cells_per_second;
    state.counters["bytes/cell"] = result.bytes_per_cell;
    if (result.bytes_per_point > 0) state.counters["bytes/point"] = result.bytes_per_point;
    state.counters["x_" + baseline(source_.family).name] = result.ratio;
    state.counters["x_walk"] = result.ratio_to_walk;
    state.counters["baseline_lost"] = static_cast<double>(lost_);
  }

 private:
  const ModeTimes& times_of(Mode mode) {
    ModeTimes& times = times_[mode];
    if (times.walkers.empty()) times = measure(*mesh_, views_, mode, rounds_);
    return times;
  }

  WalkerResult result_of(Mode mode, const WalkerTimes& own, const WalkerTimes& base) {
    WalkerResult result;
    result.family = source_.family;
    result.mesh = source_.name;
    result.walker = own.walker->name;
    result.mode = mode;
    result.mesh_cells = mesh_->cell_count;
    const auto bytes = static_cast<double>(own.walker->bytes(*mesh_));
    result.bytes_per_cell = bytes / static_cast<double>(result.mesh_cells);
    if (source_.family == Family::hexahedra)
      result.bytes_per_point = bytes / static_cast<double>(mesh_->grid.points.size());
    const double rate = own.million_cells_per_second();
    result.million_cells_per_second = rate;
    result.ratio = rate / base.million_cells_per_second();
    result.ratio_to_walk = rate / times_of(mode).walk.million_cells_per_second();
    std::vector<double> of_views, of_rounds;
    for (std::size_t v = 0; v < own.views.size(); ++v)
      of_views.push_back(own.views[v] / base.views[v]);
    const double cells = static_cast<double>(own.cells) / static_cast<double>(base.cells);
    for (std::size_t r = 0; r < own.rounds.size(); ++r)
      of_rounds.push_back(cells * base.rounds[r] / own.rounds[r]);
    result.ratio_of_views = range_of(of_views);
    result.ratio_of_rounds = range_of(of_rounds);
    return result;
  }

  static std::array<double, 2> range_of(const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return {*least, *most};
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
  std::map<Mode, ModeTimes> times_;
  std::size_t lost_ = 0;
  std::string wrong_;
};

// The one that is in memory: benchmarks run in the order in which they are registered.
Bench& bench_of(const MeshSource& source, const WalkerBenchOptions& options) {
  static std::unique_ptr<Bench> current;
  if (!current || &current->source() != &source) {
    current.reset();
    current = std::make_unique<Bench>(source, options);
  }
  return *current;
}

}  // namespace

void register_walker_benchmarks(const WalkerBenchOptions& options) {
  for (const Family family : {Family::tetrahedra, Family::hexahedra})
    for (const MeshSource& source : mesh_sources(family)) {
      if (source.quick_tiles == 0 && !options.all) continue;
      for (const Mode mode : kModes)
        for (const BenchWalker& walker : walkers(family)) {
          if (!walker.has(mode)) continue;
          const std::string name = fmt::format("{}/{}/{}/{}", family_name(family), source.name,
                                               mode_name(mode), walker.name);
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

const std::vector<WalkerResult>& walker_results() { return results; }
bool walker_bench_failed() { return failed; }

}  // namespace plume::bench
