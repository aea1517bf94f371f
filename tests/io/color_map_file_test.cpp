#include "plume/io/color_map_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "plume/mesh/error.h"

namespace plume {
namespace {

namespace fs = std::filesystem;

class ColorMapFile : public testing::Test {
 protected:
  ColorMapFile()
      : file_(fs::temp_directory_path() / ("plume-map-" + std::to_string(getpid()) + ".json")) {}
  ~ColorMapFile() override { fs::remove(file_); }

  ColorMap read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_color_map(file_);
  }

  std::string complaint(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing thrown";
  }

  fs::path file_;
};

// As ParaView 5 exports it.
const char* const exported = R"([
	{
		"ColorSpace" : "Diverging",
		"Creator" : "somebody",
		"Name" : "Cool to Warm",
		"NanColor" : [ 1, 1, 0 ],
		"Points" : [ 0.0, 0.0, 0.5, 0.0, 2.0, 0.75, 0.25, 1.0 ],
		"RGBPoints" : [ 0.0, 0.25, 0.5, 0.75, 1.0, 0.875, 0.875, 0.875, 2, 1, 0, 0.125 ]
	},
	{ "Name" : "another, which does not count" }
])";

TEST_F(ColorMapFile, ReadsWhatParaViewExports) {
  const ColorMap map = read(exported);
  EXPECT_EQ(map.name, "Cool to Warm");
  EXPECT_EQ(map.space, ColorMap::Space::diverging);
  ASSERT_EQ(map.colors.size(), 3u);
  EXPECT_EQ(map.colors[0].srgb, (std::array<double, 3>{0.25, 0.5, 0.75}));
  EXPECT_EQ(map.colors[2].x, 2);
  EXPECT_EQ(map.colors[2].srgb, (std::array<double, 3>{1, 0, 0.125}));
  ASSERT_EQ(map.opacities.size(), 2u);
  EXPECT_EQ(map.opacities[1].x, 2);
  EXPECT_EQ(map.opacities[1].opacity, 0.75);
  EXPECT_EQ(map.opacities[1].midpoint, 0.25);
  EXPECT_EQ(map.opacities[1].sharpness, 1);
  EXPECT_EQ(to_transfer_function(map, 1).problem(), std::nullopt);
}

TEST_F(ColorMapFile, TakesOneMapAndWhatIsOptional) {
  const ColorMap map = read(R"({"RGBPoints": [0, 0,0,0, 1, 1,1,1], "Points": null})");
  EXPECT_EQ(map.space, ColorMap::Space::rgb);
  EXPECT_EQ(map.colors.size(), 2u);
  EXPECT_TRUE(map.opacities.empty());
}

TEST_F(ColorMapFile, KnowsTheColourSpaces) {
  const std::pair<const char*, ColorMap::Space> all[] = {
      {"RGB", ColorMap::Space::rgb},   {"HSV", ColorMap::Space::hsv},
      {"Lab", ColorMap::Space::lab},   {"CIELAB", ColorMap::Space::lab},
      {"Step", ColorMap::Space::step}, {"Diverging", ColorMap::Space::diverging}};
  for (const auto& [name, space] : all) {
    EXPECT_EQ(
        read(std::string(R"({"RGBPoints": [0, 0,0,0, 1, 1,1,1], "ColorSpace": ")") + name + "\"}")
            .space,
        space);
  }
}

TEST_F(ColorMapFile, EveryComplaintNamesFileAndPoint) {
  const std::string colors = R"("RGBPoints": [0, 0,0,0, 1, 1,1,1])";
  const std::pair<std::string, std::vector<const char*>> cases[] = {
      {"", {"no JSON"}},
      {"a colour map", {"no JSON", "byte 1"}},
      {std::string(exported).substr(0, 150), {"no JSON"}},
      {R"({"RGBPoints": [0, 0,0,0, 1, NaN,1,1]})", {"no JSON"}},
      {R"({"RGBPoints": [0, 0,0,0, 1e999, 1,1,1]})", {"too large"}},
      {"[]", {"empty array"}},
      {"3", {"no colour map"}},
      {"[3]", {"no colour map"}},
      {R"({"Name": "indexed", "IndexedColors": [1, 0, 0]})", {"RGBPoints"}},
      {R"({"RGBPoints": []})", {"RGBPoints"}},
      {R"({"RGBPoints": 3})", {"RGBPoints", "is 3"}},
      {R"({"RGBPoints": [0, 0,0,0]})", {"single point"}},
      {R"({"RGBPoints": [0, 0,0,0, 1, 1,1]})", {"7 values", "red"}},
      {R"({"RGBPoints": [0, 0,0,0, 2, 1,1,1, 1, 1,1,1]})", {"point 2", "is 1;", "sort"}},
      {R"({"RGBPoints": [0, 0,0,0, 1, 1,"x",1]})", {"point 1", "\"x\"", "give a number"}},
      {R"({"RGBPoints": [0, 0,0,0, 1, 1,null,1]})", {"point 1", "null"}},
      {R"({"RGBPoints": [0, 0,0,0, 1, 1,255,1]})", {"point 1", "255", "0 to 1"}},
      {"{" + colors + R"(, "Points": [0, -0.5, 0.5, 0, 1, 1, 0.5, 0]})",
       {"\"Points\" point 0", "-0.5", "opacity"}},
      {"{" + colors + R"(, "Points": [0, 0, 0.5, 0, 1, 1, 7, 0]})", {"point 1", "is 7"}},
      {"{" + colors + R"(, "Points": [1, 0, 0.5, 0, 0, 1, 0.5, 0]})", {"point 1", "sort"}},
      {"{" + colors + R"(, "Points": [1, 0, 0.5, 0]})", {"\"Points\"", "single point"}},
      {"{" + colors + R"(, "ColorSpace": "Munsell"})", {"Munsell", "HSV"}},
      {"{" + colors + R"(, "ColorSpace": 4})", {"ColorSpace", "is 4"}},
      {"{" + colors + R"(, "Name": 4})", {"Name", "is 4"}},
  };
  for (const auto& [text, parts] : cases) {
    const std::string message = complaint(text);
    EXPECT_EQ(message.find(file_.string() + ": "), 0u) << text << " gives " << message;
    for (const char* part : parts) {
      EXPECT_NE(message.find(part), std::string::npos) << message << " lacks " << part;
    }
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(ColorMapFile, FilesThatAreNotThere) {
  for (const fs::path& path : {fs::path("/no/such/map.json"), fs::temp_directory_path()}) {
    try {
      read_color_map(path);
      FAIL() << "nothing thrown for " << path;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find(path.string()), 0u) << error.what();
    }
  }
}

}  // namespace
}  // namespace plume
