#include "plume/io/image_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <limits>
#include <random>

#include "plume/mesh/error.h"

namespace plume {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, removed after it.
class ImageFile : public testing::Test {
 protected:
  ImageFile() : folder_(fs::temp_directory_path() / ("plume-image-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ImageFile() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

Image image_of(int width, int height, std::vector<float> rgba) {
  Image image;
  image.width = width;
  image.height = height;
  image.rgba = std::move(rgba);
  return image;
}

Image random_image(int width, int height) {
  std::mt19937_64 random(5);
  Image image = image_of(width, height, {});
  for (int i = 0; i < width * height; ++i) {
    const float alpha = static_cast<float>(random() % 256) / 255;
    for (int c = 0; c < 3; ++c) {
      image.rgba.push_back(alpha * static_cast<float>(random() % 1001) / 1000);
    }
    image.rgba.push_back(alpha);
  }
  return image;
}

/// A PNG's stored numbers, untouched.
template <class T>
std::vector<T> stored(const fs::path& file, OIIO::ImageSpec* spec = nullptr) {
  OIIO::ImageSpec raw;
  raw.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), &raw);
  if (!input) throw Error("the test cannot open " + file.string());
  const OIIO::ImageSpec s = input->spec();
  if (spec != nullptr) *spec = s;
  std::vector<T> pixels(static_cast<std::size_t>(s.width * s.height * s.nchannels));
  EXPECT_TRUE(
      input->read_image(0, 0, 0, s.nchannels, OIIO::BaseTypeFromC<T>::value, pixels.data()));
  return pixels;
}

template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(ImageFile, ExrKeepsEveryBit) {
  Image image = random_image(7, 5);
  image.rgba[0] = 1e-30f;
  image.rgba[1] = 250;
  image.channels.push_back({"depth", std::vector<float>(35, 1.5f)});
  image.channels[0].values[3] = std::numeric_limits<float>::infinity();
  image.channels.push_back({"cell_id", std::vector<float>(35, -1)});
  image.channels[1].values[34] = 16777215;
  image.channels.push_back({"a_first_by_name", std::vector<float>(35, 0.25f)});
  write_image(image, folder_ / "picture.exr");

  const Image back = read_image(folder_ / "picture.exr");
  EXPECT_EQ(back.width, 7);
  EXPECT_EQ(back.height, 5);
  EXPECT_EQ(back.rgba, image.rgba);
  ASSERT_EQ(back.channels.size(), 3u);
  for (const Channel& channel : image.channels) {
    ASSERT_NE(back.channel(channel.name), nullptr) << channel.name;
    EXPECT_EQ(back.channel(channel.name)->values, channel.values) << channel.name;
  }
  EXPECT_EQ(files(), 1u);
}

TEST_F(ImageFile, PngHoldsTheSrgbCurve) {
  // By hand: 12.92 * 0.0031308 = 0.040450, times 255 is 10.31; 1.055 * 0.5^(1/2.4) - 0.055 =
  // 0.735357, times 255 is 187.52.
  const Image image =
      image_of(4, 1, {0, 0, 0, 1, 1, 1, 1, 1, 0.0031308f, 0.5f, 0.25f, 1, 2, -1, 0.001f, 1});
  write_image(image, folder_ / "picture.png");
  EXPECT_EQ(stored<std::uint8_t>(folder_ / "picture.png"),
            (std::vector<std::uint8_t>{0, 0, 0, 255, 255, 255, 255, 255, 10, 188, 137, 255, 255, 0,
                                       3, 255}));

  ImageFileOptions options;
  options.png_bits = 16;
  write_image(image, folder_ / "deep.png", options);
  OIIO::ImageSpec spec;
  const auto deep = stored<std::uint16_t>(folder_ / "deep.png", &spec);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::UINT16);
  EXPECT_EQ(deep[4], 65535);
  EXPECT_EQ(deep[8], 2651);   // 0.040449936 * 65535 = 2650.9
  EXPECT_EQ(deep[9], 48192);  // 0.735356983 * 65535 = 48191.6
}

TEST_F(ImageFile, PngIsUnpremultiplied) {
  // Half-covered white stays white; what is not there is black.
  write_image(image_of(2, 1, {0.5f, 0.5f, 0.25f, 0.5f, 0, 0, 0, 0}), folder_ / "picture.png");
  EXPECT_EQ(stored<std::uint8_t>(folder_ / "picture.png"),
            (std::vector<std::uint8_t>{255, 255, 188, 128, 0, 0, 0, 0}));
}

TEST_F(ImageFile, PngOnABackground) {
  ImageFileOptions options;
  options.background[0] = 1;
  options.background[1] = 0.5f;
  options.background[2] = 0;
  write_image(image_of(2, 1, {0, 0, 0, 0, 0.25f, 0.25f, 0.25f, 0.5f}), folder_ / "picture.png",
              options);
  OIIO::ImageSpec spec;
  // Linear light: 0.25 + 0.5 = 0.75 is 0.880825; 0.5 is 0.214041 linear, 0.357021 is 0.632906;
  // 0.25 is 0.537099.
  EXPECT_EQ(stored<std::uint8_t>(folder_ / "picture.png", &spec),
            (std::vector<std::uint8_t>{255, 128, 0, 225, 161, 137}));
  EXPECT_EQ(spec.nchannels, 3);
  EXPECT_EQ(read_image(folder_ / "picture.png").pixel(0, 0)[3], 1);
}

TEST_F(ImageFile, PngComesBackWithinItsQuantization) {
  const Image image = random_image(16, 9);
  ImageFileOptions options;
  options.png_bits = 16;
  write_image(image, folder_ / "picture.PNG", options);
  const Image back = read_image(folder_ / "picture.PNG");
  ASSERT_EQ(back.rgba.size(), image.rgba.size());
  double worst = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    worst = std::max(worst, static_cast<double>(std::abs(back.rgba[i] - image.rgba[i])));
  }
  // Half a step of 1/65535 in colour, stretched by the curve's slope of at most 2.4/1.055, and
  // half a step in alpha.
  EXPECT_LT(worst, 3.3 / 2 / 65535);
  EXPECT_GT(worst, 0);
}

