#include "plume/io/vtk_to_mesh.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkImageData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "plume/io/read_blocks.h"
#include "plume/io/vtk_arrays.h"
#include "plume/io/vtk_cells.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

std::vector<vtkSmartPointer<vtkDataSet>> data_sets_in(vtkDataObject& data) {
  std::vector<vtkSmartPointer<vtkDataSet>> found;
  if (auto* const set = vtkDataSet::SafeDownCast(&data)) {
    found.emplace_back(set);
  } else if (auto* const composite = vtkCompositeDataSet::SafeDownCast(&data)) {
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
      if (auto* const part = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject()))
        found.emplace_back(part);
  }
  return found;
}

Array image_points(vtkImageData& image) {
  const auto count = static_cast<std::size_t>(image.GetNumberOfPoints());
  std::vector<double> points(3 * count);
  // GetPoint knows about the origin, the extent and the direction matrix.
  for (std::size_t i = 0; i < count; ++i)
    image.GetPoint(static_cast<vtkIdType>(i), points.data() + 3 * i);
  return Array::own(std::move(points));
}

template <class T>
Array rectilinear_points(vtkRectilinearGrid& grid) {
  vtkDataArray* const axes[3] = {grid.GetXCoordinates(), grid.GetYCoordinates(),
                                 grid.GetZCoordinates()};
  int dimensions[3];
  grid.GetDimensions(dimensions);
  std::vector<T> points;
  points.reserve(3 * static_cast<std::size_t>(grid.GetNumberOfPoints()));
  for (int k = 0; k < dimensions[2]; ++k)
    for (int j = 0; j < dimensions[1]; ++j)
      for (int i = 0; i < dimensions[0]; ++i) {
        points.push_back(static_cast<T>(axes[0]->GetComponent(i, 0)));
        points.push_back(static_cast<T>(axes[1]->GetComponent(j, 0)));
        points.push_back(static_cast<T>(axes[2]->GetComponent(k, 0)));
      }
  return Array::own(std::move(points));
}

Array rectilinear_points(vtkRectilinearGrid& grid, const std::filesystem::path& file) {
  vtkDataArray* const axes[3] = {grid.GetXCoordinates(), grid.GetYCoordinates(),
                                 grid.GetZCoordinates()};
  int dimensions[3];
  grid.GetDimensions(dimensions);
  bool is_float = true;
  for (int axis = 0; axis < 3; ++axis) {
    if (!axes[axis] || axes[axis]->GetNumberOfTuples() != dimensions[axis])
      throw Error(file.string() + ": " + "xyz"[axis] + std::string(" coordinates do not fit the ") +
                  std::to_string(dimensions[axis]) +
                  " points along that axis; the file is damaged");
    is_float = is_float && axes[axis]->GetDataType() == VTK_FLOAT;
  }
  return is_float ? rectilinear_points<float>(grid) : rectilinear_points<double>(grid);
}

Array point_set_points(vtkPointSet& set) {
  return set.GetPoints() ? to_coordinates(set.GetPoints()->GetData()) : Array{};
}

// Cells of a structured data set that is a surface, a line or a point.
void count_flat_cells(vtkDataSet& data, CellCensus& census) {
  for (vtkIdType cell = 0; cell < data.GetNumberOfCells(); ++cell)
    ++census.dropped[data.GetCellType(cell)];
}

std::optional<Mesh> grid_from(vtkDataSet& data, const int (&dimensions)[3], Array points,
                              const std::filesystem::path& file, const Notice& notice,
                              CellCensus& census) {
  if (*std::min_element(dimensions, dimensions + 3) < 2) {
    count_flat_cells(data, census);
    return std::nullopt;
  }
  Mesh mesh;
  std::copy(dimensions, dimensions + 3, mesh.dimensions.begin());
  std::size_t expected = 3;
  for (const int n : dimensions) expected *= static_cast<std::size_t>(n);
  if (points.size() != expected)
    throw Error(file.string() + ": " + std::to_string(points.size() / 3) +
                " points for a grid of " + std::to_string(expected / 3) +
                "; the file is damaged or truncated");
  mesh.points = std::move(points);
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
    return grid_from(data, dimensions, point_set_points(*grid), file, notice, census);
  }
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(&data)) {
    grid->GetDimensions(dimensions);
    return grid_from(data, dimensions, rectilinear_points(*grid, file), file, notice, census);
  }
  if (auto* const image = vtkImageData::SafeDownCast(&data)) {
    image->GetDimensions(dimensions);
    return grid_from(data, dimensions, image_points(*image), file, notice, census);
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

}  // namespace

Mesh mesh_from_vtk(vtkDataObject& data, const std::filesystem::path& file,
                   const ReadOptions& options, const Notice& notice) {
  CellCensus census;
  std::vector<Mesh> blocks;
  for (const auto& part : data_sets_in(data))
    if (part->GetNumberOfCells() > 0)
      if (auto block = block_from(*part, file, notice, census)) blocks.push_back(std::move(*block));
  if (blocks.empty()) {
    std::string found = census.dropped_cells();
    if (census.hidden > 0)
      found += (found.empty() ? "" : ", ") + std::to_string(census.hidden) + " hidden";
    throw Error(file.string() + ": no volume cells" +
                (found.empty() ? ": it is empty" : ", only " + found) +
                "; Plume needs tetrahedra, hexahedra, wedges, pyramids, prisms or polyhedra");
  }
  const bool one_block = blocks.size() == 1;
  report(census, one_block && blocks[0].is_grid(), file, notice);
  if (one_block) return std::move(blocks[0]);
  return append_blocks(std::move(blocks), options.merge_points, file, notice);
}

}  // namespace plume
