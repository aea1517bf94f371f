#include "render_choices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "parse.h"
#include "plume/io/color_map_file.h"
#include "surface_options.h"

namespace plume::command {

void choose_transfer_function(Scene& scene, const RenderArguments& args, const Console& console) {
  ColorMap map = scene.default_color_map();
  const std::vector<std::string> presets = preset_names();
  if (!args.transfer_function.empty()) {
    if (auto colors = preset(args.transfer_function)) {
      // A preset brings colours; the opacity stays the one fitted to the values.
      colors = rescaled(*colors, map.colors.front().x, map.colors.back().x);
      colors->opacities = map.opacities;
      map = *colors;
    } else if (std::filesystem::exists(args.transfer_function)) {
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
  const double unit = args.unit_distance > 0 ? args.unit_distance : scene.default_unit_distance();
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
  zoom(camera, args.zoom);
  return camera;
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
