/// The benchmarks of walkers through tetrahedra and hexahedra.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "plume/tests/bench/bench_meshes.h"

namespace plume::bench {

struct WalkerBenchOptions {
  /// Also the meshes of more than a million cells, and more rays.
  bool all = false;
  int rounds = 3;
  /// Pixels along each side of a view; 0: as the mesh has them.
  int resolution = 0;
};

struct WalkerResult {
  Family family = Family::tetrahedra;
  std::string mesh, walker;
  Mode mode = Mode::cells;
  std::size_t mesh_cells = 0;
  double million_cells_per_second = 0;
  double bytes_per_cell = 0;
  /// Of hexahedra; 0 of tetrahedra.
  double bytes_per_point = 0;
  /// How many times as fast as the family's baseline in the same run.
  double ratio = 0;
  /// The same from view to view, and from round to round.
  std::array<double, 2> ratio_of_views{}, ratio_of_rounds{};
  /// How many times as fast as the baseline's walk alone (Mode::cells).
  double ratio_to_walk = 0;
};

/// A curvilinear grid may take so many bytes a point, and nothing a cell, its boundary not counted:
/// a point and its scalar, and whether the three faces at it are planar where some are
/// (mesh/walkable_grid.h). What was aimed at is 16.
inline constexpr double kMostGridBytesPerPoint = 16 + 3.0 / 8 + 1e-3;

/// Registers <family>/<mesh>/<mode>/<walker> with Google Benchmark, for each mesh, mode and walker
/// of tetrahedra and hexahedra. Meshes are made when the first benchmark that needs them runs, one
/// at a time.
void register_walker_benchmarks(const WalkerBenchOptions& options);

/// What the benchmarks that have run so far came to.
const std::vector<WalkerResult>& walker_results();

/// True where a walker did not do the same work as the reference, or a curvilinear grid took more
/// than kMostGridBytesPerPoint: that benchmark has failed.
bool walker_bench_failed();

}  // namespace plume::bench
