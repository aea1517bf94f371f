#include "plume/tests/bench/scaling/scaling_series.h"

#include <fmt/format.h>

#include <optional>

#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/scaling/power_law.h"

namespace plume::bench {
namespace {

std::string number(double value) { return fmt::format("{:.4g}", value); }

// Counts in full, other numbers in four digits.
std::string place(double x) {
  return x == static_cast<double>(static_cast<long long>(x)) ? fmt::format("{:.0f}", x) : number(x);
}

std::optional<PowerLaw> law_of(const ScalingSeries& series, std::size_t quantity) {
  std::vector<double> x, y;
  for (const auto& point : series.points) {
    x.push_back(point.x);
    y.push_back(point.values[quantity]);
  }
  return fit_power_law(x, y);
}

std::string exponent_of(const std::optional<PowerLaw>& law) {
  if (!law) return "-";
  return law->error ? fmt::format("**{:.3f}** ± {:.3f}", law->exponent, *law->error)
                    : fmt::format("**{:.3f}**", law->exponent);
}

std::string range_of(const std::optional<PowerLaw>& law) {
  return law ? fmt::format("{:.2f} to {:.2f}", law->least, law->most) : "-";
}

}  // namespace

std::string as_markdown(const ScalingSeries& series) {
  std::vector<std::vector<std::string>> rows{{series.variable}};
  for (const auto& point : series.points) {
    rows.push_back({place(point.x)});
    for (const double value : point.values) rows.back().push_back(number(value));
  }
  std::vector<std::string> exponents{"**exponent**"}, range{"from point to point"};
  for (std::size_t q = 0; q < series.quantities.size(); ++q) {
    rows.front().push_back(series.quantities[q]);
    const auto law = law_of(series, q);
    exponents.push_back(exponent_of(law));
    range.push_back(range_of(law));
  }
  rows.push_back(exponents);
  rows.push_back(range);
  return markdown_table(rows);
}

std::string exponents_as_markdown(const std::vector<ScalingSeries>& all) {
  std::vector<std::vector<std::string>> rows{
      {"of", "quantity", "over", "from", "to", "exponent", "from point to point"}};
  for (const ScalingSeries& series : all)
    for (std::size_t q = 0; q < series.quantities.size(); ++q) {
      const auto law = law_of(series, q);
      rows.push_back({q == 0 ? series.name : "", series.quantities[q], series.variable,
                      place(series.points.front().x), place(series.points.back().x),
                      exponent_of(law), range_of(law)});
    }
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
