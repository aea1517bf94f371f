#include "plume/io/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <sstream>

#include "plume/mesh/error.h"

namespace plume {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw Error(file.string() + ": " + what);
}

PlyType type_named(const std::string& name, const std::filesystem::path& file) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (kNames[i][0] == name || kNames[i][1] == name) return static_cast<PlyType>(i);
  fail(file, fmt::format("PLY header: '{:.40}' is no type of a property", name));
}

// Takes one line of the header; false at its end.
bool take_line(const std::string& line, const std::filesystem::path& file, PlyHeader& header) {
  std::istringstream words(line);
  std::string word, name, type;
  words >> word;
  if (word == "end_header") return false;
  if (word == "format") {
    words >> type;
    header.text = type == "ascii";
    header.big_endian = type == "binary_big_endian";
    if (!header.text && !header.big_endian && type != "binary_little_endian")
      fail(file, fmt::format("PLY header: unknown format '{:.40}'", type));
  } else if (word == "element") {
    PlyElement element;
    if (!(words >> element.name >> element.count))
      fail(file, fmt::format("PLY header: '{:.80}' is no element with a count", line));
    header.elements.push_back(element);
  } else if (word == "property") {
    if (header.elements.empty()) fail(file, "PLY header: a property before any element");
    PlyProperty property;
    words >> type;
    property.list = type == "list";
    if (property.list) {
      words >> type;
      property.length_type = type_named(type, file);
      if (property.length_type >= PlyType::float32)
        fail(file, fmt::format("PLY header: a list's length of type '{}'", type));
      words >> type;
    }
    property.type = type_named(type, file);
    if (!(words >> property.name)) fail(file, "PLY header: a property without a name");
    header.elements.back().properties.push_back(property);
  } else if (!word.empty() && word != "comment" && word != "obj_info") {
    fail(file, fmt::format("PLY header: unknown word '{:.40}'", word));
  }
  return true;
}

}  // namespace

PlyHeader read_ply_header(std::string_view bytes, const std::filesystem::path& file) {
  if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r"))
    fail(file, "not a PLY file, which starts with 'ply'; check that it is what its name says");
  PlyHeader header;
  bool format = false;
  header.length = bytes.find('\n') + 1;
  for (bool more = true; more;) {
    const std::size_t end = bytes.find('\n', header.length);
    if (end == std::string_view::npos || header.length == 0)
      fail(file, "truncated: its PLY header does not end");
    std::string line(bytes.substr(header.length, end - header.length));
    if (line.ends_with('\r')) line.pop_back();
    format = format || line.starts_with("format");
    more = take_line(line, file, header);
    header.length = end + 1;
  }
  if (!format) fail(file, "PLY header: no format; write it again");
  return header;
}

}  // namespace plume
