/// Measuring walkers against each other on a machine that is never quiet.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "plume/tests/bench/agreement.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {

/// Does the tasks in turns (A B A B ...), so that whatever slows the machine down slows all of
/// them. Seconds by task and round, of this thread's time on the processor or of another clock
/// (timing.h): what several threads do takes the wall's.
std::vector<std::vector<double>> take_turns(std::span<const std::function<void()>> tasks,
                                            int rounds, double (*clock)() = thread_seconds);

struct WalkerTimes {
  const BenchWalker* walker = nullptr;
  /// Cells met in all views.
  std::uint64_t cells = 0;
  /// Seconds of each round, over all views.
  std::vector<double> rounds;
  /// By view: million cells a second, by the median of the rounds.
  std::vector<double> views;
  /// The medians of the rounds' seconds for each view, added up.
  double seconds = 0;
  /// Not the same work as the reference's: the times mean nothing then.
  std::string problem;

  double million_cells_per_second() const { return static_cast<double>(cells) / seconds * 1e-6; }
};

struct ModeTimes {
  std::vector<WalkerTimes> walkers;
  /// The family's baseline as it counts cells (Mode::cells), in the same turns: the speed of a
  /// machine drifts between modes that are measured one after the other.
  WalkerTimes walk;
};

/// Times all walkers of the mesh's family that have the mode, or those of them that are named, and
/// the baseline's walk alone, view by view, in turns. Before that, each walks once, which is
/// compared with the reference.
ModeTimes measure(const BenchMesh& mesh, const std::vector<BenchView>& views, Mode mode, int rounds,
                  const std::vector<std::string>& names = {});

}  // namespace plume::bench
