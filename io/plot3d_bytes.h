/// Reads the numbers of a Plot3D file, which may be of either byte order or text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace plume {

/// Integers of a binary file, at a position.
class Plot3dIntegers {
 public:
  Plot3dIntegers(const std::filesystem::path& file, bool little_endian);

  /// The integer at `position`, which moves behind it; nothing past the end of the file.
  std::optional<std::int32_t> next();
  std::uint64_t position() const { return position_; }
  void skip(std::uint64_t bytes) { position_ += bytes; }
  std::uint64_t size() const { return size_; }

 private:
  std::ifstream stream_;
  bool little_endian_;
  std::uint64_t position_ = 0;
  std::uint64_t size_;
};

/// True where the file starts with nothing but what numbers are written with.
bool looks_like_numbers(const std::string& first_bytes);

/// The numbers of a text file, counted. Throws Error for what C's scanf() cannot read although
/// Fortran writes it: exponents with D, repetitions like 3*0., commas.
class Plot3dText {
 public:
  explicit Plot3dText(const std::filesystem::path& file);

  std::uint64_t count() const { return count_; }
  /// The i-th number, if it is an integer among the first ones of the file.
  std::optional<std::int32_t> integer(std::size_t i) const;

 private:
  std::string start_;
  std::uint64_t count_ = 0;
};

}  // namespace plume
