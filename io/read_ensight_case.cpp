#include "plume/io/read_ensight_case.h"

#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "plume/io/read_file.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// Bytes of a binary geometry file up to its first part's points, and of a variable file up to its
// first value: lines of 80 characters, and part numbers.
constexpr std::uintmax_t least_geometry = 5 * 80 + 80 + 4 + 80;
constexpr std::uintmax_t least_variable = 80 + 80 + 4 + 80;

// Names in a case file may be quoted, and are relative to it; those of time steps have wildcards.
std::optional<std::filesystem::path> file_named(const std::filesystem::path& file,
                                                std::string name) {
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"')
    name = name.substr(1, name.size() - 2);
  if (name.find('*') != std::string::npos) return std::nullopt;
  check_readable(file.parent_path() / name);
  return file.parent_path() / name;
}

bool is_binary(const std::filesystem::path& geometry) {
  return first_bytes(geometry, 80).find("Binary") != std::string::npos;
}

void check_length(const std::filesystem::path& file, std::uintmax_t least) {
  const auto length = std::filesystem::file_size(file);
  if (length < least)
    throw Error(file.string() + ": truncated: even an empty part takes " + std::to_string(least) +
                " bytes, and it has " + std::to_string(length) + "; copy it again");
}

}  // namespace

void check_ensight_case(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) {
    throw Error(file.string() + ": " + what + "; check that it is a whole EnSight Gold case file");
  };
  std::ifstream stream(file);
  std::string section;
  bool has_format = false, has_model = false, binary = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const auto words = words_of(line.substr(0, line.find('#')));
    if (words.empty()) continue;
    if (words.size() == 1 && (words[0] == "FORMAT" || words[0] == "GEOMETRY" ||
                              words[0] == "VARIABLE" || words[0] == "TIME" || words[0] == "FILE" ||
                              words[0] == "MATERIAL" || words[0] == "SCRIPTS")) {
      section = words[0];
      continue;
    }
    if (section.empty()) fail("line " + std::to_string(number) + " is in no section");
    const auto colon = line.find(':');
    const auto values =
        colon == std::string::npos ? std::vector<std::string>{} : words_of(line.substr(colon + 1));
    if (section == "FORMAT") has_format = has_format || line.find("ensight") != std::string::npos;
    if (section == "GEOMETRY" && words[0] == "model:") {
      if (values.empty()) fail("line " + std::to_string(number) + " names no geometry file");
      const bool coordinates_only = values.back() == "change_coords_only" && values.size() > 1;
      const auto geometry =
          file_named(file, coordinates_only ? values[values.size() - 2] : values.back());
      binary = geometry && is_binary(*geometry);
      if (binary) check_length(*geometry, least_geometry);
      has_model = true;
    }
    if (section == "VARIABLE") {
      if (values.size() < 2)
        fail("line " + std::to_string(number) + " names no variable and file, '" + words[0] + "'");
      if (words[0] == "constant") continue;
      const auto variable = file_named(file, values.back());
      if (variable && binary) check_length(*variable, least_variable);
    }
  }
  if (!has_format) fail("no format 'ensight gold'");
  if (!has_model) fail("no geometry");
}

}  // namespace plume
