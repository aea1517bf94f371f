#include "plume/tests/bench/cells_bench.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

std::vector<CellsResult> results;
bool failed = false;

struct Walked {
  BenchMesh mesh;
  std::vector<BenchView> views;
  double cells = 0, faces = 0, length = 0;
};

// One row: a mesh and who walks it.
struct Contender {
  std::string mesh;
  const BenchWalker* walker;
  std::shared_ptr<const Walked> walked;
  bool is_walked = true;
};

// There are no packets for polyhedra.
bool has_walker(const Walked& walked, const BenchWalker& walker) {
  return walked.mesh.family != Family::cells || &walker == &baseline(Family::cells) ||
         walked.mesh.cells.has_packets();
}

// Faces of the cells that are met.
double faces_met(const Walked& walked, double cells) {
  if (walked.mesh.family == Family::tetrahedra) return 4 * cells;
  const WalkableCells& form = walked.mesh.cells;
  double faces = 0;
  for (const BenchView& view : walked.views)
    for (const Passage& passage : view.passages) {
      ShearedFrame frame;
      frame.set(view.rays[passage.ray], form.frame);
      CellWalker walker(form, frame);
      walker.enter(form.boundary[passage.entry.boundary], passage.entry.rank);
      do {
        faces += static_cast<double>(form.faces_of(walker.cell()).size());
      } while (walker.leave() && walker.advance());
    }
  return faces;
}

std::shared_ptr<const Walked> make(const MeshSource& source, int resolution) {
  const Mesh mesh = source.load().value();
  auto walked = std::make_shared<Walked>();
  walked->mesh = make_bench_mesh(mesh, source.family);
  walked->views =
      make_views(walked->mesh, resolution > 0 ? resolution : source.resolution, source.quick_tiles);
  for (const BenchView& view : walked->views) {
    std::vector<PassageSum> sums(view.passages.size());
    reference(source.family).walk(walked->mesh, view, Mode::integral, sums);
    for (const PassageSum& sum : sums) {
      walked->cells += sum.cells;
      walked->length += static_cast<double>(sum.first);
    }
  }
  walked->faces = faces_met(*walked, walked->cells);
  return walked;
}

// All meshes, in memory at the same time.
const std::vector<Contender>& contenders(int resolution) {
  static const std::vector<Contender> all = [resolution] {
    std::vector<Contender> made;
    for (const MeshSource& source : mesh_sources(Family::cells)) {
      const auto walked = make(source, resolution);
      for (const BenchWalker& walker : walkers(source.family)) {
        if (walker.likeness != Likeness::exact) continue;
        made.push_back({source.name, &walker, walked, has_walker(*walked, walker)});
      }
    }
    return made;
  }();
  return all;
}

using Rows = std::vector<CellsResult>;

// All of a mode, in turns.
Rows measure_all(const std::vector<Contender>& all, Mode mode, int rounds) {
  std::vector<std::function<void()>> tasks;
  for (const Contender& one : all)
    tasks.emplace_back([&one, mode] {
      if (!one.is_walked) return;
      for (const BenchView& view : one.walked->views) {
        std::vector<PassageSum> sums(view.passages.size());
        one.walker->walk(one.walked->mesh, view, mode, sums);
      }
    });
  const auto seconds = take_turns(tasks, rounds);
  Rows rows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Contender& one = all[i];
    CellsResult row;
    row.mesh = one.mesh;
    row.walker = one.walker->name;
    row.mode = mode;
    row.mesh_cells = one.walked->mesh.cell_count;
    row.bytes_per_cell = static_cast<double>(one.walker->bytes(one.walked->mesh)) /
                         static_cast<double>(row.mesh_cells);
    row.ns_per_cell = 1e9 * median(seconds[i]) / one.walked->cells;
    row.faces_per_cell = one.walked->faces / one.walked->cells;
    row.ns_per_face = row.ns_per_cell / row.faces_per_cell;
    rows.push_back(row);
  }
  const auto row_of = [&rows](const char* walker) {
    return *std::find_if(rows.begin(), rows.end(),
                         [&](const CellsResult& row) { return row.walker == walker; });
  };
  const CellsResult scalar = row_of("tet-walker"), packets = row_of("tet-packets");
  for (CellsResult& row : rows) {
    row.to_tet_walker = row.ns_per_face / scalar.ns_per_face;
    row.to_tet_packets = row.ns_per_face / packets.ns_per_face;
    row.crossed_to_tet_packets = row.ns_per_cell / packets.ns_per_cell;
  }
  return rows;
}

void run(benchmark::State& state, Mode mode, std::size_t at, const CellsBenchOptions& options) {
  const auto& all = contenders(options.resolution);
  static std::map<Mode, Rows> measured;
  if (!all[at].is_walked) return state.SkipWithError("no packets: most cells are polyhedra");
  Rows& rows = measured[mode];
  if (rows.empty()) rows = measure_all(all, mode, options.rounds);
  const CellsResult& row = rows[at];
  const double length = all.front().walked->length, own = all[at].walked->length;
  if (!(std::abs(own - length) <= 1e-5 * length)) {
    failed = true;
    const std::string what =
        fmt::format("{}: rays are {} long in it, {} in tetrahedra", row.mesh, own, length);
    std::fprintf(stderr, "plume_bench: %s\n", what.c_str());
    return state.SkipWithError(what.c_str());
  }
  for (auto unused : state) {
    (void)unused;
    state.SetIterationTime(1e-9 * row.ns_per_cell * all[at].walked->cells);
  }
  state.counters["ns/cell"] = row.ns_per_cell;
  state.counters["faces/cell"] = row.faces_per_cell;
  state.counters["ns/face"] = row.ns_per_face;
  state.counters["x_tet_walker"] = row.to_tet_walker;
  state.counters["x_tet_packets"] = row.to_tet_packets;
  state.counters["x_crossed"] = row.crossed_to_tet_packets;
  state.counters["bytes/cell"] = row.bytes_per_cell;
  results.push_back(row);
}

}  // namespace

void register_cells_benchmarks(const CellsBenchOptions& options) {
  for (const Mode mode : {Mode::cells, Mode::integral}) {
    std::size_t at = 0;
    for (const MeshSource& source : mesh_sources(Family::cells))
      for (const BenchWalker& walker : walkers(source.family)) {
        if (walker.likeness != Likeness::exact) continue;
        const std::string name =
            fmt::format("cells/{}/{}/{}", mode_name(mode), source.name, walker.name);
        benchmark::RegisterBenchmark(
            name.c_str(),
            [mode, at, options](benchmark::State& state) { run(state, mode, at, options); })
            ->UseManualTime()
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
        ++at;
      }
  }
}

const std::vector<CellsResult>& cells_results() { return results; }
bool cells_bench_failed() { return failed; }

}  // namespace plume::bench
