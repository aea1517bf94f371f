/// What the header of a VTK XML file says of a field's values.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "plume/mesh/mesh.h"

namespace plume {

/// The least and greatest value of a field (of its magnitude, where it has several components) in
/// a .vtu, .vts, .vtr or .vti file, as VTK's writers put it into the header: RangeMin and RangeMax.
/// Nothing where the file does not say so in its first megabyte, before the arrays (in a file of
/// text they come in between), or says nonsense: it is a hint, not to be relied upon.
std::optional<std::array<double, 2>> vtk_xml_range(const std::filesystem::path& file,
                                                   const std::string& field,
                                                   Association association);

}  // namespace plume
