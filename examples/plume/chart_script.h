/// What gnuplot is told to draw a chart.
#pragma once

#include <string>

#include "chart.h"

namespace plume::command {

/// The commands that draw the chart into `picture`, a path without quotation marks, as SVG or PNG.
/// On the left, greatest error against milliseconds a frame, with the front's points labelled by
/// name and all others by number; on the right RMS error, a legend and the list of numbers. Errors
/// of 0 stand on a line of their own at the bottom.
std::string chart_script(const Chart& chart, const std::string& picture, bool svg);

}  // namespace plume::command
