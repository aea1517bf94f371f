#include "render_choices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "parse.h"
#include "plume/io/color_map_file.h"
#include "plume/lib/render_modes.h"
#include "surface_options.h"

namespace plume::command {

bool is_color_map_file(const std::string& transfer_function) {
  return !transfer_function.empty() && !preset(transfer_function) &&
         std::filesystem::exists(transfer_function);
}

FittedLook look_fitted_to(const Scene& scene) {
  return {scene.default_color_map(), scene.default_unit_distance()};
}

void choose_transfer_function(Scene& scene, const FittedLook& fitted, const RenderArguments& args,
                              const Console& console) {
  ColorMap map = fitted.map;
  const std::vector<std::string> presets = preset_names();
  if (!args.transfer_function.empty()) {
    if (auto colors = preset(args.transfer_function)) {
      // A preset brings colours; the opacity stays the one fitted to the values.
      colors = rescaled(*colors, map.colors.front().x, map.colors.back().x);
      colors->opacities = map.opacities;
      map = *colors;
    } else if (is_color_map_file(args.transfer_function)) {
      map = read_color_map(args.transfer_function);
    } else {
      throw Error(fmt::format("--tf '{}': neither a file nor a preset; the presets are: {}",
                              args.transfer_function, fmt::join(presets, " ")));
    }
  }
  if (!args.transfer_range.empty()) {
    const auto range = parse_numbers("--tf-range", args.transfer_range, {2});
    if (!(range[0] < range[1]))
      throw Error(fmt::format("--tf-range '{}': the first number must be below the second",
                              args.transfer_range));
    map = rescaled(std::move(map), range[0], range[1]);
  }
  const ScalarField& field = scene.field();
  if (map.colors.back().x < field.low || map.colors.front().x > field.high)
    console.say(fmt::format(
        "the colour map covers {:g} to {:g}, but '{}' runs from {:g} to {:g}; see --tf-range",
        map.colors.front().x, map.colors.back().x, field.name, field.low, field.high));
  const double unit = args.unit_distance > 0 ? args.unit_distance : fitted.unit_distance;
  scene.set_transfer_function(to_transfer_function(map, unit, args.opacity_scale));
}

void choose_light_and_clip(const RenderArguments& args, RenderSettings& settings) {
  const bool surfaces = !args.isosurfaces.empty() || !args.intervals.empty();
  for (const char* channel : {"isovalue", "normal"})
    if (asks_for(args.channels, channel) && !surfaces)
      throw Error(
          fmt::format("--channels {}: it is of isosurfaces and intervals; add an --iso or "
                      "an --interval",
                      channel));
  for (const std::string& text : args.clip_planes)
    settings.clip_planes.push_back(parse_clip_plane(text));
  if (!args.clip_box.empty())
    for (const ClipPlane& plane : parse_clip_box(args.clip_box))
      settings.clip_planes.push_back(plane);
  if (args.lights.empty()) {
    if (!args.material.empty())
      throw Error(
          fmt::format("--material '{}': there is no light; add --light head", args.material));
    return;
  }
  if (!surfaces)
    throw Error(fmt::format("--light '{}': there is nothing to light; add an --iso or --interval",
                            args.lights[0]));
  Lighting lighting;
  lighting.lights.clear();
  for (const std::string& text : args.lights) lighting.lights.push_back(parse_light(text));
  if (!args.material.empty()) {
    const auto n = parse_numbers("--material", args.material, {4});
    lighting.ambient = n[0];
    lighting.diffuse = n[1];
    lighting.specular = n[2];
    lighting.exponent = n[3];
    if (const auto problem = lighting.problem())
      throw Error(fmt::format("--material '{}': {}", args.material, *problem));
  }
  settings.lighting = lighting;
}

void choose_gray_range(const RenderArguments& args, RenderSettings& settings) {
  if (args.gray_range.empty()) return;
  const auto range = parse_numbers("--gray-range", args.gray_range, {2});
  const std::array<float, 2> gray{static_cast<float>(range[0]), static_cast<float>(range[1])};
  if (!(gray[0] < gray[1]))
    throw Error(fmt::format("--gray-range '{}': the first number must be below the second",
                            args.gray_range));
  const ShadeBy shade = in_words(settings.mode).shade;
  if (shade != ShadeBy::gray_from_zero && shade != ShadeBy::gray_near_is_white)
    throw Error(
        fmt::format("--gray-range '{}': mode {} has colours; --tf-range says what they run over",
                    args.gray_range, args.mode));
  settings.gray_range = gray;
}

void choose_classification(Scene& scene, const RenderArguments& args, const Console& console) {
  if (args.no_volume && args.isosurfaces.empty() && args.intervals.empty())
    throw Error("--no-volume leaves nothing to see; add an --iso or an --interval");
  Classification classification = scene.classification();
  const ScalarField& field = scene.field();
  auto warn_outside = [&](const std::string& what, float low, float high) {
    if (high < field.low || low > field.high)
      console.say(fmt::format("{} is outside of '{}', which runs from {:g} to {:g}", what,
                              field.name, field.low, field.high));
  };
  for (const std::string& text : args.isosurfaces) {
    classification.isosurfaces.push_back(parse_isosurface(text, scene.transfer_function()));
    const float value = classification.isosurfaces.back().value;
    warn_outside("--iso " + text, value, value);
  }
  for (const std::string& text : args.intervals) {
    classification.intervals.push_back(parse_interval(text, scene.transfer_function()));
    warn_outside("--interval " + text, classification.intervals.back().low,
                 classification.intervals.back().high);
  }
  if (args.no_volume) classification.volume.reset();
  scene.set_classification(std::move(classification));
}

namespace {

// Moves the camera away, and widens its parallel projection, until each view of the orbit sees all
// of the bounds.
void fit_orbit(Camera& camera, const Bounds& bounds, const RenderArguments& args,
               double aspect_ratio) {
  const auto arm_of = [](const Camera& from) {
    std::array<double, 3> arm{};
    for (std::size_t a = 0; a < 3; ++a) arm[a] = from.position[a] - from.focal_point[a];
    return arm;
  };
  const auto length = [](const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); };
  double distance = 0, scale = 0;
  for (int frame = 0; frame < args.orbit; ++frame) {
    const Camera view = turned(camera, args, 360.0 * frame / args.orbit);
    const auto arm = arm_of(view);
    Camera fitted = fitted_camera(bounds, {-arm[0], -arm[1], -arm[2]}, view.view_up, aspect_ratio);
    distance = std::max(distance, length(arm_of(fitted)));
    scale = std::max(scale, fitted.parallel_scale);
  }
  const auto arm = arm_of(camera);
  for (std::size_t a = 0; a < 3; ++a)
    camera.position[a] = camera.focal_point[a] + distance / length(arm) * arm[a];
  camera.parallel_scale = scale;
}

}  // namespace