TEST_F(ImageFile, ZeroAndNanGiveAPicture) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  write_image(image_of(1, 1, {nan, 0.5f, 0, 1}), folder_ / "picture.png");
  EXPECT_EQ(stored<std::uint8_t>(folder_ / "picture.png"),
            (std::vector<std::uint8_t>{0, 188, 0, 255}));
}

TEST_F(ImageFile, MetadataIsKept) {
  ImageFileOptions options;
  options.metadata = {{"plume:field", "Density"}, {"plume:view", "1 2 3 / \"quoted\""}};
  for (const char* name : {"picture.png", "picture.exr"}) {
    write_image(random_image(3, 3), folder_ / name, options);
    const auto input = OIIO::ImageInput::open((folder_ / name).string());
    ASSERT_TRUE(input);
    for (const auto& [key, value] : options.metadata) {
      EXPECT_EQ(input->spec().get_string_attribute(key), value) << name << " " << key;
    }
  }
}

TEST_F(ImageFile, MetadataWithoutANameIsRefused) {
  ImageFileOptions options;
  options.metadata = {{"", "nameless"}};
  for (const char* name : {"picture.png", "picture.exr"}) {
    const std::string message =
        message_of([&] { write_image(random_image(3, 3), folder_ / name, options); });
    EXPECT_TRUE(contains(message, std::string(name) + ": not written")) << message;
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(ImageFile, ReplacesAnExistingFile) {
  write_image(image_of(1, 1, {1, 1, 1, 1}), folder_ / "picture.exr");
  write_image(image_of(2, 1, {0, 0, 0, 1, 1, 0, 0, 1}), folder_ / "picture.exr");
  EXPECT_EQ(read_image(folder_ / "picture.exr").width, 2);
  EXPECT_EQ(files(), 1u);
}

TEST_F(ImageFile, PathsThatCannotBeWritten) {
  std::ofstream(folder_ / "a_file") << "x";
  fs::create_directory(folder_ / "folder.png");
  const std::size_t before = files();
  struct Case {
    fs::path path;
    std::string remedy;
  };
  const Case cases[] = {
      {folder_ / "missing" / "picture.png", "create it"},
      {folder_ / "a_file" / "picture.png", "no folder"},
      {folder_ / "folder.png", "name of a file"},
      {folder_ / "picture.jpg", "use .png or .exr"},
      {folder_ / "picture", ".png or .exr"},
      {"", ".png or .exr"},
      {folder_ / (std::string(300, 'x') + ".png"), "choose another"},
      // Nobody, root included, can create a file here.
      {"/proc/picture.exr", "not writable"},
  };
  const Image image = image_of(1, 1, {1, 1, 1, 1});
  for (const Case& c : cases) {
    for (const std::string& message : {message_of([&] { check_image_path(c.path); }),
                                       message_of([&] { write_image(image, c.path); })}) {
      EXPECT_TRUE(contains(message, c.path.string())) << message;
      EXPECT_TRUE(contains(message, c.remedy)) << message;
      EXPECT_FALSE(contains(message, "\n")) << message;
    }
  }
  EXPECT_EQ(files(), before);
}

TEST_F(ImageFile, CheckingLeavesNothingBehind) {
  check_image_path(folder_ / "picture.png");
  EXPECT_EQ(files(), 0u);
  std::ofstream(folder_ / "picture.exr") << "old";
  check_image_path(folder_ / "picture.exr");
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(fs::file_size(folder_ / "picture.exr"), 3u);
}

/// Lets files grow to so many bytes and no further: a full disk, for root as well.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_{};
  void (*handler_)(int);
};

TEST_F(ImageFile, AFullDiskKeepsTheOldFile) {
  const Image image = random_image(200, 200);
  for (const char* name : {"picture.png", "picture.exr"}) {
    write_image(image_of(1, 1, {1, 1, 1, 1}), folder_ / name);
    const std::size_t before = files();
    std::string message;
    {
      const FileSizeLimit limit(5000);
      message = message_of([&] { write_image(image, folder_ / name); });
    }
    EXPECT_TRUE(contains(message, name)) << message;
    EXPECT_TRUE(contains(message, "disk full")) << message;
    EXPECT_EQ(files(), before);
    EXPECT_EQ(read_image(folder_ / name).width, 1);
  }
}

TEST_F(ImageFile, ImagesThatAreNone) {
  const auto write = [&](const Image& image, const ImageFileOptions& options = {}) {
    return message_of([&] { write_image(image, folder_ / "picture.png", options); });
  };
  EXPECT_TRUE(contains(write(image_of(2, 2, {1, 1, 1, 1})), "need 16"));
  EXPECT_TRUE(contains(write(image_of(0, 2, {})), "0 x 2"));
  Image image = random_image(2, 2);
  image.channels.push_back({"depth", {1, 2}});
  EXPECT_TRUE(contains(write(image), "'depth' has 2"));
  image.channels[0] = {"R", {1, 2, 3, 4}};
  EXPECT_TRUE(contains(write(image), "'R'"));
  ImageFileOptions options;
  options.png_bits = 12;
  EXPECT_TRUE(contains(write(random_image(2, 2), options), "12"));
  EXPECT_EQ(files(), 0u);
}

TEST_F(ImageFile, UnreadableFilesAreNamed) {
  for (const std::string name : {"picture.png", "picture.exr"}) {
    const auto complaint = [&] { return message_of([&] { read_image(folder_ / name); }); };
    EXPECT_TRUE(contains(complaint(), name));
    write_image(random_image(40, 40), folder_ / name);
    const auto size = fs::file_size(folder_ / name);
    fs::copy_file(folder_ / name, folder_ / "whole");
    fs::resize_file(folder_ / name, size / 2);
    EXPECT_TRUE(contains(complaint(), name + ": is damaged")) << complaint();
    fs::copy_file(folder_ / "whole", folder_ / name, fs::copy_options::overwrite_existing);
    std::fstream file(folder_ / name, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(size / 2));
    file << "damaged";
    file.close();
    fs::remove(folder_ / "whole");
    EXPECT_TRUE(contains(complaint(), name + ": is damaged")) << complaint();
    EXPECT_FALSE(contains(complaint(), "\n")) << complaint();
    std::ofstream(folder_ / name) << "no picture";
    EXPECT_TRUE(contains(complaint(), name + ": cannot be read")) << complaint();
  }
}

}  // namespace
}  // namespace plume
