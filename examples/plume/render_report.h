/// The statistics of `plume render`, as a file.
#pragma once

#include <string>

#include "plume/lib/plume.h"
#include "render_arguments.h"

namespace plume::command {

/// How long the stages took, in milliseconds.
struct StageTimes {
  double read, build, render, write;
};

/// The text of a JSON file.
std::string render_report(const Scene& scene, const RenderSettings& settings,
                          const RenderArguments& args, const RenderStatistics& statistics,
                          const StageTimes& ms);

}  // namespace plume::command
