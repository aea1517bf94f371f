/// The benchmarks of walkers through tetrahedra.
#pragma once

#include <string>
#include <vector>

#include "plume/tests/bench/passage_consumers.h"

namespace plume::bench {

struct TetBenchOptions {
  /// Also the meshes of more than a million cells, and more rays.
  bool all = false;
  int rounds = 3;
};

struct TetResult {
  std::string mesh, walker;
  Mode mode = Mode::cells;
  std::size_t mesh_cells = 0;
  double million_cells_per_second = 0;
  double bytes_per_cell = 0;
  /// How many times as fast as the Plücker baseline in the same run.
  double ratio = 0;
  /// How many times as fast as the baseline's walk alone (Mode::cells).
  double ratio_to_walk = 0;
};

/// Registers tetrahedra/<mesh>/<mode>/<walker> with Google Benchmark, for each mesh, mode and
/// walker. Meshes are made when the first benchmark that needs them runs, one at a time.
void register_tet_benchmarks(const TetBenchOptions& options);

/// What the benchmarks that have run so far came to.
const std::vector<TetResult>& tet_results();

/// True where a walker did not do the same work as the reference: its benchmark has failed.
bool tet_bench_failed();

}  // namespace plume::bench