Camera choose_camera(const Bounds& bounds, const RenderArguments& args, double aspect_ratio) {
  Camera camera = named_view(args.view, bounds, aspect_ratio);
  if (!args.camera.empty()) {
    const auto n = parse_numbers("--camera", args.camera, {6, 9});
    camera.position = {n[0], n[1], n[2]};
    camera.focal_point = {n[3], n[4], n[5]};
    if (n.size() == 9) camera.view_up = {n[6], n[7], n[8]};
  }
  camera.parallel = args.parallel;
  if (args.view_angle != 0) camera.view_angle = args.view_angle;
  orbit(camera, args.azimuth, args.elevation);
  if (args.orbit > 0 && args.camera.empty()) fit_orbit(camera, bounds, args, aspect_ratio);
  zoom(camera, args.zoom);
  return camera;
}

Camera turned(const Camera& first, const RenderArguments& args, double turn) {
  Camera camera = first;
  if (turn == 0) return camera;
  // Down to where view up was chosen, around, and up again: the horizon stays where it is.
  orbit(camera, 0, -args.elevation);
  orbit(camera, turn, args.elevation);
  return camera;
}

std::string describe_camera(const Camera& camera) {
  return fmt::format("position {} focal point {} view up {} view angle {} parallel scale {}{}",
                     fmt::join(camera.position, ","), fmt::join(camera.focal_point, ","),
                     fmt::join(camera.view_up, ","), camera.view_angle, camera.parallel_scale,
                     camera.parallel ? " (parallel)" : "");
}

void choose_background(const std::string& text, ImageFileOptions& options) {
  if (text == "transparent") return;
  std::vector<double> rgb;
  if (text == "white")
    rgb = {1, 1, 1};
  else if (text == "black")
    rgb = {0, 0, 0};
  else
    rgb = parse_numbers("--background", text, {3});
  for (std::size_t c = 0; c < 3; ++c) {
    if (rgb[c] < 0 || rgb[c] > 1)
      throw Error(fmt::format("--background '{}': each number must be 0 to 1", text));
    options.background[c] = static_cast<float>(rgb[c]);
  }
}

}  // namespace plume::command
