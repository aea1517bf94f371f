#include "plume/io/exr_bytes.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace plume {
namespace {

constexpr const char* kColors[4] = {"R", "G", "B", "A"};

class MemoryOut : public Imf::OStream {
 public:
  explicit MemoryOut(std::vector<unsigned char>& bytes) : OStream("a picture"), bytes_(bytes) {}

  void write(const char from[], int size) override {
    const auto end = place_ + static_cast<std::size_t>(size);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + place_, from, static_cast<std::size_t>(size));
    place_ = end;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }

 private:
  std::vector<unsigned char>& bytes_;
  std::size_t place_ = 0;
};

class MemoryIn : public Imf::IStream {
 public:
  explicit MemoryIn(std::span<const unsigned char> bytes) : IStream("a picture"), bytes_(bytes) {}

  bool read(char to[], int size) override {
    const auto wanted = static_cast<std::size_t>(size);
    if (place_ > bytes_.size() || wanted > bytes_.size() - place_)
      throw std::runtime_error("the file ends early");
    std::memcpy(to, bytes_.data() + place_, wanted);
    place_ += wanted;
    return place_ < bytes_.size();
  }
  std::uint64_t tellg() override { return place_; }
  void seekg(std::uint64_t place) override { place_ = static_cast<std::size_t>(place); }

 private:
  const std::span<const unsigned char> bytes_;
  std::size_t place_ = 0;
};

// A channel of which `first` is the value of the window's first pixel.
Imf::Slice slice_of(const float* first, std::size_t per_pixel, const Imath::Box2i& window,
                    double missing = 0) {
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  return Imf::Slice::Make(Imf::FLOAT, first, window, per_pixel * sizeof(float),
                          width * per_pixel * sizeof(float), 1, 1, missing);
}

}  // namespace

std::vector<unsigned char> encode_exr(
    const Image& image, const std::vector<std::pair<std::string, std::string>>& texts) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [name, value] : texts) header.insert(name, Imf::StringAttribute(value));
  Imf::FrameBuffer pixels;
  auto add = [&](const std::string& name, const float* first, std::size_t per_pixel) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    pixels.insert(name, slice_of(first, per_pixel, header.dataWindow()));
  };
  for (std::size_t c = 0; c < 4; ++c) add(kColors[c], image.rgba.data() + c, 4);
  for (const Channel& channel : image.channels) add(channel.name, channel.values.data(), 1);

  std::vector<unsigned char> bytes;
  MemoryOut out(bytes);
  Imf::OutputFile file(out, header, 0);
  file.setFrameBuffer(pixels);
  file.writePixels(image.height);
  return bytes;
}

struct ExrPicture::Open {
  MemoryIn in;
  Imf::InputFile file;

  explicit Open(std::span<const unsigned char> bytes) : in(bytes), file(in, 0) {}
};

ExrPicture::ExrPicture(std::span<const unsigned char> bytes)
    : open_(std::make_unique<Open>(bytes)) {}
ExrPicture::~ExrPicture() = default;

int ExrPicture::channel_count() const {
  const Imf::ChannelList& channels = open_->file.header().channels();
  int count = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) ++count;
  return count;
}

bool ExrPicture::has_colors() const {
  const Imf::ChannelList& channels = open_->file.header().channels();
  return std::all_of(kColors, kColors + 3,
                     [&](const char* name) { return channels.findChannel(name) != nullptr; });
}

Image ExrPicture::read() const {
  const Imf::Header& header = open_->file.header();
  const Imath::Box2i window = header.dataWindow();
  Image image;
  image.width = window.max.x - window.min.x + 1;
  image.height = window.max.y - window.min.y + 1;
  const std::size_t count =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.rgba.resize(4 * count);
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
    if (std::find(kColors, kColors + 4, std::string(channel.name())) == kColors + 4)
      image.channels.push_back({channel.name(), std::vector<float>(count)});
  Imf::FrameBuffer pixels;
  for (std::size_t c = 0; c < 4; ++c)
    pixels.insert(kColors[c], slice_of(image.rgba.data() + c, 4, window, c == 3 ? 1 : 0));
  for (Channel& channel : image.channels)
    pixels.insert(channel.name, slice_of(channel.values.data(), 1, window));
  open_->file.setFrameBuffer(pixels);
  open_->file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace plume
