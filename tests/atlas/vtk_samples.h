/// Point sampling through VTK's cell locator, as most programs do it.
#pragma once

#include "atlas_walk.h"
#include "scenes.h"

namespace plume::atlas {

/// 200 samples a diagonal of the bounds, each the middle of a stretch of its own; cells by
/// vtkStaticCellLocator::FindCell() with a tolerance of 0, scalars by VTK's weights.
MethodWalks vtk_walks(const SceneMesh& mesh);

}  // namespace plume::atlas
