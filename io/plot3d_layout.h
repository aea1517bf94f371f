/// Plot3D files do not say how they are written: byte order, precision, record marks, blanking and
/// whether a number of blocks comes first have to be told from their size and first numbers.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace plume {

struct Plot3dLayout {
  bool text = false;
  bool little_endian = false;
  /// Each record between two copies of its length in bytes, as Fortran's unformatted files have it.
  bool record_marks = false;
  /// The number of blocks comes first.
  bool multi_block = false;
  bool blanking = false;
  bool double_precision = false;
  /// Points along i, j and k.
  std::vector<std::array<int, 3>> blocks;

  /// "binary, big-endian, float, no record marks, single-block".
  std::string description() const;
};

/// The only layout whose size is the file's. Throws Error where there is none, telling apart a file
/// that ends too early, a 2D grid and what is no Plot3D grid.
Plot3dLayout plot3d_grid_layout(const std::filesystem::path& file);

/// Throws Error unless the solution file is of the grid's layout and dimensions, and whole.
void check_plot3d_solution(const std::filesystem::path& file, const Plot3dLayout& grid);

}  // namespace plume
