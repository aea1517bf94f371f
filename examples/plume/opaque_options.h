/// Opaque surfaces on the command line.
#pragma once

#include <string>
#include <vector>

#include "plume/io/read_mesh.h"
#include "plume/lib/opaque_surface.h"

namespace plume::command {

/// "FILE[:R,G,B]": the triangles and polygons of a file, of one colour, gray unless said otherwise.
/// R, G, B are display values, 0 to 1. Throws Error, naming the text or the file.
OpaqueSurface read_opaque_surface(const std::string& text, const Notice& notice);

/// "imin", "imax", "jmin", ... [":R,G,B"]: a side of the grid that is shown. Throws Error, naming
/// the text, also where the mesh is no grid.
OpaqueSurface parse_wall(const std::string& text, const Mesh& mesh);

}  // namespace plume::command
