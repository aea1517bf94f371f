#include "label_places.h"

#include <algorithm>
#include <array>

namespace plume::command {
namespace {

double shared(double a_low, double a_size, double b_low, double b_size) {
  return std::max(0.0, std::min(a_low + a_size, b_low + b_size) - std::max(a_low, b_low));
}

double shared_area(const LabelBox& a, const LabelBox& b) {
  return shared(a.left, a.width, b.left, b.width) * shared(a.top, a.height, b.top, b.height);
}

// The area that a label there would share with what is taken, or leave to lie outside.
double harm(const LabelBox& box, const LabelBox& area, const std::vector<LabelBox>& taken) {
  double sum = box.width * box.height - shared_area(box, area);
  for (const LabelBox& other : taken) sum += shared_area(box, other);
  return sum;
}

}  // namespace

bool overlap(const LabelBox& a, const LabelBox& b) { return shared_area(a, b) > 0; }

std::vector<LabelBox> front_label_places(const std::vector<ChartPlace>& points,
                                         const std::vector<double>& widths, double height,
                                         double gap) {
  std::vector<LabelBox> boxes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    LabelBox box{points[i].x - gap - widths[i], points[i].y - height / 2, widths[i], height};
    if (!boxes.empty()) box.top = std::max(box.top, boxes.back().top + height);
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<LabelBox> label_places(const std::vector<ChartPlace>& points,
                                   const std::vector<double>& widths, double height, double gap,
                                   const LabelBox& area, std::vector<LabelBox>& taken) {
  std::vector<LabelBox> boxes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [x, y] = points[i];
    const double w = widths[i], middle_x = x - w / 2, middle_y = y - height / 2;
    const double right = x + gap, left = x - gap - w, above = y - gap - height, below = y + gap;
    const std::array<LabelBox, 8> places{{{right, middle_y, w, height},
                                          {middle_x, above, w, height},
                                          {middle_x, below, w, height},
                                          {left, middle_y, w, height},
                                          {right, above, w, height},
                                          {right, below, w, height},
                                          {left, above, w, height},
                                          {left, below, w, height}}};
    const LabelBox* best = nullptr;
    double least = 0;
    for (const LabelBox& place : places) {
      const double here = harm(place, area, taken);
      if (best && here >= least) continue;
      best = &place;
      least = here;
      if (here == 0) break;
    }
    boxes.push_back(*best);
    taken.push_back(*best);
  }
  return boxes;
}

}  // namespace plume::command
