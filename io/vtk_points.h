/// Points and triangles of VTK's data sets.
#pragma once

#include <filesystem>
#include <optional>

#include "plume/io/read_mesh.h"
#include "plume/mesh/tetrahedralize.h"

class vtkDataObject;
class vtkPolyData;

namespace plume {

/// The data set's points and their fields where it is nothing but points: it has points, and no
/// cells but vertices. Of a composite one, all of its data sets, appended. What has no cells at all
/// counts in VTK's own formats alone, and where it has fields or `without_fields` says so: else it
/// is more likely a mesh that was cut short.
std::optional<PointSet> point_set_in(vtkDataObject& data, const std::filesystem::path& file,
                                     bool without_fields, const Notice& notice);

/// Gives the data set one cell, a vertex of all its points, for it is meant to be nothing else.
void mark_as_points(vtkPolyData& data);

/// The data set's triangles; polygons and strips are cut into triangles, and other cells left out,
/// with notices. No triangles where it has none. Throws Error for several data sets and ids out of
/// range.
TriangleSurface triangles_in(vtkDataObject& data, const std::filesystem::path& file,
                             const Notice& notice);

}  // namespace plume
