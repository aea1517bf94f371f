/// What VTK says while it reads or writes, caught instead of printed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "plume/io/read_mesh.h"

namespace plume {

/// Calls `work`, which calls VTK. The first error that VTK reports in this thread, through whatever
/// object, becomes an Error "file: message; remedy"; warnings go to `notice`; nothing is printed.
/// VTK's output window belongs to the process, so calls take turns. Messages with
/// one of the texts `expected` in them are dropped.
void with_vtk_errors(const std::filesystem::path& file, const Notice& notice,
                     const std::string& remedy, const std::function<void()>& work,
                     const std::vector<std::string>& expected = {});

inline constexpr const char* check_the_file =
    "check that the file is whole and of the format that its name says";

}  // namespace plume
