/// Charts as text: CSV for others' points and ours, JSON with all there is to say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "chart.h"

namespace plume::command {

/// The lines `method,family,milliseconds,max_error,rms_error`, and a column `dominated_by`: the
/// method to take in its place, empty for those of the front. Fields with a comma or a quotation
/// mark are quoted as in RFC 4180.
std::string chart_csv(const Chart& chart);

/// Reads the points of such a text; columns are found by the names in its first line, others than
/// those five are passed over. Throws Error, naming `file`, the line and the value.
std::vector<ChartPoint> parse_chart_csv(std::string_view text, const std::string& file);

/// As parse_chart_csv() of a file. Points of a family "plume" are of another chart: the family
/// becomes "plume (FILE)". Throws Error for a file that cannot be read.
std::vector<ChartPoint> read_chart_csv(const std::string& file);

/// Everything: the mesh, the machine, the ways with their times, the front, the planner's choices,
/// the peers and how far our front is below theirs.
std::string chart_json(const Chart& chart);

}  // namespace plume::command
