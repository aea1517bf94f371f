/// VTK's arrays and fields as ours, without a copy where the types allow.
#pragma once

#include <vtkSmartPointer.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "plume/io/read_mesh.h"
#include "plume/mesh/mesh.h"

class vtkDataArray;
class vtkDataSet;

namespace plume {

/// Borrows the array's values and keeps it alive. Types that an Array cannot hold become float.
Array to_array(vtkDataArray* values);

/// Coordinates: float or double stay, other types become float.
Array to_coordinates(vtkDataArray* values);

/// The data set's point and cell fields: all arrays of numbers but ghost arrays and ids. Names are
/// made unique, `active` is that of the active scalars (empty where there are none). Throws Error
/// for an array with too few or too many values.
std::vector<Field> fields_of(vtkDataSet& data, const std::filesystem::path& file,
                             const Notice& notice, std::string& active);

/// The cells' tuples of `field`, in the order of `cells`.
Field select_cells(const Field& field, const std::vector<std::int64_t>& cells);

}  // namespace plume
