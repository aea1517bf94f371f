/// The walkers that are timed against each other.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/bench_views.h"
#include "plume/tests/bench/passage_consumers.h"

namespace plume::bench {

/// What is asked of all walkers: the passages of a view, in any order, on one thread. What a ray
/// needs before it can be walked (its frame, the products of its first face) is part of the task;
/// finding where it enters is not.
using WalkPassages = void (*)(const BenchMesh& mesh, const BenchView& view, Mode mode,
                              std::span<PassageSum> sums);

/// How near a walker comes to the reference.
enum class Likeness : std::uint8_t {
  exact,     ///< meets the same cells, all of them, on any ray; where it does not, it is told
  rounding,  ///< the same but for rounding
  surface,   ///< takes twisted faces for another surface: passages have the same length, or nearly
};

struct BenchWalker {
  std::string name;
  WalkPassages walk;
  std::vector<Mode> modes;
  Likeness likeness;
  /// Memory of cells and points, in its own form.
  std::size_t (*bytes)(const BenchMesh& mesh);

  bool has(Mode mode) const;
};

/// Those of a family. The baseline first, what is compared with second. To add a walker, add a
/// line. Of tetrahedra, the baseline is the thesis' Plücker walker; of hexahedra, the scalar twin
/// of its hybrid; of cells it is the reference itself, the only one there is.
const std::vector<BenchWalker>& walkers(Family family = Family::tetrahedra);
const BenchWalker& baseline(Family family = Family::tetrahedra);
const BenchWalker& reference(Family family = Family::tetrahedra);

}  // namespace plume::bench
