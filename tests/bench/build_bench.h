/// The benchmarks of building the walkable form of tetrahedra.
#pragma once

namespace plume::bench {

struct BuildBenchOptions {
  /// Also the box of 10 million cells.
  bool all = false;
  int rounds = 3;
};

/// The walkable form may take so many bytes a tetrahedron, points and boundary included.
inline constexpr double kMostBytesPerCell = 40;

/// Registers build/tetrahedra/<mesh>/threads:1 and threads:all with Google Benchmark. Reported are
/// - Mcells/s: million cells a second of wall time (with one thread: of its CPU time);
/// - Mcells/s/core: million cells a second of all threads' CPU time;
/// - bytes/cell: what is kept, and peak_bytes/cell: the most that is allocated at once on the way,
///   the input mesh not included (counted_memory.h).
void register_build_benchmarks(const BuildBenchOptions& options);

/// True where the walkable form took more than kMostBytesPerCell: its benchmark has failed.
bool build_bench_failed();

}  // namespace plume::bench
