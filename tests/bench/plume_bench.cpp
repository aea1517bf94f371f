// The benchmarks: `./dev bench`. See --help.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "plume/mesh/error.h"
#include "plume/tests/bench/build_bench.h"
#include "plume/tests/bench/cells_bench.h"
#include "plume/tests/bench/regular_bench.h"
#include "plume/tests/bench/result_table.h"
#include "plume/tests/bench/walker_bench.h"

namespace {

constexpr const char* kHelp = R"(plume_bench: how fast Plume is, as ratios within one run

  --all          all rays, and meshes of 10 and 50 million cells: some 10 GB and twenty minutes;
                 without, it takes some three minutes
  --rounds=N     how many times each is measured (3; with --all 5); medians are reported
  --resolution=N pixels along each side of a view, instead of what each mesh has
  --table        ends with a plain table (beside the thesis' numbers: plume_papers)
  --benchmark_filter=REGEX, --benchmark_out=FILE, --benchmark_format=json, ...
                 Google Benchmark's own
The blunt fin is read from the directory PLUME_DATASETS, by default ../shared/datasets.
)";

}  // namespace

int main(int argc, char** argv) {
  plume::bench::WalkerBenchOptions options;
  bool table = false;
  int rounds = 0;
  std::vector<char*> rest{argv[0]};
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--help" || argument == "-h") {
      std::fputs(kHelp, stdout);
      return 0;
    }
    if (argument == "--all")
      options.all = true;
    else if (argument == "--table")
      table = true;
    else if (argument.rfind("--rounds=", 0) == 0)
      rounds = std::atoi(argument.c_str() + 9);
    else if (argument.rfind("--resolution=", 0) == 0)
      options.resolution = std::atoi(argument.c_str() + 13);
    else
      rest.push_back(argv[i]);
  }
  options.rounds = rounds > 0 ? rounds : options.all ? 5 : 3;
  int count = static_cast<int>(rest.size());
  rest.push_back(nullptr);
  benchmark::Initialize(&count, rest.data());
  if (benchmark::ReportUnrecognizedArguments(count, rest.data())) return 1;
  try {
    plume::bench::register_build_benchmarks({options.all, options.rounds});
    plume::bench::register_walker_benchmarks(options);
    plume::bench::register_cells_benchmarks({options.rounds, options.resolution});
    plume::bench::register_regular_benchmarks(options.rounds);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const plume::Error& error) {
    std::fprintf(stderr, "plume_bench: %s\n", error.what());
    return 1;
  }
  benchmark::Shutdown();
  if (table) {
    std::fputs(plume::bench::result_table(plume::bench::walker_results()).c_str(), stdout);
    std::fputs(plume::bench::cells_table(plume::bench::cells_results()).c_str(), stdout);
  }
  const bool failed = plume::bench::walker_bench_failed() || plume::bench::build_bench_failed() ||
                      plume::bench::cells_bench_failed() || plume::bench::regular_bench_failed();
  return failed ? 1 : 0;
}
