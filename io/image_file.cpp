#include "plume/io/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <span>

#include "plume/io/exr_bytes.h"
#include "plume/io/png_bytes.h"
#include "plume/io/whole_file.h"
#include "plume/lib/srgb.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

namespace fs = std::filesystem;

enum class Format { png, exr };

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw Error(file.string() + ": " + what);
}

Format format_of(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (extension == ".png") return Format::png;
  if (extension == ".exr") return Format::exr;
  fail(file, extension.empty() ? "has no extension; images end in .png or .exr"
                               : "unknown image extension '" + extension + "'; use .png or .exr");
}

void check_image(const Image& image, const fs::path& file) {
  const auto expect = [&](const std::string& what, std::size_t values, std::size_t per_pixel) {
    const std::size_t pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (values != per_pixel * pixels) {
      fail(file, "not written: " + what + " has " + std::to_string(values) + " values, but " +
                     std::to_string(image.width) + " x " + std::to_string(image.height) +
                     " pixels need " + std::to_string(per_pixel * pixels));
    }
  };
  if (image.width <= 0 || image.height <= 0) {
    fail(file, "not written: an image of " + std::to_string(image.width) + " x " +
                   std::to_string(image.height) + " pixels; give at least 1 x 1");
  }
  expect("the image", image.rgba.size(), 4);
  std::set<std::string> names{"R", "G", "B", "A"};
  for (const Channel& channel : image.channels) {
    expect("channel '" + channel.name + "'", channel.values.size(), 1);
    if (channel.name.empty() || !names.insert(channel.name).second) {
      fail(file, "not written: channel name '" + channel.name +
                     "' is empty or taken; give each channel a name of its own");
    }
  }
}

/// Display values of a pixel, 0 to 1; the fourth is alpha.
std::array<double, 4> display_pixel(const float* pixel, const ImageFileOptions& options) {
  const double alpha = std::clamp(static_cast<double>(pixel[3]), 0.0, 1.0);
  const bool opaque = options.background[0] >= 0;
  std::array<double, 4> out{0, 0, 0, opaque ? 1.0 : alpha};
  for (std::size_t c = 0; c < 3; ++c) {
    double linear = static_cast<double>(pixel[c]);
    if (opaque) {
      linear += (1 - alpha) * srgb_to_linear(static_cast<double>(options.background[c]));
    } else {
      linear = alpha > 0 ? linear / alpha : 0.0;
    }
    out[c] = linear_to_srgb(std::clamp(linear, 0.0, 1.0));
  }
  return out;
}

/// A NaN would turn into any integer; here it becomes 0.
std::uint16_t quantized(double value, double top) {
  return value >= 0 ? static_cast<std::uint16_t>(std::lround(value * top)) : std::uint16_t{0};
}

/// What a library says, on one line.
std::string one_line(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

/// Pictures are encoded in memory and written whole: the libraries' own files lose errors of the
/// last buffer, which is flushed when the file is closed, so that a full disk would pass for a
/// success.
void write_bytes(const fs::path& file, const std::vector<unsigned char>& bytes) {
  write_whole_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

[[noreturn]] void fail_to_encode(const fs::path& file, const std::string& why) {
  fail(file, "not written: it could not be encoded (" + one_line(why) +
                 "); try a smaller image or another format");
}

void write_png(const Image& image, const fs::path& file, const ImageFileOptions& options) {
  if (options.png_bits != 8 && options.png_bits != 16) {
    fail(file, "not written: a PNG of " + std::to_string(options.png_bits) +
                   " bits per channel; choose 8 or 16");
  }
  PngPicture picture;
  picture.width = static_cast<std::uint32_t>(image.width);
  picture.height = static_cast<std::uint32_t>(image.height);
  picture.channels = options.background[0] >= 0 ? 3 : 4;
  picture.bits = options.png_bits;
  const double top = picture.bits == 8 ? 255 : 65535;
  const auto channels = static_cast<std::size_t>(picture.channels);
  picture.samples.reserve(image.rgba.size() / 4 * channels);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const auto display = display_pixel(&image.rgba[i], options);
    for (std::size_t c = 0; c < channels; ++c)
      picture.samples.push_back(quantized(display[c], top));
  }
  std::string error;
  const auto bytes = encode_png(picture, options.metadata, error);
  if (bytes.empty()) fail_to_encode(file, error);
  write_bytes(file, bytes);
}

void write_exr(const Image& image, const fs::path& file, const ImageFileOptions& options) {
  std::vector<unsigned char> bytes;
  try {
    bytes = encode_exr(image, options.metadata);
  } catch (const std::exception& error) {
    fail_to_encode(file, error.what());
  }
  write_bytes(file, bytes);
}

std::vector<unsigned char> bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) fail(file, "cannot be read (it cannot be opened); check the path");
  return bytes;
}

void expect_colors(const fs::path& file, int channels, bool has_colors) {
  if (!has_colors)
    fail(file, "has " + std::to_string(channels) +
                   " channels; write_image() writes red, green and blue at least");
}

Image read_png(const fs::path& file, std::span<const unsigned char> bytes) {
  if (!is_png(bytes)) fail(file, "cannot be read (it is no PNG); check the path");
  std::string error;
  const PngPicture picture = decode_png(bytes, error);
  if (!error.empty()) fail(file, "is damaged (" + one_line(error) + "); write it again");
  expect_colors(file, picture.channels, picture.channels >= 3);

  Image image;
  image.width = static_cast<int>(picture.width);
  image.height = static_cast<int>(picture.height);
  const auto channels = static_cast<std::size_t>(picture.channels);
  const float top = picture.bits == 16 ? 65535.0f : 255.0f;
  image.rgba.resize(picture.samples.size() / channels * 4);
  for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
    const std::uint16_t* const in = &picture.samples[i * channels];
    float* const out = &image.rgba[4 * i];
    out[3] = channels == 4 ? static_cast<float>(in[3]) / top : 1;
    for (std::size_t c = 0; c < 3; ++c) {
      const double display = static_cast<double>(static_cast<float>(in[c]) / top);
      out[c] = static_cast<float>(srgb_to_linear(display) * static_cast<double>(out[3]));
    }
  }
  return image;
}

Image read_exr(const fs::path& file, std::span<const unsigned char> bytes) {
  std::optional<ExrPicture> picture;
  try {
    picture.emplace(bytes);
  } catch (const std::exception& error) {
    fail(file, "cannot be read (" + one_line(error.what()) + "); check the path");
  }
  expect_colors(file, picture->channel_count(), picture->has_colors());
  try {
    return picture->read();
  } catch (const std::exception& error) {
    fail(file, "is damaged (" + one_line(error.what()) + "); write it again");
  }
}

}  // namespace

void write_image(const Image& image, const fs::path& file, const ImageFileOptions& options) {
  const Format format = format_of(file);
  check_image(image, file);
  check_image_path(file);
  format == Format::png ? write_png(image, file, options) : write_exr(image, file, options);
}

void check_image_path(const fs::path& file) {
  format_of(file);
  check_writable(file);
}

Image read_image(const fs::path& file) {
  const Format format = format_of(file);
  const std::vector<unsigned char> bytes = bytes_of(file);
  return format == Format::png ? read_png(file, bytes) : read_exr(file, bytes);
}

}  // namespace plume
