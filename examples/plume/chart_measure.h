/// How long ways to make a picture take, and how far off they are.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chart_ways.h"
#include "pareto.h"

namespace plume::command {

/// A way and what came of it.
struct MeasuredWay {
  ChartWay way;
  /// Of the family "plume"; its milliseconds are the median of the frames that were timed.
  ChartPoint point;
  int frames = 0;        ///< timed ones
  bool in_turns = true;  ///< with the other ways; else in a row
  double fastest = 0;    ///< of them, milliseconds
  double slowest = 0;    ///< likewise
  double table_ms = 0;   ///< spent on a table before the first frame; 0 for ways without one
};

/// Where a measurement is.
struct ChartProgress {
  std::string doing;  ///< in a few words
  double share = 0;   ///< of the time, 0 to 1, as far as that is known
  /// Until it is done; nothing before each way has been timed once.
  std::optional<double> seconds_left;
};

/// All of a chart's own points.
struct ChartMeasurement {
  std::vector<MeasuredWay> ways;
  bool on_processor = false;     ///< times are not the clock's: see measure_ways()
  double reference_seconds = 0;  ///< for the picture that all are compared with
};

/// Renders the reference (reference_settings() of `base`), each way once, for its error and to warm
/// up, and then all of them in turns, `rounds` times (ways that take seconds three times at most),
/// so that what slows the machine down slows all of them. A way's table is built before its frames
/// are timed; where that takes longer than these, it is built once and they are timed in a row.
/// With one thread it is the process' time on the processor that is taken, which does not mind what
/// else runs; with several, the clock's. A channel that is not a number counts as an error of 1.
ChartMeasurement measure_ways(const Scene& scene, const Camera& camera, const RenderSettings& base,
                              std::vector<ChartWay> ways, int rounds,
                              const std::function<void(const ChartProgress&)>& progress);

}  // namespace plume::command
