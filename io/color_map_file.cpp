#include "plume/io/color_map_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plume/mesh/error.h"

namespace plume {
namespace {

using nlohmann::json;

/// Reads the members of one colour map and names its file in every complaint.
class Reader {
 public:
  Reader(const std::filesystem::path& file, const json& map) : file_(file), map_(map) {}

  ColorMap read() const {
    ColorMap map;
    if (const json* name = member("Name")) {
      if (!name->is_string()) fail("\"Name\" is " + shown(*name) + "; give a string");
      map.name = name->get<std::string>();
    }
    map.space = space();

    constexpr std::size_t color_size = 4;
    const auto colors = points("RGBPoints", color_size, "x, red, green, blue");
    if (colors.empty()) {
      fail(
          "has no \"RGBPoints\"; a map of indexed colours is not supported, export one of "
          "continuous colours");
    }
    for (const auto& p : colors) map.colors.push_back({p[0], {p[1], p[2], p[3]}});

    constexpr std::size_t opacity_size = 4;
    for (const auto& p : points("Points", opacity_size, "x, opacity, midpoint, sharpness")) {
      map.opacities.push_back({p[0], p[1], p[2], p[3]});
    }
    return map;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(file_.string() + ": " + what);
  }

  /// As the file has it, shortened.
  static std::string shown(const json& value) {
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    constexpr std::size_t longest = 40;
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    return text;
  }

  /// Null where the member is absent or null, as ParaView writes it.
  const json* member(const char* name) const {
    const auto found = map_.find(name);
    return found == map_.end() || found->is_null() ? nullptr : &*found;
  }

  ColorMap::Space space() const {
    const json* space = member("ColorSpace");
    if (space == nullptr || *space == "RGB") return ColorMap::Space::rgb;
    if (*space == "HSV") return ColorMap::Space::hsv;
    if (*space == "Lab" || *space == "CIELAB") return ColorMap::Space::lab;
    if (*space == "Diverging") return ColorMap::Space::diverging;
    if (*space == "Step") return ColorMap::Space::step;
    fail("\"ColorSpace\" is " + shown(*space) +
         "; use \"RGB\", \"HSV\", \"Lab\", \"Diverging\" or \"Step\"");
  }

  /// The flat list of that name in groups of `size` numbers: x, which ascends, and values within 0
  /// and 1. Empty where there is no such list.
  std::vector<std::vector<double>> points(const char* name, std::size_t size,
                                          const char* meaning) const {
    const json* list = member(name);
    std::vector<std::vector<double>> result;
    if (list == nullptr) return result;
    const std::string quoted = std::string("\"") + name + "\"";
    if (!list->is_array()) fail(quoted + " is " + shown(*list) + "; give an array of numbers");
    if (list->size() % size != 0) {
      fail(quoted + " has " + std::to_string(list->size()) + " values, no multiple of " +
           std::to_string(size) + "; give " + meaning + " for each point");
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
      const json& value = (*list)[i];
      const std::size_t of_point = i % size;
      const std::string place = quoted + " point " + std::to_string(i / size);
      const auto refuse = [&](const char* remedy) {
        fail(place + ": value " + std::to_string(of_point) + " (of " + meaning + ") is " +
             shown(value) + "; " + remedy);
      };
      if (!value.is_number()) refuse("give a number");
      const double number = value.get<double>();
      if (!std::isfinite(number)) refuse("give a finite number");
      if (of_point == 0) {
        if (!result.empty() && number < result.back()[0]) refuse("sort the points by x");
        result.emplace_back();
      } else if (number < 0 || number > 1) {
        refuse("give a number from 0 to 1");
      }
      result.back().push_back(number);
    }
    if (result.size() == 1) fail(quoted + " has a single point; give at least 2");
    return result;
  }

  const std::filesystem::path& file_;
  const json& map_;
};

}  // namespace

ColorMap read_color_map(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& what) { throw Error(file.string() + ": " + what); };
  if (std::filesystem::is_directory(file)) fail("is a folder; give a colour map's JSON file");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("cannot be opened (" + std::string(std::strerror(errno)) + "); check the path");

  json content;
  try {
    content = json::parse(in);
  } catch (const json::parse_error& error) {
    fail("is no JSON (stops making sense at byte " + std::to_string(error.byte) +
         "); export the colour map from ParaView again");
  } catch (const json::out_of_range&) {
    // The only such error that a parser has.
    fail("has a number too large for double precision; give finite numbers");
  }
  if (content.is_array()) {
    if (content.empty()) fail("is an empty array; export at least one colour map");
    content = json(content.front());
  }
  if (!content.is_object()) {
    fail("holds no colour map; export one as JSON from ParaView's colour map editor");
  }
  return Reader(file, content).read();
}

}  // namespace plume
