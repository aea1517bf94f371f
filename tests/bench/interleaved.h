/// Measuring walkers against each other on a machine that is never quiet.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plume/tests/bench/agreement.h"

namespace plume::bench {

struct WalkerTimes {
  const BenchWalker* walker = nullptr;
  /// Cells met in all views.
  std::uint64_t cells = 0;
  /// Seconds of each round, over all views.
  std::vector<double> rounds;
  /// The medians of the rounds' seconds for each view, added up.
  double seconds = 0;
  /// Not the same work as the reference's: the times mean nothing then.
  std::string problem;

  double million_cells_per_second() const { return static_cast<double>(cells) / seconds * 1e-6; }
};

/// Times all walkers that have the mode. For each view, walkers take turns (A B A B ...), so that
/// whatever slows the machine down slows all of them; time is this thread's time on the processor.
/// What a walker came to in its first round is compared with the reference.
std::vector<WalkerTimes> measure(const BenchMesh& mesh, const std::vector<BenchView>& views,
                                 Mode mode, int rounds);

}  // namespace plume::bench
