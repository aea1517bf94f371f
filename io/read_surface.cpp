#include "plume/io/read_surface.h"

#include <vtkDataObject.h>
#include <vtkDataSet.h>

#include <algorithm>

#include "plume/io/read_formats.h"
#include "plume/io/vtk_data_sets.h"
#include "plume/io/vtk_points.h"
#include "plume/mesh/error.h"

namespace plume {

TriangleSurface read_surface(const std::filesystem::path& file, const ReadOptions& options,
                             const Notice& notice) {
  const auto data = read_data(file, options, notice);
  if (auto points = point_set_in(*data, file, true, notice)) return {std::move(*points), {}};
  const auto sets = data_sets_in(*data);
  if (std::any_of(sets.begin(), sets.end(), [](const auto& set) {
        for (vtkIdType cell = 0; cell < set->GetNumberOfCells(); ++cell)
          if (is_volume_cell_type(set->GetCellType(cell))) return true;
        return false;
      }))
    throw Error(file.string() + ": has volume cells already; render it as it is");
  TriangleSurface surface = triangles_in(*data, file, notice);
  if (surface.triangles.empty())
    throw Error(file.string() +
                ": neither points alone nor triangles in it; check that it is what its name says");
  return surface;
}

void report_tetrahedra(const Tetrahedralization& result, const std::filesystem::path& file,
                       const std::string& what, const Notice& notice) {
  if (!notice) return;
  for (const Finding& finding : result.findings) notice(file.string() + ": " + describe(finding));
  notice(file.string() + ": " + what + " became " + std::to_string(result.mesh.cell_count()) +
         " tetrahedra (by " + result.engine + ")");
}

}  // namespace plume
