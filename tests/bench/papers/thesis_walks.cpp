// The thesis' tables of cells a second: 6.1, 6.2 and 6.5.

#include <fmt/format.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plume/mesh/error.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/papers/naive_plucker.h"
#include "plume/tests/bench/papers/paper_tables.h"
#include "plume/tests/bench/papers/thesis_meshes.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string rate(double value) { return fmt::format("{:.1f}", value); }
std::string times(double value) { return fmt::format("{:.2f}", value); }

// A data set with its four views, or nothing where it is absent.
struct Viewed {
  BenchMesh mesh;
  std::vector<BenchView> views;
};
std::optional<Viewed> viewed(const ThesisMesh& source, const PaperOptions& options) {
  const std::optional<Mesh> mesh = source.load();
  if (!mesh) return std::nullopt;
  Viewed made{make_bench_mesh(*mesh, source.family), {}};
  made.views = make_views(made.mesh, options.quick ? 24 : 512);
  drop_lost(made.mesh, made.views);
  return made;
}

// Million cells a second by walker, of those that are named.
std::map<std::string, double> rates(const Viewed& viewed, Mode mode,
                                    const std::vector<std::string>& names,
                                    const PaperOptions& options) {
  std::map<std::string, double> made;
  const ModeTimes measured = measure(viewed.mesh, viewed.views, mode, options.rounds, names);
  for (const WalkerTimes& times : measured.walkers) {
    if (!times.problem.empty()) throw Error("not the same work: " + times.problem);
    made[times.walker->name] = times.million_cells_per_second();
  }
  return made;
}

constexpr const char* kViews = R"(
Here: one thread; four views of 512 x 512 pixels, along the axes and from a corner; first hits not included, as what is
counted are cells that are walked through; medians.
)";

}  // namespace

std::string thesis_table_6_1(const PaperOptions& options) {
  struct Theirs {
    const char *naive_tests, *naive_rate, *optimised_tests, *optimised_rate;
  };
  constexpr Theirs kTheirs[] = {{"4.714", "9.346", "2.669", "17.106"},
                                {"4.976", "9.615", "2.675", "17.101"},
                                {"5.373", "9.615", "2.663", "17.612"}};
  Rows rows{{"data set", "thesis, naive: tests a cell", "M cells/s", "optimised: tests",
             "M cells/s", "ratio", "here, naive: tests", "M cells/s", "optimised: tests",
             "M cells/s", "ratio", "Plume, packets", "x optimised"}};
  std::size_t row = 0;
  for (const ThesisMesh& source : thesis_meshes(Family::tetrahedra, options.quick)) {
    const Theirs& theirs = kTheirs[row++];
    const std::optional<Viewed> made = viewed(source, options);
    const std::vector<std::string> of_thesis{
        source.name,
        theirs.naive_tests,
        theirs.naive_rate,
        theirs.optimised_tests,
        theirs.optimised_rate,
        times(std::stod(theirs.optimised_rate) / std::stod(theirs.naive_rate))};
    if (!made) {
      rows.push_back(without_data(of_thesis, rows.front().size()));
      continue;
    }
    PluckerCounts naive, optimised;
    double naive_seconds = 0, optimised_seconds = 0, packet_seconds = 0;
    for (const BenchView& view : made->views) {
      const PluckerCounts by_naive = count_naive_tests(made->mesh, view);
      const PluckerCounts by_optimised = count_optimised_tests(made->mesh, view);
      for (auto [sum, more] : {std::pair{&naive, by_naive}, {&optimised, by_optimised}}) {
        sum->cells += more.cells;
        sum->tests += more.tests;
      }
      std::vector<PassageSum> sums(view.passages.size());
      const auto by = [&](const char* name) -> std::function<void()> {
        for (const BenchWalker& walker : walkers(Family::tetrahedra))
          if (walker.name == name)
            return [&, walk = walker.walk] { walk(made->mesh, view, Mode::cells, sums); };
        throw Error(std::string("there is no walker ") + name);
      };
      const std::vector<std::function<void()>> tasks{
          [&] { walk_naive_plucker(made->mesh, view, sums); }, by("plucker"), by("tet-packets")};
      const auto seconds = take_turns(tasks, options.rounds);
      naive_seconds += median(seconds[0]);
      optimised_seconds += median(seconds[1]);
      packet_seconds += median(seconds[2]);
    }
    // On a vertex or an edge the two may take another way round.
    const double more = static_cast<double>(naive.cells) / static_cast<double>(optimised.cells);
    if (!(more > 0.99 && more < 1.01))
      throw Error(fmt::format("the naive walk meets {} cells of {}, the optimised one {}",
                              naive.cells, source.name, optimised.cells));
    const auto rate_of = [&](double seconds) {
      return 1e-6 * static_cast<double>(optimised.cells) / seconds;
    };
    rows.push_back(of_thesis);
    for (const std::string& ours :
         {fmt::format("{:.3f}", naive.tests_per_cell()), rate(rate_of(naive_seconds)),
          fmt::format("{:.3f}", optimised.tests_per_cell()), rate(rate_of(optimised_seconds)),
          times(naive_seconds / optimised_seconds), rate(rate_of(packet_seconds)),
          times(optimised_seconds / packet_seconds)})
      rows.back().push_back(ours);
  }
  return std::string(
             "Page 137. Thesis: 3 GHz Athlon64, 2 GB memory; \"the optimized approach reduces the "
             "number of tests\".") +
         kViews +
         R"(Naive and optimised are the thesis' algorithms, written anew (`naive_plucker.h`, `plucker_walker.h`). The thesis does
not say when it gives up on a face; here at the first product of the wrong sign. Packets: Plume's, which decide by
windings and make no Plücker tests.

)" + markdown_table(rows);
}

