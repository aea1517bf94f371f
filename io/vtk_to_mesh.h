/// What VTK's readers give as a Mesh.
#pragma once

#include <filesystem>

#include "plume/io/read_mesh.h"

class vtkDataObject;

namespace plume {

/// The volume cells of a data set, or of all data sets in a composite one. A single structured
/// block stays a grid; several blocks become explicit cells. `file` is named in messages. Throws
/// Error where there are no volume cells.
Mesh mesh_from_vtk(vtkDataObject& data, const std::filesystem::path& file,
                   const ReadOptions& options, const Notice& notice);

}  // namespace plume
