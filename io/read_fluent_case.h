/// What VTK's Fluent reader takes on trust, and crashes without.
#pragma once

#include <filesystem>

namespace plume {

/// Throws Error unless all sections of a Fluent case or mesh file are closed, and hold as many
/// nodes, cells and faces as the file declares. Format: ANSYS Fluent User's Guide, "Case and Data
/// File Formats".
void check_fluent_case(const std::filesystem::path& file);

}  // namespace plume
