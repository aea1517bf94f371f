// Every way to integrate a segment, its error and its time: plume_integrator_bench. See --help.

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "plume/tests/bench/integrator_errors.h"

namespace {

constexpr const char* kHelp =
    R"(plume_integrator_bench: what the integrators are off by, and what they cost

  --segments=N   segments for each transfer function (2800)
  --rounds=N     how often each is timed, in turns (15); medians are reported
  --seed=N       of the segments (1)
  --quick        without the larger tables
  -o FILE        writes the tables as markdown there as well
)";

}  // namespace

int main(int argc, char** argv) {
  plume::bench::IntegratorBenchOptions options;
  std::string output;
  const auto number = [](const std::string& argument, const std::string& name, auto& value) {
    if (argument.rfind(name, 0) != 0) return false;
    const long given = std::atol(argument.c_str() + name.size());
    value = static_cast<std::decay_t<decltype(value)>>(given);
    return given > 0;
  };
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") {
      options.quick = true;
    } else if (argument == "-o" && i + 1 < argc) {
      output = argv[++i];
    } else if (!number(argument, "--segments=", options.segments) &&
               !number(argument, "--rounds=", options.rounds) &&
               !number(argument, "--seed=", options.seed)) {
      std::fputs(kHelp, argument == "--help" ? stdout : stderr);
      return argument == "--help" ? 0 : 2;
    }
  }
  std::string all;
  for (const auto table : {plume::bench::integrator_errors, plume::bench::integrator_costs,
                           plume::bench::second_order_errors}) {
    const std::string text = table(options) + '\n';
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
    all += text;
  }
  if (output.empty()) return 0;
  all.pop_back();
  std::ofstream file(output);
  if (!(file << all) || !file.flush()) {
    std::fprintf(stderr, "plume_integrator_bench: cannot write %s\n", output.c_str());
    return 1;
  }
  return 0;
}
