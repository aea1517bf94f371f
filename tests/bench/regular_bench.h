/// The benchmarks of regular grids: walked as such, and the same grid taken as hexahedra.
#pragma once

namespace plume::bench {

/// As such, a regular grid is walked at least so many times as fast as hexahedra, linear as they.
inline constexpr double kLeastRegularRatio = 2;

/// Registers walk/regular/<cells along an edge>/<linear, quadratic, cubic> with Google Benchmark:
/// one ray after the other on one thread, in random directions; and .../linear/picture, with the
/// rays of a picture. Rounds take turns with the curvilinear grid's scalar walker, whose scalar is
/// linear, and with its packets (regular grids have none); first hits are part of all. Reported are
/// - Mcells/s, hexahedra_Mcells/s, packets_Mcells/s: million cells a second of the thread's time on
///   the processor;
/// - ratio, to_packets: the first by the second, and by the third;
/// - bytes/point: of the walkable form.
void register_regular_benchmarks(int rounds);

/// True where the three did not come to the same lengths and sums, or the ratio was below
/// kLeastRegularRatio: that benchmark has failed.
bool regular_bench_failed();

}  // namespace plume::bench
