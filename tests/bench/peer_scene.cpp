#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "plume/io/vtk_from_mesh.h"
#include "plume/mesh/error.h"
#include "plume/mesh/scalar_field.h"
#include "plume/tests/bench/peer.h"

namespace plume::bench {
namespace {

// Of a rectilinear grid, its points one by one.
std::vector<double> points_of(const Mesh& mesh) {
  std::vector<double> points;
  points.reserve(3 * mesh.point_count());
  if (!mesh.is_rectilinear()) {
    mesh.points.visit([&](auto values) {
      for (const auto value : values) points.push_back(static_cast<double>(value));
    });
    return points;
  }
  for (std::int64_t k = 0; k < mesh.dimensions[2]; ++k)
    for (std::int64_t j = 0; j < mesh.dimensions[1]; ++j)
      for (std::int64_t i = 0; i < mesh.dimensions[0]; ++i) {
        points.push_back(mesh.axes[0].at<double>(static_cast<std::size_t>(i)));
        points.push_back(mesh.axes[1].at<double>(static_cast<std::size_t>(j)));
        points.push_back(mesh.axes[2].at<double>(static_cast<std::size_t>(k)));
      }
  return points;
}

bool all_tetrahedra(const Mesh& mesh) {
  if (mesh.is_grid()) return false;
  return mesh.cells.types.visit([](auto types) {
    return std::all_of(types.begin(), types.end(), [](auto type) {
      return static_cast<int>(type) == static_cast<int>(CellType::tetrahedron);
    });
  });
}

Mesh mesh_of_tetrahedra(std::vector<double> points, std::vector<std::int32_t> connectivity,
                        Array scalars) {
  Mesh made;
  made.points = Array::own(std::move(points));
  made.cells.types =
      Array::own(std::vector<std::uint8_t>{static_cast<std::uint8_t>(CellType::tetrahedron)});
  made.cells.connectivity = Array::own(std::move(connectivity));
  made.fields.push_back({PeerScene::kField, Association::point, 1, std::move(scalars)});
  made.active_field = PeerScene::kField;
  return made;
}

Mesh cut(const Mesh& mesh) {
  vtkNew<vtkDataSetTriangleFilter> filter;
  filter->SetInputData(unstructured_from(mesh));
  filter->TetrahedraOnlyOn();
  filter->Update();
  vtkUnstructuredGrid& grid = *filter->GetOutput();
  std::vector<double> points;
  std::vector<float> scalars;
  vtkDataArray* const field = grid.GetPointData()->GetArray(PeerScene::kField);
  if (field == nullptr) throw Error("vtkDataSetTriangleFilter has lost the field");
  for (vtkIdType i = 0; i < grid.GetNumberOfPoints(); ++i) {
    const double* const place = grid.GetPoint(i);
    points.insert(points.end(), place, place + 3);
    scalars.push_back(static_cast<float>(field->GetComponent(i, 0)));
  }
  std::vector<std::int32_t> connectivity;
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    grid.GetCellPoints(cell, corners);
    if (corners->GetNumberOfIds() != 4) continue;
    for (vtkIdType k = 0; k < 4; ++k)
      connectivity.push_back(static_cast<std::int32_t>(corners->GetId(k)));
  }
  return mesh_of_tetrahedra(std::move(points), std::move(connectivity),
                            Array::own(std::move(scalars)));
}

// Gives all tetrahedra VTK's orientation, which its Z sweep reads; returns their volume.
double orient(std::vector<std::int32_t>& connectivity, const std::vector<double>& points) {
  double sum = 0;
  for (std::size_t cell = 0; cell < connectivity.size(); cell += 4) {
    const auto edge = [&](std::size_t corner, std::size_t axis) {
      return points[3 * static_cast<std::size_t>(connectivity[cell + corner]) + axis] -
             points[3 * static_cast<std::size_t>(connectivity[cell]) + axis];
    };
    double volume = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      volume += edge(3, a) * (edge(1, b) * edge(2, c) - edge(1, c) * edge(2, b));
    }
    if (volume < 0) std::swap(connectivity[cell + 2], connectivity[cell + 3]);
    sum += std::abs(volume) / 6;
  }
  return sum;
}

}  // namespace

PeerScene make_peer_scene(const Mesh& mesh, const std::string& field) {
  ScalarField scalars = select_field(mesh, {field, {}});
  if (scalars.association != Association::point)
    throw Error(
        fmt::format("field '{}' is on cells: peers are given fields on points", scalars.name));
  if (scalars.not_finite > 0)
    throw Error(fmt::format("field '{}': {} values are not finite, which peers cannot show",
                            scalars.name, scalars.not_finite));
  if (!mesh.hidden_cells.empty()) throw Error("the mesh hides cells, which peers cannot");
  PeerScene made;
  made.mesh = mesh;
  std::vector<double> points = points_of(mesh);
  if (mesh.is_rectilinear()) {
    made.mesh.points = Array::own(points);
    made.mesh.axes = {};
  }
  const Array values = Array::own(std::move(scalars.values));
  made.mesh.fields = {{PeerScene::kField, Association::point, 1, values}};
  made.mesh.active_field = PeerScene::kField;
  made.bounds = bounds_of(made.mesh.points);

  made.cut = !all_tetrahedra(mesh);
  std::vector<std::int32_t> connectivity;
  Array kept = values;
  if (made.cut) {
    const Mesh tetrahedra = cut(made.mesh);
    points = points_of(tetrahedra);
    kept = tetrahedra.fields.front().values;
    connectivity.resize(tetrahedra.cells.connectivity.size());
    for (std::size_t i = 0; i < connectivity.size(); ++i)
      connectivity[i] = tetrahedra.cells.connectivity.at<std::int32_t>(i);
  } else {
    mesh.cells.connectivity.visit([&](auto ids) {
      for (const auto id : ids) connectivity.push_back(static_cast<std::int32_t>(id));
    });
  }
  const double volume = orient(connectivity, points);
  made.tetrahedra = mesh_of_tetrahedra(std::move(points), std::move(connectivity), kept);
  made.cell_size = std::cbrt(volume / static_cast<double>(mesh.cell_count()));
  if (!(made.cell_size > 0)) throw Error("the mesh has no volume");
  return made;
}

}  // namespace plume::bench
