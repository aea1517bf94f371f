/// The volume cells of a vtkUnstructuredGrid.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "plume/mesh/mesh.h"

class vtkDataSet;
class vtkUnstructuredGrid;

namespace plume {

/// Cells that were met and not taken as they are; summed over the blocks of a file.
struct CellCensus {
  /// By VTK's type: cells that are no volumes.
  std::map<int, std::int64_t> dropped;
  std::int64_t higher_order = 0;
  /// Hidden or ghost cells, which explicit cells leave out.
  std::int64_t hidden = 0;

  /// "3 lines, 12 triangles"; empty when none was dropped.
  std::string dropped_cells() const;
};

struct VolumeCells {
  Cells cells;
  /// True when every cell was taken, so that cell fields need no selection.
  bool all = false;
  /// Otherwise the ids of those that were.
  std::vector<std::int64_t> kept;
};

/// The grid's volume cells, its arrays borrowed when all are taken as they are. Higher-order cells
/// are represented by their corners. Throws Error where the arrays contradict each other.
VolumeCells volume_cells_of(vtkUnstructuredGrid& grid, const std::filesystem::path& file,
                            CellCensus& census);

/// Nonzero for each cell that is hidden: a ghost, blanked, or with a hidden point. Empty when there
/// is none.
std::vector<std::uint8_t> hidden_cells_of(vtkDataSet& data);

}  // namespace plume
