#include "plume/io/vtk_points.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkIdList.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>

#include <string>
#include <utility>
#include <vector>

#include "plume/io/read_blocks.h"
#include "plume/io/read_file.h"
#include "plume/io/vtk_arrays.h"
#include "plume/io/vtk_data_sets.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

bool only_vertices(vtkDataSet& set) {
  for (vtkIdType cell = 0; cell < set.GetNumberOfCells(); ++cell) {
    const int type = set.GetCellType(cell);
    if (type != VTK_VERTEX && type != VTK_POLY_VERTEX && type != VTK_EMPTY_CELL) return false;
  }
  return true;
}

// In VTK's own formats points without cells are meant; in others cells are missing.
bool may_lack_cells(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  return extension.starts_with(".vt") || extension.starts_with(".pvt") || extension == ".pvd";
}

// Points and fields of points, as a mesh without cells.
Mesh points_of(vtkPointSet& set, const std::filesystem::path& file, const Notice& notice) {
  Mesh mesh;
  mesh.points = to_coordinates(set.GetPoints()->GetData());
  mesh.fields = fields_of(set, file, notice, mesh.active_field);
  std::erase_if(mesh.fields,
                [](const Field& field) { return field.association == Association::cell; });
  return mesh;
}

PointSet to_point_set(Mesh mesh) {
  return {std::move(mesh.points), std::move(mesh.fields), std::move(mesh.active_field)};
}

struct Cut {
  std::int64_t polygons = 0, others = 0;
};

// Triangles, polygons and strips of any data set, with the ids of its points.
vtkSmartPointer<vtkPolyData> faces_of(vtkPointSet& set, const std::filesystem::path& file,
                                      Cut& cut) {
  const auto polygons = vtkSmartPointer<vtkCellArray>::New();
  const auto strips = vtkSmartPointer<vtkCellArray>::New();
  const auto ids = vtkSmartPointer<vtkIdList>::New();
  for (vtkIdType cell = 0; cell < set.GetNumberOfCells(); ++cell) {
    const int type = set.GetCellType(cell);
    set.GetCellPoints(cell, ids);
    if (type != VTK_TRIANGLE && type != VTK_QUAD && type != VTK_POLYGON &&
        type != VTK_TRIANGLE_STRIP) {
      if (type != VTK_VERTEX && type != VTK_POLY_VERTEX) ++cut.others;
      continue;
    }
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      if (ids->GetId(i) < 0 || ids->GetId(i) >= set.GetNumberOfPoints())
        throw Error(file.string() + ": cell " + std::to_string(cell) + " uses point " +
                    std::to_string(ids->GetId(i)) + " of " +
                    std::to_string(set.GetNumberOfPoints()) + "; the file is damaged");
    if (type != VTK_TRIANGLE) ++cut.polygons;
    (type == VTK_TRIANGLE_STRIP ? strips : polygons)->InsertNextCell(ids);
  }
  const auto faces = vtkSmartPointer<vtkPolyData>::New();
  faces->SetPoints(set.GetPoints());
  faces->SetPolys(polygons);
  faces->SetStrips(strips);
  return faces;
}

}  // namespace

std::optional<PointSet> point_set_in(vtkDataObject& data, const std::filesystem::path& file,
                                     bool without_fields, const Notice& notice) {
  std::vector<Mesh> parts;
  for (const auto& set : data_sets_in(data)) {
    if (set->GetNumberOfPoints() == 0 && set->GetNumberOfCells() == 0) continue;
    auto* const points = vtkPointSet::SafeDownCast(set);
    if (!points || !points->GetPoints() || !only_vertices(*set)) return std::nullopt;
    parts.push_back(points_of(*points, file, notice));
    if (set->GetNumberOfCells() == 0 &&
        !(may_lack_cells(file) && (without_fields || !parts.back().fields.empty())))
      return std::nullopt;
  }
  if (parts.empty()) return std::nullopt;
  if (parts.size() == 1) return to_point_set(std::move(parts[0]));
  return to_point_set(append_blocks(std::move(parts), false, file, notice));
}

void mark_as_points(vtkPolyData& data) {
  const auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->AllocateExact(1, data.GetNumberOfPoints());
  vertices->InsertNextCell(static_cast<int>(data.GetNumberOfPoints()));
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) vertices->InsertCellPoint(i);
  data.SetVerts(vertices);
}

TriangleSurface triangles_in(vtkDataObject& data, const std::filesystem::path& file,
                             const Notice& notice) {
  std::vector<vtkPointSet*> sets;
  for (const auto& set : data_sets_in(data))
    if (auto* const points = vtkPointSet::SafeDownCast(set);
        points && points->GetPoints() && points->GetNumberOfCells() > 0)
      sets.push_back(points);
  TriangleSurface surface;
  if (sets.empty()) return surface;
  if (sets.size() > 1)
    throw Error(file.string() + ": holds " + std::to_string(sets.size()) +
                " surfaces; write each to a file of its own, or append them to one");
  Cut cut;
  const auto faces = faces_of(*sets[0], file, cut);
  if (faces->GetNumberOfCells() == 0) return surface;
  const auto filter = vtkSmartPointer<vtkTriangleFilter>::New();
  filter->SetInputData(faces);
  filter->Update();
  vtkCellArray* const triangles = filter->GetOutput()->GetPolys();
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i) {
    triangles->GetCellAtId(i, size, ids);
    if (size == 3)
      surface.triangles.push_back({static_cast<std::uint32_t>(ids[0]),
                                   static_cast<std::uint32_t>(ids[1]),
                                   static_cast<std::uint32_t>(ids[2])});
  }
  surface.vertices = to_point_set(points_of(*sets[0], file, notice));
  if (notice && cut.polygons > 0)
    notice(file.string() + ": " + std::to_string(cut.polygons) +
           " polygons cut into triangles, which are numbered anew");
  if (notice && cut.others > 0)
    notice(file.string() + ": " + std::to_string(cut.others) +
           " cells left out: no triangles or polygons");
  return surface;
}

}  // namespace plume
