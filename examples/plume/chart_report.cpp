#include "chart_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace plume::command {
namespace {

std::string ways_table(const Chart& chart) {
  std::size_t width = 0;
  for (const ChartPoint& point : chart.points) width = std::max(width, point.method.size());
  std::string text = fmt::format("{:>4} {:>10} {:>10} {:>10}  {:<{}}  {}\n", "", "ms", "max error",
                                 "RMS error", "way", width, "dominated by");
  for (std::size_t i = 0; i < chart.points.size(); ++i) {
    const ChartPoint& point = chart.points[i];
    std::string by;
    if (const auto& better = chart.dominators[i])
      by = fmt::format("{}: {} ({:.1f} times as fast)", *better + 1, chart.points[*better].method,
                       point.milliseconds / chart.points[*better].milliseconds);
    text +=
        fmt::format("{:>4} {:>10.1f} {:>10.1e} {:>10.1e}  {:<{}}  {}\n", i + 1, point.milliseconds,
                    point.max_error, point.rms_error, point.method, width, by.empty() ? "-" : by);
  }
  return text;
}

std::string planned_table(const Chart& chart) {
  std::vector<const MeasuredWay*> planned;
  for (const MeasuredWay& way : chart.ways)
    if (way.way.tolerance) planned.push_back(&way);
  std::sort(planned.begin(), planned.end(), [](const MeasuredWay* a, const MeasuredWay* b) {
    return *a->way.tolerance > *b->way.tolerance;
  });
  std::string text;
  for (const MeasuredWay* way : planned) {
    const auto best = fastest_within(chart.points, *way->way.tolerance);
    text += fmt::format("{}\n  {} {:.1e}, {:.1f} ms a frame, {:.0f} ms to plan", way->point.method,
                        way->point.max_error <= *way->way.tolerance ? "error" : "ABOVE IT: error",
                        way->point.max_error, way->point.milliseconds, way->way.planning);
    if (best && &chart.ways[*best] != way)
      text += fmt::format("; the fastest that keeps to it: {} ({:.1f} ms)",
                          chart.points[*best].method, chart.points[*best].milliseconds);
    text += '\n';
  }
  return text;
}

// Points of others that none of ours beats, whatever their error.
std::string unbeaten(const Chart& chart) {
  std::string text;
  std::size_t all = 0;
  for (const PeerFamily& family : chart.peers)
    for (const ChartPoint& point : family.points) {
      ++all;
      const auto better = fastest_within(chart.points, point.max_error);
      if (!better || !dominates(chart.points[*better], point))
        text += fmt::format("  {}: {}, {:.1f} ms, error {:.1e}\n", family.name, point.method,
                            point.milliseconds, point.max_error);
    }
  if (text.empty()) return fmt::format("all {} points of others are dominated by ours\n", all);
  return fmt::format("of {} points of others, not dominated by ours:\n{}", all, text);
}

std::string peers_table(const Chart& chart) {
  std::string text;
  for (const PeerFamily& family : chart.peers) {
    text += fmt::format("{}, milliseconds at an error of at most\n", family.name);
    for (const PeerFactor& at : family.factors) {
      const auto time = [](const std::vector<ChartPoint>& points,
                           const std::optional<std::size_t>& number) {
        return number ? fmt::format("{:.1f} ({})", points[*number].milliseconds,
                                    points[*number].method)
                      : std::string("no point");
      };
      text += fmt::format("  {:.0e}: {}; ours {}{}\n", at.error, time(family.points, at.theirs),
                          time(chart.points, at.ours),
                          at.factor ? fmt::format("; {:.2f} times as long", *at.factor) : "");
    }
  }
  return text + unbeaten(chart);
}

}  // namespace

std::string chart_report(const Chart& chart) {
  std::string text = fmt::format("{}: {}\n\n{}\n{}", chart.subject.mesh, describe(chart.subject),
                                 ways_table(chart), planned_table(chart));
  if (!chart.peers.empty()) text.append(1, '\n').append(peers_table(chart));
  return text;
}

}  // namespace plume::command
