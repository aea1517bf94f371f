/// A chart in words, for standard output.
#pragma once

#include <string>

#include "chart.h"

namespace plume::command {

/// The ways by time, with what is dominated and by what; the planner's choices; and, for each
/// family of peers, how many times as long as ours it takes to the same error.
std::string chart_report(const Chart& chart);

}  // namespace plume::command
