#include "opaque_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "parse.h"
#include "plume/io/read_surface.h"
#include "plume/lib/srgb.h"
#include "plume/mesh/error.h"

namespace plume::command {
namespace {

constexpr std::array<const char*, 6> kSides{"imin", "imax", "jmin", "jmax", "kmin", "kmax"};

// What stands before the colour, and the colour in linear RGB where there is one. A colon of the
// name itself (a drive, a time) is none before three numbers.
std::pair<std::string, std::optional<std::array<float, 3>>> split_color(const char* option,
                                                                        const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos ||
      text.find_first_not_of("0123456789.,-+eE", colon + 1) != std::string::npos)
    return {text, std::nullopt};
  const auto rgb = parse_numbers(option, text.substr(colon + 1), {3});
  std::array<float, 3> linear;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(rgb[c] >= 0 && rgb[c] <= 1))
      throw Error(fmt::format("{} '{}': the colour {:g} must be 0 to 1", option, text, rgb[c]));
    linear[c] = static_cast<float>(srgb_to_linear(rgb[c]));
  }
  return {text.substr(0, colon), linear};
}

}  // namespace

OpaqueSurface read_opaque_surface(const std::string& text, const Notice& notice) {
  const auto [file, color] = split_color("--surface", text);
  TriangleSurface read = read_surface(file, {}, notice);
  if (read.triangles.empty())
    throw Error(fmt::format("{}: points without triangles, and --surface shows triangles", file));
  OpaqueSurface surface;
  surface.points.resize(read.vertices.point_count());
  read.vertices.points.visit([&](auto values) {
    for (std::size_t i = 0; i < 3 * surface.points.size(); ++i)
      surface.points[i / 3][i % 3] = static_cast<double>(values[i]);
    return 0;
  });
  surface.triangles = std::move(read.triangles);
  if (color) surface.color = *color;
  return surface;
}

OpaqueSurface parse_wall(const std::string& text, const Mesh& mesh) {
  const auto [name, color] = split_color("--wall", text);
  const auto side = std::find(kSides.begin(), kSides.end(), name);
  if (side == kSides.end())
    throw Error(fmt::format("--wall '{}': expected one of {}, and :R,G,B where wanted", text,
                            fmt::join(kSides, " ")));
  if (!mesh.is_grid())
    throw Error(
        fmt::format("--wall '{}': the mesh is no curvilinear or rectilinear grid, whose "
                    "sides have such names; give its body's surface with --surface",
                    text));
  OpaqueSurface surface = side_of_grid(mesh, static_cast<int>(side - kSides.begin()));
  if (color) surface.color = *color;
  return surface;
}

}  // namespace plume::command
