/// A chart of error against time: what was measured, of what, and what follows from it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chart_measure.h"
#include "pareto.h"

namespace plume::command {

/// What was measured, and on what.
struct ChartSubject {
  std::string mesh;  ///< the file
  std::string form;  ///< as Scene::form()
  std::size_t cells = 0;
  std::string field;          ///< what is shown
  int width = 0;              ///< pixels
  int height = 0;             ///< pixels
  int threads = 0;            ///< that rendered
  int rounds = 0;             ///< frames timed of each way, at most
  std::string processor;      ///< in the words of the system
  std::string date;           ///< year-month-day
  std::string camera;         ///< position, focal point, view up, angle
  bool on_processor = false;  ///< times are those on the processor, not the clock's
};

/// Points measured elsewhere, by family.
struct PeerFamily {
  std::string name;
  std::vector<ChartPoint> points;
  std::vector<PeerFactor> factors;  ///< how many times as long as ours they take
};

/// A chart, ready to be written or drawn.
struct Chart {
  ChartSubject subject;
  std::vector<MeasuredWay> ways;                       ///< the fastest first
  std::vector<ChartPoint> points;                      ///< of the ways, in their order
  std::vector<std::size_t> front;                      ///< of the points, the fastest first
  std::vector<std::optional<std::size_t>> dominators;  ///< see dominated_by()
  std::vector<PeerFamily> peers;                       ///< in the order of their first points
  double reference_seconds = 0;
};

/// Puts together what follows from measured ways and from `others`' points.
Chart make_chart(ChartSubject subject, ChartMeasurement measurement,
                 const std::vector<ChartPoint>& others);

/// "1,000 cells (grid), 'Density', 640 x 480 pixels, 2 threads, ...", for titles.
std::string describe(const ChartSubject& subject);

/// The processor's name, "unknown processor" where the system does not say.
std::string processor_name();

}  // namespace plume::command
