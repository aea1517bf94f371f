/// What `plume tetrahedralize` takes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plume/io/read_mesh.h"
#include "plume/mesh/tetrahedralize.h"

namespace plume {

/// A surface's triangles, from .stl, .obj, .ply, .vtp, .vtk, .vtu and whatever else read_mesh()
/// knows; or, without triangles, a point set as read_mesh() makes tetrahedra of. Polygons are cut
/// into triangles. Throws Error where the file has volume cells, neither points nor triangles, or
/// several surfaces.
TriangleSurface read_surface(const std::filesystem::path& file, const ReadOptions& options = {},
                             const Notice& notice = {});

/// What tetrahedralize() found, and what came of it, as notices: "a.csv: 9 points became 12
/// tetrahedra (Delaunay, by TetGen)".
void report_tetrahedra(const Tetrahedralization& result, const std::filesystem::path& file,
                       const std::string& what, const Notice& notice);

}  // namespace plume