std::string thesis_table_6_2(const PaperOptions& options) {
  struct Theirs {
    const char* rates[3];
  };
  constexpr Theirs kTheirs[] = {{{"11.175", "5.394", "4.189"}},
                                {{"10.568", "5.379", "4.020"}},
                                {{"10.514", "5.237", "4.049"}}};
  struct Column {
    const char* name;
    Mode mode;
  };
  constexpr Column kColumns[] = {{"T-Traversal", Mode::cells},
                                 {"iso-surface", Mode::isosurface},
                                 {"semi-transparent", Mode::closed_form}};
  Rows rows{{"data set", "tetrahedra: thesis", "here", "", "thesis, M cells/s", "here, Plücker",
             "Plume, scalar", "packets", "packets x Plücker"}};
  std::size_t row = 0;
  for (const ThesisMesh& source : thesis_meshes(Family::tetrahedra, options.quick)) {
    const Theirs& theirs = kTheirs[row++];
    const std::optional<Viewed> made = viewed(source, options);
    for (std::size_t c = 0; c < 3; ++c) {
      rows.push_back({c == 0 ? source.name : "", c == 0 ? with_commas(source.thesis_cells) : "",
                      c == 0 && made ? with_commas(made->mesh.cell_count) : "", kColumns[c].name,
                      theirs.rates[c]});
      if (!made) {
        rows.back() = without_data(rows.back(), rows.front().size());
        continue;
      }
      auto by = rates(*made, kColumns[c].mode, {"plucker", "tet-walker", "tet-packets"}, options);
      for (const std::string& ours :
           {rate(by["plucker"]), rate(by["tet-walker"]), rate(by["tet-packets"]),
            times(by["tet-packets"] / by["plucker"])})
        rows.back().push_back(ours);
    }
  }
  return std::string(
             "Page 142. The thesis' caption names no hardware; table 6.5, its counterpart for "
             "hexahedra, "
             "is from a 3 GHz Athlon64\nwith 2 GB, tables 6.3 and 6.4 from 2 GHz Opteron 870.") +
         kViews +
         R"(Plücker: the thesis' walker, written anew. Semi-transparent: emission and absorption by a transfer function of 8 knots,
integrated in closed form, for all of them, and no early end; the thesis does not say what it integrates by.

)" + markdown_table(rows);
}

std::string thesis_table_6_5(const PaperOptions& options) {
  struct Theirs {
    const char *plucker, *hybrid;
  };
  constexpr Theirs kTheirs[2][3] = {{{"7.49", "7.58"}, {"3.15", "5.46"}, {"2.21", "3.17"}},
                                    {{"8.44", "8.83"}, {"2.83", "4.49"}, {"2.12", "3.45"}}};
  struct Column {
    const char* name;
    Mode mode;
  };
  constexpr Column kColumns[] = {{"H-Marching", Mode::cells},
                                 {"iso-surface", Mode::isosurface},
                                 {"semi-transparent", Mode::closed_form}};
  Rows rows{{"data set", "", "thesis, M cells/s: Plücker", "hybrid", "here: Plücker", "hybrid",
             "Plume, scalar", "packets", "packets x hybrid"}};
  std::size_t row = 0;
  for (const ThesisMesh& source : thesis_meshes(Family::hexahedra, options.quick)) {
    const auto& theirs = kTheirs[row++];
    const std::optional<Viewed> made = viewed(source, options);
    for (std::size_t c = 0; c < 3; ++c) {
      rows.push_back(
          {c == 0 ? source.name : "", kColumns[c].name, theirs[c].plucker, theirs[c].hybrid});
      if (!made) {
        rows.back() = without_data(rows.back(), rows.front().size());
        continue;
      }
      auto by = rates(*made, kColumns[c].mode, {"plucker", "hybrid", "grid-walker", "grid-packets"},
                      options);
      for (const std::string& ours :
           {rate(by["plucker"]), rate(by["hybrid"]), rate(by["grid-walker"]),
            rate(by["grid-packets"]), times(by["grid-packets"] / by["hybrid"])})
        rows.back().push_back(ours);
    }
  }
  return std::string("Page 151. Thesis: 3 GHz Athlon64, 2 GB memory.") + kViews +
         R"(Plücker and hybrid: faces of two triangles, and of bilinear patches whose grazes count as missed, walked by Plume's rule,
which measures one face where the thesis tries up to three (`PluckerGridWalker`, `HybridGridWalker`). Semi-transparent:
as in table 6.2. Where the two surfaces differ, passages that are not as long in both are left out.

)" + markdown_table(rows);
}

}  // namespace plume::bench
