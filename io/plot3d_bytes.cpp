#include "plume/io/plot3d_bytes.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>
#include <vector>

#include "plume/mesh/error.h"

namespace plume {
namespace {

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

Plot3dIntegers::Plot3dIntegers(const std::filesystem::path& file, bool little_endian)
    : stream_(file, std::ios::binary),
      little_endian_(little_endian),
      size_(std::filesystem::file_size(file)) {}

std::optional<std::int32_t> Plot3dIntegers::next() {
  if (position_ + 4 > size_) return std::nullopt;
  unsigned char bytes[4];
  stream_.seekg(static_cast<std::streamoff>(position_));
  stream_.read(reinterpret_cast<char*>(bytes), 4);
  if (!stream_) return std::nullopt;
  position_ += 4;
  if (little_endian_) std::reverse(bytes, bytes + 4);
  const std::uint32_t value = static_cast<std::uint32_t>(bytes[0]) << 24 |
                              static_cast<std::uint32_t>(bytes[1]) << 16 |
                              static_cast<std::uint32_t>(bytes[2]) << 8 | bytes[3];
  return static_cast<std::int32_t>(value);
}

bool looks_like_numbers(const std::string& first_bytes) {
  return !first_bytes.empty() && std::all_of(first_bytes.begin(), first_bytes.end(), [](char c) {
    return is_space(c) || std::strchr("0123456789+-.eEdD,*nNaAiIfF", c) != nullptr;
  }) && first_bytes.find('\0') == std::string::npos;
}

Plot3dText::Plot3dText(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> buffer(1 << 20);
  bool in_number = false;
  std::uint64_t line = 1;
  while (stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size())),
         stream.gcount() > 0) {
    const std::string_view text(buffer.data(), static_cast<std::size_t>(stream.gcount()));
    // More than the dimensions of any block structure met in practice.
    if (start_.size() < buffer.size()) start_ += text;
    for (const char c : text) {
      if (c == '\n') ++line;
      if (c == 'D' || c == 'd' || c == '*' || c == ',')
        throw Error(file.string() + ": line " + std::to_string(line) + " has a '" + c +
                    "', which only Fortran reads as part of a number; write E exponents, no "
                    "repetitions and no commas");
      const bool number = !is_space(c);
      if (number && !in_number) ++count_;
      in_number = number;
    }
  }
}

std::optional<std::int32_t> Plot3dText::integer(std::size_t i) const {
  const char* at = start_.data();
  const char* const end = at + start_.size();
  for (std::size_t skipped = 0;; ++skipped) {
    while (at != end && is_space(*at)) ++at;
    if (at == end) return std::nullopt;
    if (skipped == i) break;
    while (at != end && !is_space(*at)) ++at;
  }
  std::int32_t value = 0;
  const auto [stop, error] = std::from_chars(at, end, value);
  if (error != std::errc() || (stop != end && !is_space(*stop))) return std::nullopt;
  return value;
}

}  // namespace plume
