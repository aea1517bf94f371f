/// Which pictures `plume render` makes: of which time steps, from where, under which names.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "plume/io/time_series.h"
#include "render_arguments.h"

namespace plume::command {

struct PlannedFrame {
  std::size_t step;    ///< of the series
  double turn;         ///< of the camera about view up, degrees
  std::string output;  ///< the picture's file
};

/// "all", "last", "N", "FIRST:LAST" or "FIRST:LAST:STRIDE" as steps of a series, by number from 0,
/// LAST included. FIRST and LAST may be left out. Empty: the last step. Throws Error, naming the
/// text, for anything else and for steps that are not there.
std::vector<std::size_t> parse_steps(const std::string& text, const TimeSeries& series,
                                     const std::string& name);

/// A frame for each step; with an orbit, as many as that has, over which the steps are spread
/// evenly. Frames are numbered from 0. Throws Error where several have one name, where the orbit
/// has fewer frames than there are steps, and as parse_steps().
std::vector<PlannedFrame> plan_frames(const RenderArguments& args, const TimeSeries& series);

/// The first frame's name, for what can be checked before the steps are known. Throws Error where
/// the name has two places for a number.
std::string first_output(const std::string& output);

}  // namespace plume::command
