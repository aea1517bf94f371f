#include "plume/io/vtk_from_mesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <type_traits>
#include <utility>
#include <vector>

namespace plume {
namespace {

// VTK's array over our values, which it only reads.
vtkSmartPointer<vtkDataArray> lend(const Array& array, int components) {
  vtkSmartPointer<vtkDataArray> lent;
  const int types[] = {VTK_UNSIGNED_CHAR, VTK_TYPE_INT32, VTK_TYPE_INT64, VTK_FLOAT, VTK_DOUBLE};
  lent.TakeReference(vtkDataArray::CreateDataArray(types[static_cast<std::size_t>(array.type())]));
  lent->SetNumberOfComponents(components);
  lent->SetVoidArray(const_cast<void*>(array.data()), static_cast<vtkIdType>(array.size()), 1);
  return lent;
}

// The same, as the type that a vtkCellArray asks for.
template <class ArrayType>
vtkSmartPointer<ArrayType> lend_ids(const Array& array) {
  using Id = typename ArrayType::ValueType;
  const auto lent = vtkSmartPointer<ArrayType>::New();
  lent->SetArray(const_cast<Id*>(static_cast<const Id*>(array.data())),
                 static_cast<vtkIdType>(array.size()), 1);
  return lent;
}

// Offsets and connectivity need one type between them, which only 64 bits can promise.
template <class ArrayType>
vtkSmartPointer<ArrayType> as_ids(const Array& array) {
  const auto ids = vtkSmartPointer<ArrayType>::New();
  ids->SetNumberOfValues(static_cast<vtkIdType>(array.size()));
  array.visit([&](auto values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      ids->SetValue(static_cast<vtkIdType>(i),
                    static_cast<typename ArrayType::ValueType>(values[i]));
  });
  return ids;
}

// The offsets of cells that all have `n` points.
template <class ArrayType>
vtkSmartPointer<ArrayType> regular_offsets(std::size_t cells, std::size_t n) {
  const auto offsets = vtkSmartPointer<ArrayType>::New();
  offsets->SetNumberOfValues(static_cast<vtkIdType>(cells + 1));
  for (std::size_t cell = 0; cell <= cells; ++cell)
    offsets->SetValue(static_cast<vtkIdType>(cell),
                      static_cast<typename ArrayType::ValueType>(cell * n));
  return offsets;
}

// A grid's cells, hidden ones included.
vtkSmartPointer<vtkCellArray> hexahedra_of(const Mesh& grid) {
  const auto [ni, nj, nk] = grid.dimensions;
  const auto ids = vtkSmartPointer<vtkTypeInt64Array>::New();
  ids->SetNumberOfValues(static_cast<vtkIdType>(8 * grid.cell_count()));
  vtkIdType next = 0;
  for (std::int64_t k = 0; k + 1 < nk; ++k)
    for (std::int64_t j = 0; j + 1 < nj; ++j)
      for (std::int64_t i = 0; i + 1 < ni; ++i) {
        const std::int64_t p = i + ni * (j + nj * k), up = ni * nj;
        for (const std::int64_t id :
             {p, p + 1, p + 1 + ni, p + ni, p + up, p + up + 1, p + up + 1 + ni, p + up + ni})
          ids->SetValue(next++, id);
      }
  const auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(regular_offsets<vtkTypeInt64Array>(grid.cell_count(), 8).Get(), ids.Get());
  return result;
}

template <class ArrayType>
void set_cells(vtkCellArray& result, const Mesh& mesh, const vtkSmartPointer<ArrayType>& ids) {
  const Array& offsets = mesh.cells.offsets;
  if (offsets.empty()) {
    const auto type = static_cast<CellType>(mesh.cells.types.at<int>(0));
    const auto n = static_cast<std::size_t>(points_per_cell(type));
    result.SetData(regular_offsets<ArrayType>(mesh.cell_count(), n).Get(), ids.Get());
  } else if (offsets.type() == mesh.cells.connectivity.type()) {
    result.SetData(lend_ids<ArrayType>(offsets).Get(), ids.Get());
  } else {
    result.SetData(as_ids<vtkTypeInt64Array>(offsets).Get(),
                   as_ids<vtkTypeInt64Array>(mesh.cells.connectivity).Get());
  }
}

vtkSmartPointer<vtkCellArray> cells_of(const Mesh& mesh) {
  if (mesh.is_grid()) return hexahedra_of(mesh);
  const auto result = vtkSmartPointer<vtkCellArray>::New();
  const Array& ids = mesh.cells.connectivity;
  if (ids.type() == Array::Type::int32)
    set_cells(*result, mesh, lend_ids<vtkTypeInt32Array>(ids));
  else if (ids.type() == Array::Type::int64)
    set_cells(*result, mesh, lend_ids<vtkTypeInt64Array>(ids));
  else
    set_cells(*result, mesh, as_ids<vtkTypeInt64Array>(ids));
  return result;
}

vtkSmartPointer<vtkUnsignedCharArray> types_of(const Mesh& mesh) {
  const Array& given = mesh.cells.types;
  const auto types = vtkSmartPointer<vtkUnsignedCharArray>::New();
  types->SetNumberOfValues(static_cast<vtkIdType>(mesh.cell_count()));
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell)
    types->SetValue(static_cast<vtkIdType>(cell),
                    mesh.is_grid() ? static_cast<std::uint8_t>(CellType::hexahedron)
                                   : given.at<std::uint8_t>(given.size() == 1 ? 0 : cell));
  return types;
}

vtkSmartPointer<vtkPoints> points_of(const Mesh& mesh) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(lend(mesh.points, 3));
  return points;
}

