/// The thesis' scalar walker in the form of the benchmarks. In a file of its own: compiled together
/// with the other walkers it was inlined less, and a quarter slower.
#pragma once

#include <span>

#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/bench_views.h"
#include "plume/tests/bench/passage_consumers.h"

namespace plume::bench {

/// Walks a view's passages through tetrahedra by walk_plucker(): with the thesis' products, and
/// with products relative to the ray.
void walk_thesis_plucker(const BenchMesh& mesh, const BenchView& view, Mode mode,
                         std::span<PassageSum> sums);
void walk_relative_plucker(const BenchMesh& mesh, const BenchView& view, Mode mode,
                           std::span<PassageSum> sums);

}  // namespace plume::bench
