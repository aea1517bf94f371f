#include "plume/tests/bench/scaling/scaling_series.h"

#include <fmt/format.h>

#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/scaling/power_law.h"

namespace plume::bench {
namespace {

std::string number(double value) { return fmt::format("{:.4g}", value); }

}  // namespace

std::string as_markdown(const ScalingSeries& series) {
  std::vector<std::vector<std::string>> rows{{series.variable}};
  std::vector<double> x;
  for (const auto& point : series.points) {
    x.push_back(point.x);
    // Counts in full, other numbers in four digits.
    rows.push_back({point.x == static_cast<double>(static_cast<long long>(point.x))
                        ? fmt::format("{:.0f}", point.x)
                        : number(point.x)});
    for (const double value : point.values) rows.back().push_back(number(value));
  }
  std::vector<std::string> exponents{"**exponent**"}, range{"from point to point"};
  for (std::size_t q = 0; q < series.quantities.size(); ++q) {
    rows.front().push_back(series.quantities[q]);
    std::vector<double> y;
    for (const auto& point : series.points) y.push_back(point.values[q]);
    const auto law = fit_power_law(x, y);
    exponents.push_back(!law ? "-"
                        : law->error
                            ? fmt::format("**{:.3f}** ± {:.3f}", law->exponent, *law->error)
                            : fmt::format("**{:.3f}**", law->exponent));
    range.push_back(law ? fmt::format("{:.2f} to {:.2f}", law->least, law->most) : "-");
  }
  rows.push_back(exponents);
  rows.push_back(range);
  return markdown_table(rows);
}

std::string as_csv(const ScalingSeries& series) {
  std::string text;
  for (const auto& point : series.points)
    for (std::size_t q = 0; q < series.quantities.size(); ++q)
      text += fmt::format("{},\"{}\",{},\"{}\",{}\n", series.axis, series.name, point.x,
                          series.quantities[q], point.values[q]);
  return text;
}

const std::vector<ScalingAxis>& scaling_axes() {
  static const std::vector<ScalingAxis> axes{
      {"cells",
       "The unit cube in more and more jittered cells; 512 x 512 pixels, one thread for frames, "
       "all for "
       "building. In a\nbox, a ray meets as many cells as the cube root of their number: exponents "
       "of "
       "what a ray costs are 1/3 where a cell\ncosts the same in any mesh. *Peak*: the most that "
       "is "
       "allocated at once while the scene is built, beyond the mesh that it\nis built from; "
       "*kept*: the "
       "walkable form. Neither includes the hierarchy over the boundary, which is Embree's.",
       scale_cells},
      {"pixels",
       "The unit cube in about a million cells, pictures of more and more pixels, one thread.",
       scale_pixels},
      {"threads",
       "1024 x 1024 pixels of the unit cube in about a million cells, and building it, by the "
       "clock; "
       "an exponent of -1 is as\ngood as can be. As many threads as this machine has.",
       scale_threads},
      {"knots",
       "Transfer functions of more and more knots, evenly over the field's range, of random "
       "optics; the "
       "unit cube, 512 x 512\npixels, one thread. A cell of a finer mesh meets fewer knots.",
       scale_knots},
      {"depth",
       "Depth complexity in both senses: *cells a ray*, in a cube that is cut finer and finer "
       "along "
       "the line of sight and not\nacross; and *ways in a ray*, in a cube of a constant number of "
       "cells "
       "that is sliced into more and more slabs with\ngaps between. 512 x 512 pixels, one thread.",
       scale_depth}};
  return axes;
}

}  // namespace plume::bench
