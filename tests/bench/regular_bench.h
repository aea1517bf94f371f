/// The benchmarks of regular grids: walked as such, and the same grid taken as hexahedra.
#pragma once

namespace plume::bench {

/// As such, a regular grid is walked at least so many times as fast as hexahedra, linear as they.
inline constexpr double kLeastRegularRatio = 2;

/// Registers walk/regular/<cells along an edge>/<linear, quadratic, cubic> with Google Benchmark:
/// one ray after the other on one thread, in random directions. Rounds take turns with the
/// curvilinear grid's walker, whose scalar is linear. Reported are
/// - Mcells/s, and hexahedra_Mcells/s: million cells a second of the thread's time on the
/// processor;
/// - ratio: the one by the other;
/// - bytes/point: of the walkable form.
///
/// And walk/regular/<cells along an edge>/packets/<cells, integral>: the same rays in packets of
/// either form, with the widest instructions at hand, each from the ray alone. Besides, reported is
/// - ratio_inside: of the one from the ray to the other from where it comes in, which takes
/// hexahedra a hierarchy to find.
void register_regular_benchmarks(int rounds);

/// True where the two did not come to the same lengths and sums, or the ratio was below
/// kLeastRegularRatio: that benchmark has failed.
bool regular_bench_failed();

}  // namespace plume::bench
