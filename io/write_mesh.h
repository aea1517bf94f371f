/// Meshes into files.
#pragma once

#include <filesystem>

#include "plume/mesh/mesh.h"

namespace plume {

/// Writes .vtu (explicit cells or a grid), .vts (a grid), .vtr (a rectilinear grid), .vti (a
/// regular one, by its ends: coordinates may change in the last place) or .vtk (any; binary
/// legacy). In .vtu and .vts a rectilinear grid's points are written out.
///
/// The file appears under its name only when it is whole: it is written beside it and renamed.
/// Throws Error for another extension, an unwritable place, a grid asked of explicit cells, a
/// rectilinear one of points, a regular one of coordinates that are not equidistant.
void write_mesh(const Mesh& mesh, const std::filesystem::path& file);

}  // namespace plume
