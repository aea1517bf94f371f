/// Images into files, and back for tests.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "plume/lib/image.h"

namespace plume {

/// What a file holds besides the pixels, and how it holds these.
struct ImageFileOptions {
  /// PNG: bits per channel, 8 or 16.
  int png_bits = 8;
  /// PNG: the colour behind the picture, display (sRGB) values 0 to 1; a negative first value keeps
  /// the picture transparent (unassociated alpha, as PNG has it).
  float background[3] = {-1, 0, 0};
  /// Kept in the file: name and value, such as {"plume:field", "Density"}.
  std::vector<std::pair<std::string, std::string>> metadata;
};

/// .png: sRGB-encoded colour. .exr: linear float RGBA (associated alpha) with the image's further
/// channels under their names. The file appears under its name only when it is whole. Throws Error
/// for another extension or a failed write.
void write_image(const Image& image, const std::filesystem::path& file,
                 const ImageFileOptions& options = {});

/// Throws Error unless an image could be written to that name: its extension is known, its folder
/// exists and is writable. Leaves nothing behind. Called before a render, not after.
void check_image_path(const std::filesystem::path& file);

/// Reads what write_image() wrote (linear, premultiplied; channels of an EXR). Throws Error.
Image read_image(const std::filesystem::path& file);

}  // namespace plume
