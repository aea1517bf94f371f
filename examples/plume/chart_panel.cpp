#include "chart_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plume::command {

ChartPanel::ChartPanel(LabelBox area, const std::vector<ChartPoint>& points, ErrorOf error)
    : area_(area), error_(error) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double fastest = kNone, slowest = 0, least = kNone, greatest = 0;
  for (const ChartPoint& point : points) {
    fastest = std::min(fastest, point.milliseconds);
    slowest = std::max(slowest, point.milliseconds);
    greatest = std::max(greatest, point.*error);
    if (point.*error > 0)
      least = std::min(least, point.*error);
    else
      has_zero_ = true;
  }
  if (greatest == 0) least = greatest = 1e-6;  // nothing but zeros
  left_ = std::log10(fastest) - 0.15;
  right_ = std::log10(slowest) + 0.15;
  lowest_ = std::floor(std::log10(least));
  top_ = std::max(std::ceil(std::log10(greatest)), lowest_ + 1);
  bottom_ = lowest_ - (has_zero_ ? 1.4 : 0.3);
}

double ChartPanel::drawn(double error) const {
  return error > 0 ? error : std::pow(10, lowest_ - 1);
}

ChartPlace ChartPanel::place(double milliseconds, double error) const {
  return {area_.left + area_.width * (std::log10(milliseconds) - left_) / (right_ - left_),
          area_.top + area_.height * (top_ - std::log10(drawn(error))) / (top_ - bottom_)};
}

ChartPlace ChartPanel::place(const ChartPoint& point) const {
  return place(point.milliseconds, point.*error_);
}

void ChartPanel::make_room(double milliseconds, double pixels) {
  // (x - left) / (right - left) * width = pixels
  const double x = std::log10(milliseconds), share = pixels / area_.width;
  if (share < 0.9) left_ = std::min(left_, (x - share * right_) / (1 - share));
}

void ChartPanel::share_times(const ChartPanel& other) {
  left_ = other.left_;
  right_ = other.right_;
}

std::string ChartPanel::axes(const std::string& title, bool times_labelled) const {
  std::string made = fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
      "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n",
      area_.left / kChartWidth, (area_.left + area_.width) / kChartWidth,
      1 - area_.top / kChartHeight, 1 - (area_.top + area_.height) / kChartHeight);
  made += fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", std::pow(10, left_),
                      std::pow(10, right_), std::pow(10, bottom_), std::pow(10, top_));
  // 1, 2 and 5 of each decade, or 1 alone where these would run into each other.
  const bool close = area_.width / (right_ - left_) < 150;
  std::string times;
  for (int decade = static_cast<int>(std::floor(left_)); decade <= right_; ++decade)
    for (const int digit : {1, 2, 5}) {
      const double at = digit * std::pow(10, decade);
      times += fmt::format("{}'{}' {:g}", times.empty() ? "" : ", ",
                           close && digit > 1 ? "" : fmt::format("{:g}", at), at);
    }
  std::string errors;
  for (double decade = lowest_; decade <= top_; ++decade)
    errors += fmt::format("{}'{}' {}", errors.empty() ? "" : ", ",
                          decade == 0 ? "1" : fmt::format("1e{:g}", decade), std::pow(10, decade));
  if (has_zero_) errors += fmt::format(", '0' {}", drawn(0));
  made += fmt::format("set xtics ({})\nset ytics ({})\n", times, errors);
  made += fmt::format("set label '{}' at screen {:.5f},{:.5f} font 'Sans,11' tc rgb '#333333'\n",
                      title, area_.left / kChartWidth, 1 - (area_.top - 14) / kChartHeight);
  made += times_labelled ? "set xlabel 'milliseconds a frame'\n" : "unset xlabel\n";
  return made;
}

}  // namespace plume::command
