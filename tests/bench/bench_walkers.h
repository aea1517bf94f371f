/// The walkers that are timed against each other.
#pragma once

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

struct BenchWalker {
  std::string name;
  WalkPassages walk;
  std::vector<Mode> modes;
  /// Meets the cells that TetWalker meets, all of them, on any ray. Where it does not, it is told.
  bool exact;
  /// Memory of cells and points, in its own form.
  std::size_t (*bytes)(const BenchMesh& mesh);

  bool has(Mode mode) const;
};

/// The baseline first, what is compared with second. To add a walker, add a line.
const std::vector<BenchWalker>& walkers();
inline const BenchWalker& baseline() { return walkers()[0]; }
inline const BenchWalker& reference() { return walkers()[1]; }

}  // namespace plume::bench
