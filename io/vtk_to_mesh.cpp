#include "plume/io/vtk_to_mesh.h"

#include <vtkCellType.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "plume/io/read_blocks.h"
#include "plume/io/read_surface.h"
#include "plume/io/vtk_arrays.h"
#include "plume/io/vtk_cells.h"
#include "plume/io/vtk_data_sets.h"
#include "plume/io/vtk_points.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

// Coordinates of a grid's points: along its axes where that is enough, else of each point.
struct Coordinates {
  std::array<Array, 3> axes;
  Array points;
};

// Whether i, j and k run along x, y and z, upwards or downwards.
bool runs_along_axes(vtkMatrix3x3& direction) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      if (std::abs(direction.GetElement(row, column)) != (row == column ? 1 : 0)) return false;
  return true;
}

// GetPoint knows about the origin, the spacing, the extent and the direction matrix.
Coordinates image_coordinates(vtkImageData& image, const int (&dimensions)[3]) {
  Coordinates coordinates;
  double point[3];
  if (runs_along_axes(*image.GetDirectionMatrix())) {
    vtkIdType step = 1;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> along;
      for (int i = 0; i < dimensions[axis]; ++i) {
        image.GetPoint(i * step, point);
        along.push_back(point[axis]);
      }
      coordinates.axes[static_cast<std::size_t>(axis)] = Array::own(std::move(along));
      step *= dimensions[axis];
    }
    return coordinates;
  }
  const auto count = static_cast<std::size_t>(image.GetNumberOfPoints());
  std::vector<double> points(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    image.GetPoint(static_cast<vtkIdType>(i), points.data() + 3 * i);
  coordinates.points = Array::own(std::move(points));
  return coordinates;
}

Coordinates rectilinear_coordinates(vtkRectilinearGrid& grid, const int (&dimensions)[3],
                                    const std::filesystem::path& file) {
  vtkDataArray* const axes[3] = {grid.GetXCoordinates(), grid.GetYCoordinates(),
                                 grid.GetZCoordinates()};
  Coordinates coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!axes[axis] || axes[axis]->GetNumberOfTuples() != dimensions[axis] ||
        axes[axis]->GetNumberOfComponents() != 1)
      throw Error(file.string() + ": " + "xyz"[axis] + std::string(" coordinates do not fit the ") +
                  std::to_string(dimensions[axis]) +
                  " points along that axis; the file is damaged");
    coordinates.axes[axis] = to_coordinates(axes[axis]);
  }
  return coordinates;
}

Array point_set_points(vtkPointSet& set) {
  return set.GetPoints() ? to_coordinates(set.GetPoints()->GetData()) : Array{};
}

// Cells of a structured data set that is a surface, a line or a point.
void count_flat_cells(vtkDataSet& data, CellCensus& census) {
  for (vtkIdType cell = 0; cell < data.GetNumberOfCells(); ++cell)
    ++census.dropped[data.GetCellType(cell)];
}

std::optional<Mesh> grid_from(vtkDataSet& data, const int (&dimensions)[3], Coordinates coordinates,
                              const std::filesystem::path& file, const Notice& notice,
                              CellCensus& census) {
  if (*std::min_element(dimensions, dimensions + 3) < 2) {
    count_flat_cells(data, census);
    return std::nullopt;
  }
  Mesh mesh;
  std::copy(dimensions, dimensions + 3, mesh.dimensions.begin());
  mesh.axes = std::move(coordinates.axes);
  mesh.points = std::move(coordinates.points);
  const std::size_t expected =
      std::accumulate(dimensions, dimensions + 3, std::size_t{1},
                      [](std::size_t count, int n) { return count * static_cast<std::size_t>(n); });
  if (mesh.point_count() != expected)
    throw Error(file.string() + ": " + std::to_string(mesh.point_count()) +
                " points for a grid of " + std::to_string(expected) +
                "; the file is damaged or truncated");
  auto hidden = hidden_cells_of(data);
  const auto hidden_count = std::count(hidden.begin(), hidden.end(), 1);
  census.hidden += hidden_count;
  if (!hidden.empty() && static_cast<std::size_t>(hidden_count) == hidden.size())
    return std::nullopt;
  if (!hidden.empty()) mesh.hidden_cells = Array::own(std::move(hidden));
  mesh.fields = fields_of(data, file, notice, mesh.active_field);
  return mesh;
}

