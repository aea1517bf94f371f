/// The atlas of walks, and how it is written down.
#pragma once

#include <string>
#include <vector>

#include "judge.h"

namespace plume::atlas {

/// One method on one mesh of a scene.
struct WalkRow {
  std::string group, scene, cells, method;
  bool ours = false, promised = false;
  bool knows_cells = false;  ///< else wrong cells and the integral are not judged
  Tally tally;
};

/// Runs all scenes. Seconds.
std::vector<WalkRow> run_walks();

/// An error as a page shows it: a bound by a power of ten, rounded up, so that the page does not
/// depend on which instructions a processor has. "0" where nothing is off.
std::string shown_error(double error);

/// Two tables of markdown: our walkers over all scenes; and scene by scene, the rays that any
/// of our walkers fails beside those that the old methods fail.
std::string walker_table(const std::vector<WalkRow>& rows);
std::string scene_table(const std::vector<WalkRow>& rows);
/// Every row.
std::string full_table(const std::vector<WalkRow>& rows);

/// What must not be, a line each: failures of ours, and old methods that nowhere fail. Empty where
/// all is as it should be.
std::vector<std::string> problems_of(const std::vector<WalkRow>& rows);

}  // namespace plume::atlas
