#include "plume/tests/bench/interleaved.h"

#include "plume/tests/bench/timing.h"

namespace plume::bench {

std::vector<WalkerTimes> measure(const BenchMesh& mesh, const std::vector<BenchView>& views,
                                 Mode mode, int rounds) {
  std::vector<WalkerTimes> times;
  for (const BenchWalker& walker : walkers())
    if (walker.has(mode))
      times.push_back(
          {&walker, 0, std::vector<double>(static_cast<std::size_t>(rounds), 0), 0, {}});

  for (const BenchView& view : views) {
    std::vector<PassageSum> right(view.passages.size()), sums(view.passages.size());
    reference().walk(mesh, view, mode, right);
    std::vector<std::vector<double>> taken(times.size());
    for (std::size_t round = 0; round < static_cast<std::size_t>(rounds); ++round)
      for (std::size_t w = 0; w < times.size(); ++w) {
        WalkerTimes& one = times[w];
        if (!one.problem.empty()) continue;
        const double start = thread_seconds();
        one.walker->walk(mesh, view, mode, sums);
        taken[w].push_back(thread_seconds() - start);
        one.rounds[round] += taken[w].back();
        if (round > 0) continue;
        for (const PassageSum& sum : sums) one.cells += sum.cells;
        one.problem = problem(*one.walker, mode, compare(mesh, mode, right, sums));
        if (!one.problem.empty()) one.problem += " (view " + view.name + ")";
      }
    for (std::size_t w = 0; w < times.size(); ++w)
      if (times[w].problem.empty()) times[w].seconds += median(taken[w]);
  }
  return times;
}

}  // namespace plume::bench
