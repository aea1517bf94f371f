/// Packets of rays in the form of the benchmarks.
#pragma once

#include <span>

#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/bench_views.h"
#include "plume/tests/bench/passage_consumers.h"

namespace plume::bench {

/// Walks a view's passages by packets (traverse/packets.h), with the widest instructions that
/// are allowed. Cells of other kinds must have corner_cells. Not Mode::volume, whose
/// optics are the scalar walkers'.
void walk_packet_passages(const BenchMesh& mesh, const BenchView& view, Mode mode,
                          std::span<PassageSum> sums);

/// The same with AVX2's instructions.
void walk_packet_passages_avx2(const BenchMesh& mesh, const BenchView& view, Mode mode,
                               std::span<PassageSum> sums);

/// Through compact tetrahedra.
void walk_compact_passages(const BenchMesh& mesh, const BenchView& view, Mode mode,
                           std::span<PassageSum> sums);
void walk_compact_passages_avx2(const BenchMesh& mesh, const BenchView& view, Mode mode,
                                std::span<PassageSum> sums);

/// Whether the processor has wider ones.
bool packets_have_more_than_avx2();

}  // namespace plume::bench
