/// PNG pictures in memory, by libpng.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace plume {

/// Samples row by row from the top, the channels of a pixel side by side: gray, gray and alpha,
/// red, green and blue, or these and alpha (not premultiplied).
struct PngPicture {
  std::uint32_t width = 0, height = 0;
  int channels = 0;                    ///< 1 to 4; encode_png() takes 3 and 4
  int bits = 8;                        ///< of the file's samples, 8 or 16
  std::vector<std::uint16_t> samples;  ///< 0 to 2^bits - 1
};

/// What libpng says of an error goes to `error`, and nothing is returned, where memory runs out,
/// the picture is larger than PNG allows, or a text has no name. Texts, name and value, are UTF-8;
/// libpng shortens names to 79 characters.
std::vector<unsigned char> encode_png(const PngPicture& picture,
                                      const std::vector<std::pair<std::string, std::string>>& texts,
                                      std::string& error);

/// Whether bytes begin as every PNG does.
bool is_png(std::span<const unsigned char> bytes);

/// Colours of a palette are looked up. Of a damaged file, or where memory runs out, `error` says
/// why, and the picture means nothing.
PngPicture decode_png(std::span<const unsigned char> bytes, std::string& error);

}  // namespace plume
