/// The statistics of `plume render`, as a file.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plume/lib/plume.h"
#include "render_arguments.h"

namespace plume::command {

/// How long the stages took, in milliseconds.
struct StageTimes {
  double read, build, render, write;
  /// Until the mesh was there; it may have been read while another step was rendered.
  double wait;
};

/// Which frame of a series a record is of.
struct FrameOfSeries {
  std::string output;
  std::size_t step;
  std::optional<double> time;
  double turn;
  bool mesh_stayed;
};

/// What there is to say of one picture.
nlohmann::json render_record(const FrameOfSeries& frame, const std::vector<const Scene*>& scenes,
                             const RenderSettings& settings, const RenderArguments& args,
                             const RenderStatistics& statistics, const StageTimes& ms);

/// The text of a JSON file: the record of a single picture, or {"frames": [...]} of several.
std::string render_report(std::vector<nlohmann::json> records);

}  // namespace plume::command
