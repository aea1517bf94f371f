/// What a PLY file says of itself (G. Turk, "The PLY Polygon File Format", 1994).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plume {

/// Of a property's values.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool list = false;
  PlyType length_type = PlyType::uint8;
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool text = false, big_endian = false;
  std::vector<PlyElement> elements;
  std::size_t length = 0;  // in bytes
};

/// Throws Error, naming the file and the word, where `bytes`, the file's, start with no PLY header.
PlyHeader read_ply_header(std::string_view bytes, const std::filesystem::path& file);

}  // namespace plume
