#include "vtk_samples.h"

#include <vtkDataSet.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>

#include "plume/io/vtk_from_mesh.h"
#include "plume/mesh/validate.h"
#include "plume/tests/reference/box_chord.h"

namespace plume::atlas {

MethodWalks vtk_walks(const SceneMesh& scene) {
  const Bounds bounds = check_structure(scene.mesh);
  MethodWalks made{"VTK's locator, points", false, false, Surface::faces,
                   bounds.diagonal() / 200, {}};
  // Hidden cells are but marked in VTK's grids: they are left out here.
  const auto data =
      scene.mesh.is_rectilinear() ? rectilinear_from(scene.mesh) : unstructured_from(scene.mesh);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  const Array& scalars = scene.mesh.fields.front().values;
  const double step = made.resolution;
  for (const Ray& ray : scene.rays) {
    AtlasWalk& walk = made.walks.emplace_back();
    if (!(std::hypot(ray.direction[0], ray.direction[1], ray.direction[2]) > 0.5)) continue;
    const auto span = reference::box_span(bounds.low, bounds.high, ray.origin, ray.direction);
    const double from = std::max(span[0], ray.t_min);
    if (!std::isfinite(from) || !std::isfinite(span[1])) continue;
    for (double t = from + 0.5 * step; t < span[1]; t += step) {
      double place[3], parameters[3], weights[64];
      for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + t * ray.direction[a];
      const vtkIdType id = locator->FindCell(place, 0, cell, parameters, weights);
      if (id < 0) continue;
      if (!scene.mesh.hidden_cells.empty() &&
          scene.mesh.hidden_cells.at<int>(static_cast<std::size_t>(id)) != 0)
        continue;
      double scalar = 0;
      for (vtkIdType i = 0; i < cell->GetNumberOfPoints(); ++i)
        scalar += weights[i] * scalars.at<double>(
                                   static_cast<std::size_t>(cell->GetPointId(static_cast<int>(i))));
      walk.spans.push_back(
          {static_cast<std::uint32_t>(id), t - 0.5 * step, t + 0.5 * step, scalar, scalar});
    }
  }
  return made;
}

}  // namespace plume::atlas
