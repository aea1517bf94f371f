#include "plume/tests/bench/thesis_hexahedra.h"

#include <fmt/format.h>

namespace plume::bench {
namespace {

struct Row {
  const char* mesh;
  const char* name;
  const char* column;
  Mode mode;
  double plucker, hybrid;
};

// G. Marmitt, "Interactive Volume Ray Tracing" (2008), table 6.5.
constexpr Row kRows[] = {{"blunt-fin", "Blunt-fin", "H-Marching", Mode::cells, 7.49, 7.58},
                         {"blunt-fin", "", "iso-surface", Mode::isosurface, 3.15, 5.46},
                         {"blunt-fin", "", "semi-transparent", Mode::closed_form, 2.21, 3.17},
                         {"combustor", "Combustion", "H-Marching", Mode::cells, 8.44, 8.83},
                         {"combustor", "", "iso-surface", Mode::isosurface, 2.83, 4.49},
                         {"combustor", "", "semi-transparent", Mode::closed_form, 2.12, 3.45}};

constexpr const char* kIntroduction = R"(
What the thesis reports in table 6.5, in million hexahedra a second (3 GHz Athlon64, 2 GB memory),
beside what its algorithms, written anew, and packets come to in this run. Semi-transparent is the
closed form here, of 8 knots. Ratios between its hardware and this are no measure of the method: the
column "packets / hybrid" is, measured here. Both grids are the same as the thesis', its views are
four as here, three along the axes and one "perspective position"; more it does not say.

)";

}  // namespace

std::string thesis_hexahedra(const std::vector<WalkerResult>& results) {
  const auto rate = [&results](const Row& row, const char* walker) {
    for (const WalkerResult& r : results)
      if (r.family == Family::hexahedra && r.mesh == row.mesh && r.mode == row.mode &&
          r.walker == walker)
        return r.million_cells_per_second;
    return 0.0;
  };
  const auto number = [](double value) {
    return value > 0 ? fmt::format("{:.2f}", value) : std::string("-");
  };
  std::string text = kIntroduction;
  text +=
      fmt::format("  {:<12}{:<18}{:>17}{:>9}{:>15}{:>9}{:>9}{:>18}\n", "", "", "thesis: Plücker",
                  "hybrid", "here: Plücker", "hybrid", "packets", "packets / hybrid");
  for (const Row& row : kRows) {
    const double hybrid = rate(row, "hybrid"), packets = rate(row, "grid-packets");
    text += fmt::format("  {:<12}{:<18}{:>16.2f}{:>9.2f}{:>14}{:>9}{:>9}{:>18}\n", row.name,
                        row.column, row.plucker, row.hybrid, number(rate(row, "plucker")),
                        number(hybrid), number(packets), number(hybrid > 0 ? packets / hybrid : 0));
  }
  return text;
}

}  // namespace plume::bench
