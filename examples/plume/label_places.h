/// Where labels of a chart stand so that they can be read.
#pragma once

#include <string>
#include <vector>

namespace plume::command {

/// A rectangle in pixels, y downwards.
struct LabelBox {
  double left, top, width, height;
};
bool overlap(const LabelBox& a, const LabelBox& b);

/// A place of the chart, pixels, y downwards.
struct ChartPlace {
  double x, y;
};

/// Places for labels of the points of a Pareto front (x and y ascending in pixels: slower and more
/// exact), which end `gap` to the left of their points: at their height, or further down until they
/// are clear of the label before. Left of a point and below it there is no other point and no line
/// of the front, else the point would not be on it. `widths` are those of the labels.
std::vector<LabelBox> front_label_places(const std::vector<ChartPlace>& points,
                                         const std::vector<double>& widths, double height,
                                         double gap);

/// Places for small labels around points of any kind: for each the first of eight places beside its
/// point that is inside of `area` and clear of `taken` and of those before; where all are taken,
/// the one that overlaps least. Appends what it takes to `taken`.
std::vector<LabelBox> label_places(const std::vector<ChartPlace>& points,
                                   const std::vector<double>& widths, double height, double gap,
                                   const LabelBox& area, std::vector<LabelBox>& taken);

}  // namespace plume::command
