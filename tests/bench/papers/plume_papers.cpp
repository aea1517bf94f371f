// The papers' tables, theirs beside ours: plume_papers. See --help.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "plume/mesh/error.h"
#include "plume/tests/bench/measured_on.h"
#include "plume/tests/bench/papers/paper_tables.h"

namespace {

using plume::bench::PaperOptions;
using plume::bench::PaperTable;

constexpr const char* kHelp =
    R"(plume_papers: the tables of the papers that Plume builds on, theirs beside ours

  plume_papers TABLE...   measures and prints these tables, as markdown
  plume_papers all        the page docs/papers.md
  plume_papers --list     their names

  --rounds=N   how often each is measured, in turns (3); medians are reported
  --quick      tiny pictures and meshes: to see that it runs; the numbers say nothing
  -o FILE      writes what is printed there as well
The blunt fin and the combustor are read from the directory PLUME_DATASETS, by default
../shared/datasets; tables go without them where they are absent, and say so.
)";

constexpr const char* kIntroduction = R"(# The papers' tables

What the papers that Plume builds on report, beside what Plume comes to. Made by

    {}

and measured on: {}.{} Each table alone: `build/bin/plume_papers --list`.

**Ratios between their hardware and this are no measure of a method.** Where the method itself is at hand, written
anew, it is measured here in the same run, and the ratio to that is given: tables 4.5, 6.1, 6.2 and 6.5, figures 7 to 9.
Of the data sets, the blunt fin and the combustor are the papers' own. For the others, which are not public or not at
hand, stand-ins of about the same size are made from formulas (`tests/bench/papers/stand_in_fields.cpp`); tables mark
them with an asterisk.

Thesis: G. Marmitt, "Interactive Volume Ray Tracing" (Saarland University, 2008). El Hajjar et al.: "Second Order
Pre-Integrated Volume Rendering" (PacificVis 2008). Ament et al.: "Direct Interval Volume Visualization" (TVCG 2010).
Theirs is quoted as printed.
)";

const PaperTable* named(const std::string& name) {
  for (const PaperTable& table : plume::bench::paper_tables())
    if (table.name == name) return &table;
  return nullptr;
}

int run(const std::vector<const PaperTable*>& wanted, bool page, const PaperOptions& options,
        const std::string& output, const std::string& command) {
  std::ofstream file;
  if (!output.empty()) {
    file.open(output);
    if (!file) {
      std::fprintf(stderr, "plume_papers: cannot write %s\n", output.c_str());
      return 1;
    }
  }
  const auto print = [&](const std::string& text) {
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
    if (file.is_open()) file << text << std::flush;
  };
  const std::string quick = options.quick ? " **With --quick: the numbers say nothing.**" : "";
  if (page)
    print(fmt::format(kIntroduction, command, plume::bench::measured_on(), quick));
  else
    print(fmt::format("Measured on: {}.{}\n", plume::bench::measured_on(), quick));
  for (const PaperTable* table : wanted)
    print(fmt::format("\n## {}\n\n{}", table->title, table->make(options)));
  if (file.is_open() && !file.flush()) {
    std::fprintf(stderr, "plume_papers: cannot write %s\n", output.c_str());
    return 1;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  PaperOptions options;
  std::vector<const PaperTable*> wanted;
  std::string output, command = "build/bin/plume_papers";
  bool page = false;
  int rounds = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--list") {
      for (const PaperTable& table : plume::bench::paper_tables())
        std::printf("%-14s%s\n", table.name.c_str(), table.title.c_str());
      return 0;
    }
    if (argument == "-o" && i + 1 < argc) {
      output = argv[++i];
      continue;
    }
    command += ' ' + argument;
    if (argument == "--quick") {
      options.quick = true;
    } else if (argument.rfind("--rounds=", 0) == 0 && std::atoi(argument.c_str() + 9) > 0) {
      rounds = std::atoi(argument.c_str() + 9);
    } else if (argument == "all") {
      page = true;
    } else if (const PaperTable* table = named(argument)) {
      wanted.push_back(table);
    } else {
      if (argument == "--help") {
        std::fputs(kHelp, stdout);
        return 0;
      }
      std::fprintf(stderr, "plume_papers: there is no table or option \"%s\"; see --list, --help\n",
                   argument.c_str());
      return 2;
    }
  }
  if (page) {
    wanted.clear();
    for (const PaperTable& table : plume::bench::paper_tables()) wanted.push_back(&table);
  }
  if (wanted.empty()) {
    std::fputs(kHelp, stderr);
    return 2;
  }
  if (rounds > 0)
    options.rounds = rounds;
  else if (options.quick)
    options.rounds = 1;
  try {
    return run(wanted, page, options, output, command);
  } catch (const plume::Error& error) {
    std::fprintf(stderr, "plume_papers: %s\n", error.what());
    return 1;
  }
}
