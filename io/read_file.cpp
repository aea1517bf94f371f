#include "plume/io/read_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>

#include "plume/mesh/error.h"

namespace plume {

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void check_readable(const std::filesystem::path& file, bool may_be_empty) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw Error(file.string() + ": no such file; check the path");
  if (std::filesystem::is_directory(status))
    throw Error(file.string() + ": is a directory; name a mesh file in it");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(file.string() + ": cannot be opened; check its permissions");
  if (!may_be_empty && stream.peek() == std::ifstream::traits_type::eof())
    throw Error(file.string() + ": is empty; write it again");
}

std::string first_bytes(const std::filesystem::path& file, std::size_t count) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(file.string() + ": cannot be opened; check its permissions");
  std::string bytes(count, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

void check_vtk_xml_end(const std::filesystem::path& file) {
  if (first_bytes(file, 256).find('<') == std::string::npos)
    throw Error(file.string() + ": no XML file; check that it is what its name says");
  std::ifstream stream(file, std::ios::binary);
  const auto length = static_cast<std::streamoff>(std::filesystem::file_size(file));
  std::string end(static_cast<std::size_t>(std::min<std::streamoff>(length, 256)), '\0');
  stream.seekg(length - static_cast<std::streamoff>(end.size()));
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  if (!stream || end.find("</VTKFile>") == std::string::npos)
    throw Error(file.string() + ": truncated: it does not end with </VTKFile>; copy it again");
}

bool looks_like_netcdf(const std::string& first_bytes) {
  return first_bytes.size() >= 4 && first_bytes.starts_with("CDF") &&
         (first_bytes[3] == 1 || first_bytes[3] == 2 || first_bytes[3] == 5);
}

bool looks_like_hdf5(const std::string& first_bytes) {
  return first_bytes.starts_with("\x89HDF\r\n\x1a\n");
}

}  // namespace plume
