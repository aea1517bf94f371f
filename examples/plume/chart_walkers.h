/// The other walkers of curvilinear grids, for charts.
#pragma once

#include <vector>

#include "chart_ways.h"

namespace plume::command {

/// Ways by the thesis' walkers, at orders 1 and 3, ray by ray and in closed form: hexahedra's faces
/// as two triangles each, decided by Plücker coordinates; and its hybrid, bilinear patches
/// throughout (traverse/grid_walker.h). None where the scene is not a curvilinear grid. They keep a
/// copy of the grid, and a reference to the scene.
std::vector<ChartWay> other_walkers(const Scene& scene, const Camera& camera,
                                    const RenderSettings& base);

}  // namespace plume::command
