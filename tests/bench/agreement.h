/// Whether walkers that are timed against each other have done the same work.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plume/tests/bench/bench_walkers.h"

namespace plume::bench {

/// A walker's sums against the reference's, passage by passage.
struct Agreement {
  /// As many cells, and the same sums.
  std::size_t same = 0;
  /// Another number of cells, but the same sums: near an edge, rounding went around its other side.
  std::size_t other_way = 0;
  /// Other sums: these passages have left their ray.
  std::vector<std::uint32_t> different;

  std::size_t total() const { return same + other_way + different.size(); }
};

/// Lengths are the same within 1e-4 of the bounds' diagonal, integrals within that times the
/// largest scalar, transmittance and colours within 2e-3 (the table's entries are that far apart),
/// within 1e-4 in closed form. With `lengths_alone` nothing but PassageSum::first counts.
Agreement compare(const BenchMesh& mesh, Mode mode, std::span<const PassageSum> reference,
                  std::span<const PassageSum> sums, bool lengths_alone = false);

/// What is wrong with that, in one line; empty where nothing is. An exact walker must agree in
/// every passage; but rounding of the scalar may move an isovalue's place across a face, in one
/// passage of ten thousand. Of another walker, one passage in a hundred may go astray: more than
/// that is no rounding.
std::string problem(const BenchWalker& walker, Family family, Mode mode,
                    const Agreement& agreement);

/// The same of a walker's sums, of any likeness. Where a walker takes faces for another surface,
/// passages are compared by their lengths (Mode::integral); in the other modes all of a view
/// together: as many cells within a third (two triangles are grazed more often than a patch),
/// PassageSum::first within a twentieth (their scalar has a crease across a face), but for
/// isosurfaces, which a ray that just touches them meets in one and not in the other.
std::string problem(const BenchWalker& walker, const BenchMesh& mesh, Mode mode,
                    std::span<const PassageSum> reference, std::span<const PassageSum> sums);

/// Takes out of the views the passages that a walker loses, so that all walkers are timed on the
/// same work; of those that take faces for another surface, the passages that are longer or shorter
/// there. What is returned counts all that there were, by what the baseline made of them.
Agreement drop_lost(const BenchMesh& mesh, std::vector<BenchView>& views);

}  // namespace plume::bench
