#include "plume/io/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>

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
template <class T>
T quantized(double value) {
  constexpr double top = std::numeric_limits<T>::max();
  return value >= 0 ? static_cast<T>(std::lround(value * top)) : T{0};
}

template <class T>
std::vector<T> png_pixels(const Image& image, const ImageFileOptions& options) {
  const std::size_t channels = options.background[0] >= 0 ? 3 : 4;
  std::vector<T> pixels;
  pixels.reserve(image.rgba.size() / 4 * channels);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const auto display = display_pixel(&image.rgba[i], options);
    for (std::size_t c = 0; c < channels; ++c) pixels.push_back(quantized<T>(display[c]));
  }
  return pixels;
}

/// R, G, B, A and the further channels, interleaved.
std::vector<float> exr_pixels(const Image& image) {
  std::vector<float> pixels;
  pixels.reserve(image.rgba.size() / 4 * (4 + image.channels.size()));
  for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
    pixels.insert(pixels.end(), &image.rgba[4 * i], &image.rgba[4 * i] + 4);
    for (const Channel& channel : image.channels) pixels.push_back(channel.values[i]);
  }
  return pixels;
}

/// OpenImageIO's last word, on one line.
std::string one_line(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

/// Encodes in memory: OpenImageIO's own files lose errors of the last buffer, which is flushed when
/// the file is closed, so that a full disk would pass for a success.
std::vector<unsigned char> encoded(const char* format, const OIIO::ImageSpec& spec,
                                   const void* pixels, const fs::path& file) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) {
    fail(file, "not written: OpenImageIO lacks the format " + std::string(format) + " (" +
                   one_line(OIIO::geterror()) + "); install it with that format");
  }
  if (!output->set_ioproxy(&memory) || !output->open(file.filename().string(), spec) ||
      !output->write_image(spec.format, pixels) || !output->close()) {
    fail(file, "not written: OpenImageIO could not encode it (" + one_line(output->geterror()) +
                   "); try a smaller image or another format");
  }
  return bytes;
}

void write_pixels(const char* format, const OIIO::ImageSpec& spec, const void* pixels,
                  const fs::path& file) {
  const std::vector<unsigned char> bytes = encoded(format, spec, pixels, file);
  write_whole_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void write_png(const Image& image, const fs::path& file, const ImageFileOptions& options) {
  if (options.png_bits != 8 && options.png_bits != 16) {
    fail(file, "not written: a PNG of " + std::to_string(options.png_bits) +
                   " bits per channel; choose 8 or 16");
  }
  const bool opaque = options.background[0] >= 0;
  OIIO::ImageSpec spec(image.width, image.height, opaque ? 3 : 4,
                       options.png_bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16);
  spec.attribute("oiio:ColorSpace", "sRGB");
  // The values are un-premultiplied already.
  spec.attribute("oiio:UnassociatedAlpha", 1);
  for (const auto& [name, value] : options.metadata) spec.attribute(name, value);
  if (options.png_bits == 8) {
    write_pixels("png", spec, png_pixels<std::uint8_t>(image, options).data(), file);
  } else {
    write_pixels("png", spec, png_pixels<std::uint16_t>(image, options).data(), file);
  }
}

void write_exr(const Image& image, const fs::path& file, const ImageFileOptions& options) {
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(4 + image.channels.size()),
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B", "A"};
  for (const Channel& channel : image.channels) spec.channelnames.push_back(channel.name);
  spec.alpha_channel = 3;
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("compression", "zip");
  for (const auto& [name, value] : options.metadata) spec.attribute(name, value);
  write_pixels("openexr", spec, exr_pixels(image).data(), file);
}

/// Puts a PNG's values, or an EXR's first four channels, into `image`.
void take_colors(const OIIO::ImageSpec& spec, const std::vector<float>& pixels, Format format,
                 Image& image) {
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  const std::size_t colors = std::min<std::size_t>(channels, 4);
  for (std::size_t i = 0; i < image.rgba.size() / 4; ++i) {
    float* out = &image.rgba[4 * i];
    out[3] = 1;
    for (std::size_t c = 0; c < colors; ++c) out[c] = pixels[i * channels + c];
    if (format == Format::exr) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      out[c] = static_cast<float>(srgb_to_linear(static_cast<double>(out[c])) *
                                  static_cast<double>(out[3]));
    }
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
  OIIO::ImageSpec raw;
  raw.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), format == Format::png ? &raw : nullptr);
  if (!input) fail(file, "cannot be read (" + one_line(OIIO::geterror()) + "); check the path");
  const OIIO::ImageSpec spec = input->spec();
  if (spec.nchannels < 3) {
    fail(file,
         "has " + std::to_string(spec.nchannels) + " channels; write_image() writes at least 3");
  }

  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> pixels(static_cast<std::size_t>(spec.width) *
                            static_cast<std::size_t>(spec.height) * channels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data())) {
    fail(file, "is damaged (" + one_line(input->geterror()) + "); write it again");
  }

  Image image;
  image.width = spec.width;
  image.height = spec.height;
  image.rgba.resize(pixels.size() / channels * 4);
  take_colors(spec, pixels, format, image);
  for (std::size_t c = 4; c < channels; ++c) {
    Channel channel{spec.channelnames[c], {}};
    for (std::size_t i = c; i < pixels.size(); i += channels) channel.values.push_back(pixels[i]);
    image.channels.push_back(std::move(channel));
  }
  return image;
}

}  // namespace plume
