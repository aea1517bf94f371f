#include "plume/io/png_bytes.h"

#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>

namespace plume {
namespace {

// libpng leaves by a long jump on an error: between setjmp() and its end a function of this file
// begins nothing that has a destructor.
[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

// A warning is of what can be shown nonetheless.
void on_warning(png_structp, png_const_charp) {}

// No exception may pass through libpng.
bool grow(std::vector<unsigned char>& all, const unsigned char* bytes, std::size_t size) {
  try {
    all.insert(all.end(), bytes, bytes + size);
  } catch (const std::bad_alloc&) {
    return false;
  }
  return true;
}

void append(png_structp png, png_bytep bytes, std::size_t size) {
  if (!grow(*static_cast<std::vector<unsigned char>*>(png_get_io_ptr(png)), bytes, size))
    png_error(png, "no memory");
}

void nothing_to_flush(png_structp) {}

struct Source {
  std::span<const unsigned char> rest;
};

void take(png_structp png, png_bytep to, std::size_t size) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (size > source.rest.size()) png_error(png, "the file ends early");
  std::memcpy(to, source.rest.data(), size);
  source.rest = source.rest.subspan(size);
}

// Rows of samples as libpng takes them: bytes, or pairs of bytes of this machine's order.
struct Rows {
  std::vector<unsigned char> bytes;
  std::vector<png_bytep> rows;

  Rows(std::uint32_t height, std::size_t row_bytes) : bytes(row_bytes * height), rows(height) {
    for (std::size_t y = 0; y < height; ++y) rows[y] = bytes.data() + y * row_bytes;
  }
};

bool encode(png_structp png, png_infop info, const PngPicture& picture,
            std::vector<png_text>& texts, Rows& rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_IHDR(png, info, picture.width, picture.height, picture.bits,
               picture.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
  png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
  png_write_info(png, info);
  if (picture.bits == 16 && std::endian::native == std::endian::little) png_set_swap(png);
  png_write_image(png, rows.rows.data());
  png_write_end(png, nullptr);
  return true;
}

bool decode_header(png_structp png, png_infop info, PngPicture& picture) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_info(png, info);
  png_set_expand(png);
  if (std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  picture.width = png_get_image_width(png, info);
  picture.height = png_get_image_height(png, info);
  picture.channels = png_get_channels(png, info);
  picture.bits = png_get_bit_depth(png, info);
  return true;
}

bool decode_rows(png_structp png, Rows& rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_image(png, rows.rows.data());
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

std::vector<unsigned char> encode_png(const PngPicture& picture,
                                      const std::vector<std::pair<std::string, std::string>>& texts,
                                      std::string& error) {
  std::vector<unsigned char> bytes;
  std::vector<png_text> items;
  for (const auto& [name, value] : texts) {
    png_text item{};
    const bool ascii = std::all_of(value.begin(), value.end(),
                                   [](char c) { return static_cast<unsigned char>(c) < 128; });
    item.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    // libpng reads these, and copies them.
    item.key = const_cast<char*>(name.c_str());
    item.text = const_cast<char*>(value.c_str());
    items.push_back(item);
  }
  const std::size_t row_samples =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.channels);
  const std::size_t sample_bytes = picture.bits == 16 ? 2 : 1;
  Rows rows(picture.height, row_samples * sample_bytes);
  if (picture.bits == 16)
    std::memcpy(rows.bytes.data(), picture.samples.data(), rows.bytes.size());
  else
    std::transform(picture.samples.begin(), picture.samples.end(), rows.bytes.begin(),
                   [](std::uint16_t sample) { return static_cast<unsigned char>(sample); });

  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) {
    error = "no memory";
  } else {
    png_set_write_fn(png, &bytes, append, nothing_to_flush);
    if (!encode(png, info, picture, items, rows)) bytes.clear();
  }
  png_destroy_write_struct(&png, &info);
  return bytes;
}

bool is_png(std::span<const unsigned char> bytes) {
  return bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0;
}

PngPicture decode_png(std::span<const unsigned char> bytes, std::string& error) {
  PngPicture picture;
  Source source{bytes};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) {
    error = "no memory";
  } else {
    png_set_read_fn(png, &source, take);
    try {
      if (decode_header(png, info, picture)) {
        Rows rows(picture.height, png_get_rowbytes(png, info));
        if (decode_rows(png, rows)) {
          picture.samples.resize(rows.bytes.size() / (picture.bits == 16 ? 2 : 1));
          if (picture.bits == 16)
            std::memcpy(picture.samples.data(), rows.bytes.data(), rows.bytes.size());
          else
            std::copy(rows.bytes.begin(), rows.bytes.end(), picture.samples.begin());
        }
      }
    } catch (const std::bad_alloc&) {
      error = "no memory";
    }
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return picture;
}

}  // namespace plume
