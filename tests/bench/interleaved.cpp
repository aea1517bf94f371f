#include "plume/tests/bench/interleaved.h"

#include <algorithm>
#include <utility>

#include "plume/tests/bench/timing.h"

namespace plume::bench {

std::vector<std::vector<double>> take_turns(std::span<const std::function<void()>> tasks,
                                            int rounds, double (*clock)()) {
  std::vector<std::vector<double>> seconds(tasks.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      const double start = clock();
      tasks[task]();
      seconds[task].push_back(clock() - start);
    }
  return seconds;
}

ModeTimes measure(const BenchMesh& mesh, const std::vector<BenchView>& views, Mode mode, int rounds,
                  const std::vector<std::string>& names) {
  const std::vector<double> no_rounds(static_cast<std::size_t>(rounds), 0);
  std::vector<WalkerTimes> times;
  WalkerTimes walk{&baseline(mesh.family), 0, no_rounds, {}, 0, {}};
  for (const BenchWalker& walker : walkers(mesh.family))
    if (walker.has(mode) &&
        (names.empty() || std::find(names.begin(), names.end(), walker.name) != names.end()))
      times.push_back({&walker, 0, no_rounds, {}, 0, {}});

  for (const BenchView& view : views) {
    std::vector<PassageSum> right(view.passages.size()), sums(view.passages.size());
    reference(mesh.family).walk(mesh, view, mode, right);
    std::vector<std::function<void()>> tasks;
    std::vector<WalkerTimes*> of_task;
    const auto count_cells = [&sums] {
      std::uint64_t cells = 0;
      for (const PassageSum& sum : sums) cells += sum.cells;
      return cells;
    };
    const auto add_task = [&](WalkerTimes& one, Mode walked) {
      const std::uint64_t cells = count_cells();
      one.cells += cells;
      one.views.push_back(1e-6 * static_cast<double>(cells));
      of_task.push_back(&one);
      tasks.emplace_back(
          [&, walker = one.walker, walked] { walker->walk(mesh, view, walked, sums); });
    };
    walk.walker->walk(mesh, view, Mode::cells, sums);
    add_task(walk, Mode::cells);
    for (WalkerTimes& one : times) {
      if (!one.problem.empty()) continue;
      one.walker->walk(mesh, view, mode, sums);
      one.problem = problem(*one.walker, mesh, mode, right, sums);
      if (one.problem.empty())
        add_task(one, mode);
      else
        one.problem += " (view " + view.name + ")";
    }
    const auto taken = take_turns(tasks, rounds);
    for (std::size_t task = 0; task < tasks.size(); ++task) {
      of_task[task]->seconds += median(taken[task]);
      of_task[task]->views.back() /= median(taken[task]);
      for (std::size_t round = 0; round < taken[task].size(); ++round)
        of_task[task]->rounds[round] += taken[task][round];
    }
  }
  return {std::move(times), std::move(walk)};
}

}  // namespace plume::bench
