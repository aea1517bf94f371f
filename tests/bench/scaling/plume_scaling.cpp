// How cost grows: plume_scaling. See --help.

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "plume/mesh/error.h"
#include "plume/tests/bench/measured_on.h"
#include "plume/tests/bench/scaling/scaling_series.h"

namespace {

using plume::bench::ScalingAxis;
using plume::bench::ScalingOptions;
using plume::bench::ScalingSeries;

constexpr const char* kHelp =
    R"(plume_scaling: cost and memory against cells, pixels, threads, knots and depth complexity

  plume_scaling AXIS...  of: cells, pixels, threads, knots, depth
  plume_scaling all      the page docs/scaling.md

  --large       up to 5e7 cells instead of 1e7: some 12 GB
  --rounds=N    how often each is measured (3); medians are reported
  --quick       a few small points, once: to see that it runs; the numbers say nothing
  --csv=FILE    writes the points there, too: axis,series,x,quantity,value
  -o FILE       writes what is printed there, too
)";

constexpr const char* kIntroduction = R"(# How cost grows

Made by

    {}

and measured on: {}.{} All meshes are generated. Times of frames on one thread are this thread's on the processor, medians;
a volume of seven knots in closed form, order 1, whole rays (no early termination), first hits included.

Exponents are those of least squares in log-log over all points of a table, with their standard error; beneath, the
least and the greatest exponent between neighbouring points. An exponent is of the range that the table has, no law
beyond it.
)";

const ScalingAxis* named(const std::string& name) {
  for (const ScalingAxis& axis : plume::bench::scaling_axes())
    if (axis.name == name) return &axis;
  return nullptr;
}

// Text that goes to a file as well, where there is one.
class Output {
 public:
  bool open(const std::string& name) {
    name_ = name;
    file_.open(name);
    return good();
  }
  void add(const std::string& text) {
    if (file_.is_open()) file_ << text << std::flush;
  }
  bool good() const {
    if (file_.good()) return true;
    std::fprintf(stderr, "plume_scaling: cannot write %s\n", name_.c_str());
    return false;
  }

 private:
  std::string name_;
  std::ofstream file_;
};

}  // namespace

int main(int argc, char** argv) {
  ScalingOptions options;
  std::vector<const ScalingAxis*> wanted;
  std::string command = "build/bin/plume_scaling";
  Output csv, page;
  int rounds = 0;
  bool all = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "-o" && i + 1 < argc) {
      if (!page.open(argv[++i])) return 1;
      continue;
    }
    if (argument.rfind("--csv=", 0) == 0) {
      if (!csv.open(argument.substr(6))) return 1;
      continue;
    }
    command += ' ' + argument;
    if (argument == "--quick") {
      options.quick = true;
    } else if (argument == "--large") {
      options.large = true;
    } else if (argument.rfind("--rounds=", 0) == 0 && std::atoi(argument.c_str() + 9) > 0) {
      rounds = std::atoi(argument.c_str() + 9);
    } else if (argument == "all") {
      all = true;
    } else if (const ScalingAxis* axis = named(argument)) {
      wanted.push_back(axis);
    } else {
      std::fputs(kHelp, argument == "--help" ? stdout : stderr);
      return argument == "--help" ? 0 : 2;
    }
  }
  if (all) {
    wanted.clear();
    for (const ScalingAxis& axis : plume::bench::scaling_axes()) wanted.push_back(&axis);
  }
  if (wanted.empty()) {
    std::fputs(kHelp, stderr);
    return 2;
  }
  options.rounds = rounds > 0 ? rounds : options.quick ? 1 : 3;
  const auto print = [&page](const std::string& text) {
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
    page.add(text);
  };
  try {
    print(fmt::format(kIntroduction, command, plume::bench::measured_on(),
                      options.quick ? " **With --quick: the numbers say nothing.**" : ""));
    csv.add("axis,series,x,quantity,value\n");
    std::vector<ScalingSeries> everything;
    for (const ScalingAxis* axis : wanted) {
      print(fmt::format("\n## {}\n\n{}\n", axis->name, axis->what));
      axis->measure(options, [&](const ScalingSeries& series) {
        print(fmt::format("\n### {}: {}\n\n{}", axis->name, series.name, as_markdown(series)));
        csv.add(as_csv(series));
        everything.push_back(series);
      });
    }
    print("\n## All exponents\n\n" + exponents_as_markdown(everything));
  } catch (const plume::Error& error) {
    std::fprintf(stderr, "plume_scaling: %s\n", error.what());
    return 1;
  }
  return page.good() && csv.good() ? 0 : 1;
}
