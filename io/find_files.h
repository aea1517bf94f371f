/// Several files by one name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plume {

/// Whether `name` stands for several files: there is no file of that very name, and it has a place
/// for a number ("flow_%04d.vtu", see numbered_name.h) or a shell's wildcards (* ? [...]).
bool is_file_pattern(const std::string& name);

/// The files that a pattern matches: those with a number in its place, by number; or those that a
/// shell would find, in the order of names in which digits that stand together are one number
/// ("t9" before "t10"). Throws Error where there is none.
std::vector<std::filesystem::path> find_files(const std::string& pattern);

}  // namespace plume
