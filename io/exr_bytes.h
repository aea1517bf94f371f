/// EXR pictures in memory, by OpenEXR.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "plume/lib/image.h"

namespace plume {

/// Single-precision R, G, B, A and the image's further channels, losslessly compressed (ZIP);
/// texts, name and value, are attributes. Throws a std::exception where OpenEXR fails.
std::vector<unsigned char> encode_exr(
    const Image& image, const std::vector<std::pair<std::string, std::string>>& texts);

/// A picture whose header has been read.
class ExrPicture {
 public:
  /// Throws a std::exception where there is no EXR picture. The bytes are borrowed.
  explicit ExrPicture(std::span<const unsigned char> bytes);
  ~ExrPicture();
  ExrPicture(const ExrPicture&) = delete;
  ExrPicture& operator=(const ExrPicture&) = delete;

  int channel_count() const;
  bool has_colors() const;  ///< R, G and B
  /// Alpha is 1 where there is none. Throws a std::exception where the file is damaged.
  Image read() const;

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

}  // namespace plume
