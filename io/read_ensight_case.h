/// What VTK's EnSight reader takes on trust, and crashes without.
#pragma once

#include <filesystem>

namespace plume {

/// Throws Error unless the case file has a format and a geometry, each of its variables has a name
/// and a file, and the files that it names without wildcards are there and not empty.
void check_ensight_case(const std::filesystem::path& file);

}  // namespace plume