std::optional<Mesh> unstructured_from(vtkUnstructuredGrid& grid, const std::filesystem::path& file,
                                      const Notice& notice, CellCensus& census) {
  VolumeCells chosen = volume_cells_of(grid, file, census);
  if (!chosen.all && chosen.kept.empty()) return std::nullopt;
  Mesh mesh;
  mesh.points = point_set_points(grid);
  mesh.cells = std::move(chosen.cells);
  mesh.fields = fields_of(grid, file, notice, mesh.active_field);
  if (!chosen.all)
    for (Field& field : mesh.fields)
      if (field.association == Association::cell) field = select_cells(field, chosen.kept);
  return mesh;
}

// Empty when the data set has no volume cells.
std::optional<Mesh> block_from(vtkDataSet& data, const std::filesystem::path& file,
                               const Notice& notice, CellCensus& census) {
  int dimensions[3];
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(&data))
    return unstructured_from(*grid, file, notice, census);
  if (auto* const grid = vtkStructuredGrid::SafeDownCast(&data)) {
    grid->GetDimensions(dimensions);
    return grid_from(data, dimensions, {{}, point_set_points(*grid)}, file, notice, census);
  }
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(&data)) {
    grid->GetDimensions(dimensions);
    return grid_from(data, dimensions, rectilinear_coordinates(*grid, dimensions, file), file,
                     notice, census);
  }
  if (auto* const image = vtkImageData::SafeDownCast(&data)) {
    image->GetDimensions(dimensions);
    return grid_from(data, dimensions, image_coordinates(*image, dimensions), file, notice, census);
  }
  count_flat_cells(data, census);
  return std::nullopt;
}

void report(const CellCensus& census, bool is_grid, const std::filesystem::path& file,
            const Notice& notice) {
  if (!notice) return;
  if (!census.dropped.empty())
    notice(file.string() + ": " + census.dropped_cells() + " dropped: not volume cells");
  if (census.hidden > 0)
    notice(file.string() + ": " + std::to_string(census.hidden) +
           (is_grid ? " of the cells hidden: blanked, or ghosts"
                    : " of the cells dropped: blanked, or ghosts"));
  if (census.higher_order > 0)
    notice(file.string() + ": " + std::to_string(census.higher_order) +
           " of the cells are of higher order: represented by their corners");
}

Mesh tetrahedra_of(const PointSet& points, const std::filesystem::path& file,
                   const ReadOptions& options, const Notice& notice) {
  try {
    Tetrahedralization result = tetrahedralize(points, options.engine);
    report_tetrahedra(result, file, std::to_string(points.point_count()) + " points", notice);
    return std::move(result.mesh);
  } catch (const Error& error) {
    throw Error(file.string() + ": points without cells: " + error.what());
  }
}

// For what a surface encloses there is a command.
std::string remedy_for(const CellCensus& census) {
  const bool surface =
      std::any_of(census.dropped.begin(), census.dropped.end(), [](const auto& dropped) {
        return dropped.first == VTK_TRIANGLE || dropped.first == VTK_TRIANGLE_STRIP ||
               dropped.first == VTK_POLYGON || dropped.first == VTK_QUAD;
      });
  return surface ? "; 'plume tetrahedralize' fills closed surfaces" : "";
}

}  // namespace

Mesh mesh_from_vtk(vtkDataObject& data, const std::filesystem::path& file,
                   const ReadOptions& options, const Notice& notice) {
  CellCensus census;
  std::vector<Mesh> blocks;
  for (const auto& part : data_sets_in(data))
    if (part->GetNumberOfCells() > 0)
      if (auto block = block_from(*part, file, notice, census)) blocks.push_back(std::move(*block));
  if (blocks.empty()) {
    if (const auto points = point_set_in(data, file, false, notice))
      return tetrahedra_of(*points, file, options, notice);
    std::string found = census.dropped_cells();
    if (census.hidden > 0)
      found += (found.empty() ? "" : ", ") + std::to_string(census.hidden) + " hidden";
    throw Error(file.string() + ": no volume cells" +
                (found.empty() ? ": it is empty" : ", only " + found) +
                "; Plume needs tetrahedra, hexahedra, wedges, pyramids, prisms or polyhedra" +
                remedy_for(census));
  }
  const bool one_block = blocks.size() == 1;
  report(census, one_block && blocks[0].is_grid(), file, notice);
  if (one_block) return std::move(blocks[0]);
  return append_blocks(std::move(blocks), options.merge_points, file, notice);
}

}  // namespace plume
