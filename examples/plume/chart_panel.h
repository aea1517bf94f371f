/// A part of a picture with two logarithmic axes.
#pragma once

#include <string>
#include <vector>

#include "label_places.h"
#include "pareto.h"

namespace plume::command {

/// Size of the whole picture, pixels.
inline constexpr double kChartWidth = 1800, kChartHeight = 1000;

/// A rectangle in which milliseconds run to the right and an error upwards, both by decades.
class ChartPanel {
 public:
  /// Fits the axes to points, of which there is one at least.
  ChartPanel(LabelBox area, const std::vector<ChartPoint>& points, ErrorOf error);

  const LabelBox& area() const { return area_; }
  /// Pixels, y downwards; an error of 0 is on the line below the decades.
  ChartPlace place(const ChartPoint& point) const;
  ChartPlace place(double milliseconds, double error) const;
  /// What gnuplot is given in the place of an error: 0 becomes what its line stands for.
  double drawn(double error) const;
  bool has_zero() const { return has_zero_; }

  /// Moves the left edge out until this many pixels are left of that time.
  void make_room(double milliseconds, double pixels);
  /// The same edges of time as another's.
  void share_times(const ChartPanel& other);

  /// Margins, ranges, tics and grid.
  std::string axes(const std::string& title, bool times_labelled) const;

 private:
  LabelBox area_;
  ErrorOf error_;
  double left_, right_, bottom_, top_;  // logarithms to the base of 10
  double lowest_ = 0;                   // the lowest decade, for zeros the one below
  bool has_zero_ = false;
};

}  // namespace plume::command
