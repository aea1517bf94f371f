/// How cost grows: what plume_scaling measures.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace plume::bench {

struct ScalingOptions {
  /// A few small points, each measured once: to see that all of it runs.
  bool quick = false;
  /// Up to 5e7 cells instead of 1e7: some 12 GB.
  bool large = false;
  /// How often each point is measured; medians are reported.
  int rounds = 3;
};

/// Points of some quantities over one variable.
struct ScalingSeries {
  std::string axis;                     ///< "cells", "pixels", ...: what is varied
  std::string name;                     ///< of what: "tetrahedra", ...
  std::string variable;                 ///< over which exponents are fitted, with its unit
  std::vector<std::string> quantities;  ///< with their units
  struct Point {
    double x;
    std::vector<double> values;  ///< as many as there are quantities
  };
  std::vector<Point> points;  ///< x ascending
};

/// A table of the points, then rows with each quantity's exponent, its standard error, and the
/// least and the greatest exponent between neighbouring points.
std::string as_markdown(const ScalingSeries& series);

/// A table of the exponents of all series, and what they are fitted over.
std::string exponents_as_markdown(const std::vector<ScalingSeries>& all);

/// One line a value: axis,series,x,quantity,value. No header.
std::string as_csv(const ScalingSeries& series);

/// Called with each series as soon as it is measured: the long runs may be cut short.
using SeriesMade = std::function<void(const ScalingSeries& series)>;

struct ScalingAxis {
  std::string name;
  /// What is varied and what is not, in markdown.
  std::string what;
  void (*measure)(const ScalingOptions& options, const SeriesMade& made);
};
const std::vector<ScalingAxis>& scaling_axes();

void scale_cells(const ScalingOptions& options, const SeriesMade& made);
void scale_pixels(const ScalingOptions& options, const SeriesMade& made);
void scale_threads(const ScalingOptions& options, const SeriesMade& made);
void scale_knots(const ScalingOptions& options, const SeriesMade& made);
void scale_depth(const ScalingOptions& options, const SeriesMade& made);

}  // namespace plume::bench
