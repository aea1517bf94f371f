/// The thesis' naive way through tetrahedra, to compare the optimised one with: plucker_walker.h.
#pragma once

#include <cstdint>
#include <span>

#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/bench_views.h"
#include "plume/tests/bench/passage_consumers.h"

namespace plume::bench {

/// G. Marmitt, "Interactive Volume Ray Tracing" (2008), section 6.3.2, figure 6.5 (a): the possible
/// ways out are tested one after the other, each edge anew, and a face no further than the first
/// product of the wrong sign. Walks a view's passages, cells alone; a passage that finds no way out
/// ends there. The mesh's tetrahedra must all have the same orientation, as those of generators
/// have.
void walk_naive_plucker(const BenchMesh& mesh, const BenchView& view, std::span<PassageSum> sums);

struct PluckerCounts {
  std::uint64_t cells = 0, tests = 0;
  double tests_per_cell() const { return static_cast<double>(tests) / static_cast<double>(cells); }
};

/// Plücker tests of a view's passages, those of the entry face not included.
PluckerCounts count_naive_tests(const BenchMesh& mesh, const BenchView& view);
PluckerCounts count_optimised_tests(const BenchMesh& mesh, const BenchView& view);

}  // namespace plume::bench
