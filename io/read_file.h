/// What can be told of a file before a reader opens it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace plume {

/// The extension in lower case with its dot; empty where there is none.
std::string lower_extension(const std::filesystem::path& file);

/// Throws Error unless this is a regular file that can be read and, unless `may_be_empty`, has
/// something in it.
void check_readable(const std::filesystem::path& file, bool may_be_empty = false);

/// The file's first bytes, at most `count`. Throws Error when it cannot be read.
std::string first_bytes(const std::filesystem::path& file, std::size_t count);

/// Throws Error unless an XML file of VTK's ends as it must. VTK reads truncated appended data as
/// zeros.
void check_vtk_xml_end(const std::filesystem::path& file);

bool looks_like_netcdf(const std::string& first_bytes);
bool looks_like_hdf5(const std::string& first_bytes);

}  // namespace plume
