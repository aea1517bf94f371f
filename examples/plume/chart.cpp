#include "chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "console.h"

namespace plume::command {

Chart make_chart(ChartSubject subject, ChartMeasurement measurement,
                 const std::vector<ChartPoint>& others) {
  Chart chart;
  chart.subject = std::move(subject);
  chart.subject.on_processor = measurement.on_processor;
  chart.ways = std::move(measurement.ways);
  chart.reference_seconds = measurement.reference_seconds;
  std::stable_sort(chart.ways.begin(), chart.ways.end(), [](const auto& a, const auto& b) {
    return a.point.milliseconds < b.point.milliseconds;
  });
  for (const MeasuredWay& way : chart.ways) chart.points.push_back(way.point);
  chart.front = pareto_front(chart.points);
  chart.dominators = dominated_by(chart.points);
  for (const ChartPoint& point : others) {
    auto family = std::find_if(chart.peers.begin(), chart.peers.end(),
                               [&](const PeerFamily& one) { return one.name == point.family; });
    if (family == chart.peers.end())
      family = chart.peers.insert(chart.peers.end(), PeerFamily{point.family, {}, {}});
    family->points.push_back(point);
  }
  for (PeerFamily& family : chart.peers) family.factors = peer_factors(chart.points, family.points);
  return chart;
}

std::string describe(const ChartSubject& on) {
  return fmt::format(
      "{} cells ({}), '{}', {} x {} pixels, {} thread{}, {}, {}; medians of {} frames in turns{}",
      with_separators(on.cells), on.form, on.field, on.width, on.height, on.threads,
      on.threads == 1 ? "" : "s", on.processor, on.date, on.rounds,
      on.on_processor ? ", time on the processor" : "");
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0)
      if (const auto at = line.find(": "); at != std::string::npos) return line.substr(at + 2);
  return "unknown processor";
}

}  // namespace plume::command