void add_fields(const Mesh& mesh, vtkDataSet& data) {
  for (const Field& field : mesh.fields) {
    vtkDataSetAttributes* attributes = data.GetCellData();
    if (field.association == Association::point) attributes = data.GetPointData();
    const auto values = lend(field.values, field.components);
    values->SetName(field.name.c_str());
    attributes->AddArray(values);
    if (field.name == mesh.active_field) attributes->SetActiveScalars(field.name.c_str());
  }
  if (mesh.hidden_cells.empty()) return;
  const auto ghosts = vtkSmartPointer<vtkUnsignedCharArray>::New();
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(static_cast<vtkIdType>(mesh.hidden_cells.size()));
  for (std::size_t cell = 0; cell < mesh.hidden_cells.size(); ++cell)
    ghosts->SetValue(static_cast<vtkIdType>(cell),
                     mesh.hidden_cells.at<int>(cell) != 0 ? vtkDataSetAttributes::HIDDENCELL : 0);
  data.GetCellData()->AddArray(ghosts);
}

}  // namespace

vtkSmartPointer<vtkDataSet> rectilinear_from(const Mesh& mesh) {
  const auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(static_cast<int>(mesh.dimensions[0]), static_cast<int>(mesh.dimensions[1]),
                      static_cast<int>(mesh.dimensions[2]));
  grid->SetXCoordinates(lend(mesh.axes[0], 1));
  grid->SetYCoordinates(lend(mesh.axes[1], 1));
  grid->SetZCoordinates(lend(mesh.axes[2], 1));
  add_fields(mesh, *grid);
  return grid;
}

vtkSmartPointer<vtkDataSet> image_from(const Mesh& mesh) {
  const auto image = vtkSmartPointer<vtkImageData>::New();
  int dimensions[3];
  double origin[3], spacing[3];
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t last = mesh.axes[a].size() - 1;
    dimensions[a] = static_cast<int>(mesh.dimensions[a]);
    origin[a] = mesh.axes[a].at<double>(0);
    spacing[a] = (mesh.axes[a].at<double>(last) - origin[a]) / static_cast<double>(last);
  }
  image->SetDimensions(dimensions);
  image->SetOrigin(origin);
  image->SetSpacing(spacing);
  add_fields(mesh, *image);
  return image;
}

vtkSmartPointer<vtkDataSet> structured_from(const Mesh& mesh) {
  const auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(static_cast<int>(mesh.dimensions[0]), static_cast<int>(mesh.dimensions[1]),
                      static_cast<int>(mesh.dimensions[2]));
  grid->SetPoints(points_of(mesh));
  add_fields(mesh, *grid);
  return grid;
}

vtkSmartPointer<vtkDataSet> unstructured_from(const Mesh& mesh) {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points_of(mesh));
  const Cells& cells = mesh.cells;
  if (cells.polyhedron_faces.empty()) {
    grid->SetCells(types_of(mesh), cells_of(mesh));
  } else {
    grid->SetCells(types_of(mesh), cells_of(mesh),
                   as_ids<vtkIdTypeArray>(cells.polyhedron_locations),
                   as_ids<vtkIdTypeArray>(cells.polyhedron_faces));
  }
  add_fields(mesh, *grid);
  return grid;
}

}  // namespace plume
