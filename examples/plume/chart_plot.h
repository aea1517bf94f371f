/// A chart as a picture, drawn by gnuplot.
#pragma once

#include <filesystem>

#include "chart.h"

namespace plume::command {

/// Throws Error, naming the Debian package, where there is no gnuplot on the PATH.
void require_gnuplot();

/// Draws the chart: .png or .svg, whole or not at all. Throws Error where gnuplot is missing or
/// fails, with its words.
void draw_chart(const Chart& chart, const std::filesystem::path& picture);

}  // namespace plume::command
