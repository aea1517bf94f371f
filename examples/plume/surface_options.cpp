#include "surface_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "parse.h"
#include "plume/lib/srgb.h"

namespace plume::command {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// The parts of an option's value between colons, with what to say where one is wrong.
struct Parts {
  std::string option, text, form;
  std::vector<std::string> parts;

  Parts(std::string option_name, std::string whole, std::string expected, std::size_t most)
      : option(std::move(option_name)), text(std::move(whole)), form(std::move(expected)) {
    parts = split(text, ':');
    if (parts.size() > most) fail();
  }

  [[noreturn]] void fail() const {
    throw Error(fmt::format("{} '{}': expected {}", option, text, form));
  }

  std::vector<double> numbers(std::size_t part, std::size_t count) const {
    try {
      return parse_numbers(option, parts[part], {count});
    } catch (const Error&) {
      fail();
    }
  }

  float opacity(std::size_t part, float otherwise) const {
    if (parts.size() <= part) return otherwise;
    const double value = numbers(part, 1)[0];
    if (!(value >= 0 && value <= 1))
      throw Error(fmt::format("{} '{}': the opacity {:g} must be 0 to 1", option, text, value));
    return static_cast<float>(value);
  }

  std::optional<std::array<float, 3>> color(std::size_t part) const {
    if (parts.size() <= part) return std::nullopt;
    const auto rgb = numbers(part, 3);
    std::array<float, 3> linear;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(rgb[c] >= 0 && rgb[c] <= 1))
        throw Error(fmt::format("{} '{}': the colour {:g} must be 0 to 1", option, text, rgb[c]));
      linear[c] = static_cast<float>(srgb_to_linear(rgb[c]));
    }
    return linear;
  }
};

}  // namespace

Isosurface parse_isosurface(const std::string& text, const TransferFunction& colors) {
  const Parts parts("--iso", text, "VALUE[:OPACITY[:R,G,B]], such as 0.5:0.8:1,0.9,0.7", 3);
  Isosurface surface;
  surface.value = static_cast<float>(parts.numbers(0, 1)[0]);
  surface.opacity = parts.opacity(1, 1);
  surface.color = parts.color(2).value_or(colors.at(surface.value).color);
  return surface;
}

IntervalVolume parse_interval(const std::string& text, const TransferFunction& colors) {
  const Parts parts("--interval", text, "LOW,HIGH[:OPACITY[:R,G,B]], such as 0.2,0.4:0.5:0,0,1", 3);
  const auto ends = parts.numbers(0, 2);
  IntervalVolume interval;
  interval.low = static_cast<float>(ends[0]);
  interval.high = static_cast<float>(ends[1]);
  const float opacity = parts.opacity(1, 0.5f);
  if (const auto color = parts.color(2)) {
    interval.profile = even_profile(opacity, *color);
    return interval;
  }
  const float extinction = even_profile(opacity, {}).knots[0].optics.extinction;
  constexpr int kKnots = 17;
  for (int i = 0; i < kKnots; ++i) {
    const float w = static_cast<float>(i) / (kKnots - 1);
    const float scalar = interval.low + w * (interval.high - interval.low);
    interval.profile.knots.push_back({w, {extinction, colors.at(scalar).color}});
  }
  return interval;
}

Light parse_light(const std::string& text) {
  const Parts parts("--light", text, "head or X,Y,Z, and :INTENSITY if wanted, such as 1,0,2:0.5",
                    2);
  Light light;
  if (parts.parts[0] != "head") {
    const auto n = parts.numbers(0, 3);
    light.direction = {n[0], n[1], n[2]};
  }
  if (parts.parts.size() > 1) light.intensity = parts.numbers(1, 1)[0];
  Lighting lighting;
  lighting.lights = {light};
  if (const auto problem = lighting.problem())
    throw Error(fmt::format("--light '{}': {}", text, *problem));
  return light;
}

ClipPlane parse_clip_plane(const std::string& text) {
  const auto n = parse_numbers("--clip", text, {6});
  const ClipPlane plane{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
  if (const auto problem = problem_of(plane))
    throw Error(fmt::format("--clip '{}': {}", text, *problem));
  return plane;
}

std::vector<ClipPlane> parse_clip_box(const std::string& text) {
  const auto n = parse_numbers("--clip-box", text, {6});
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(n[axis] < n[axis + 3]))
      throw Error(fmt::format("--clip-box '{}': {:g} to {:g} is no width; low corner first", text,
                              n[axis], n[axis + 3]));
  return planes_of_box({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
}

}  // namespace plume::command
