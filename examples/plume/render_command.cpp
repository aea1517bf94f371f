// plume render: a mesh file becomes a picture.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "console.h"
#include "parse.h"
#include "plume/io/image_file.h"
#include "plume/io/read_mesh.h"
#include "plume/io/whole_file.h"
#include "plume/lib/plume.h"
#include "plume/lib/render_modes.h"
#include "render_arguments.h"
#include "render_choices.h"
#include "render_report.h"

namespace plume::command {
namespace {

class Stopwatch {
 public:
  double lap() {
    const auto now = Clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(start_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

void run(const RenderArguments& args) {
  const Console console(args.quiet);
  const PictureSize size = parse_size(args.size);
  ImageFileOptions file_options;
  file_options.png_bits = args.bits;
  choose_background(args.background, file_options);
  check_image_path(args.output);
  if (!args.stats.empty()) check_writable(args.stats);
  RenderSettings settings;
  choose_light_and_clip(args, settings);
  const double aspect_ratio = static_cast<double>(size.width) / size.height;
  // What can be wrong with a camera shows with any bounds: said now, not after a long read.
  PixelRays(choose_camera({{0, 0, 0}, {1, 1, 1}}, args, aspect_ratio), size.width, size.height);

  Stopwatch watch;
  ReadOptions read_options;
  read_options.solution = args.solution;
  read_options.merge_points = args.merge_points;
  if (args.time_step >= 0) read_options.time_step = args.time_step;
  const Notice notice = [&](const std::string& line) { console.say(line); };
  auto mesh = std::make_unique<Mesh>(read_mesh(args.mesh, read_options, notice));
  const double ms_read = watch.lap();

  SceneOptions scene_options;
  scene_options.field.name = args.field;
  if (args.association == "point") scene_options.field.association = Association::point;
  if (args.association == "cell") scene_options.field.association = Association::cell;
  scene_options.cell_data = chosen(kCellData, args.cell_data);
  scene_options.keep_cell_numbers = asks_for(args.channels, "cell_id");
  scene_options.keep_gradients = settings.lighting || asks_for(args.channels, "normal");
  auto scene = [&] {
    try {
      return Scene(*mesh, scene_options);
    } catch (const Error& error) {
      throw Error(args.mesh + ": " + error.what());
    }
  }();
  mesh.reset();  // the scene needs it no more
  choose_transfer_function(scene, args, console);
  choose_classification(scene, args, console);
  const double ms_build = watch.lap();
  const ScalarField& field = scene.field();
  console.say(fmt::format("{}: {} cells, coloured by '{}' ({}, {:g} to {:g})", args.mesh,
                          with_separators(scene.cell_count()), field.name,
                          scene.cell_data_averaged()                ? "cell data averaged to points"
                          : field.association == Association::point ? "point data"
                                                                    : "cell data",
                          field.low, field.high));
  for (const Finding& finding : scene.findings()) console.say(describe(finding));

  settings.width = size.width;
  settings.height = size.height;
  settings.mode = mode_named(args.mode);
  if (!args.integrator.empty()) settings.integrator.kind = chosen(kIntegrators, args.integrator);
  settings.integrator.samples = args.samples;
  settings.interval_form = chosen(kIntervalForms, args.interval_form);
  settings.interval_way = chosen(kIntervalWays, args.interval_way);
  if (!args.order.empty()) settings.order = chosen(kOrders, args.order);
  if (args.early_termination) settings.early_termination = *args.early_termination;
  if (args.tolerance)
    settings.tolerance = Tolerance{*args.tolerance, args.order.empty(), args.integrator.empty(),
                                   !args.early_termination};
  settings.threads = args.threads;
  settings.channels = args.channels;
  const Camera camera = choose_camera(scene.bounds(), args, aspect_ratio);
  const RenderResult result = render(scene, camera, settings, console.progress_bar());
  const double ms_render = watch.lap();
  const RenderStatistics& statistics = result.statistics;
  if (statistics.values) {
    const auto& [low, high] = *statistics.values;
    const std::string unit = in_words(settings.mode).unit;
    console.say(fmt::format("{} of '{}': {:g} to {:g}{}", in_words(settings.mode).channel,
                            field.name, low, high, unit.empty() ? "" : " (" + unit + ")"));
  }
  if (args.verbose)
    for (const std::string& line : statistics.plan) console.say(line);

  file_options.metadata = {
      {"Software", "plume " PLUME_VERSION},
      {"plume:mesh", std::filesystem::path(args.mesh).filename().string()},
      {"plume:field", field.name},
      {"plume:mode", args.mode},
      {"plume:plan", fmt::format("{}", fmt::join(statistics.plan, "; "))},
      {"plume:camera",
       fmt::format("position {} focal point {} view up {} view angle {} parallel "
                   "scale {}{}",
                   fmt::join(camera.position, ","), fmt::join(camera.focal_point, ","),
                   fmt::join(camera.view_up, ","), camera.view_angle, camera.parallel_scale,
                   camera.parallel ? " (parallel)" : "")}};
  write_image(result.image, args.output, file_options);
  const double ms_write = watch.lap();

  if (!args.stats.empty())
    write_whole_file(args.stats, render_report(scene, settings, args, result.statistics,
                                               {ms_read, ms_build, ms_render, ms_write}));
  console.say(fmt::format("{}: {} x {}, {} cells walked, {} rays lost, {:.0f} ms", args.output,
                          size.width, size.height, with_separators(statistics.cells_visited),
                          statistics.lost_rays, ms_render));
}

}  // namespace

void add_render(CLI::App& app) {
  auto args = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Render a mesh file to a PNG or EXR picture");
  add_render_options(*command, *args);
  command->callback([args] { run(*args); });
}

}  // namespace plume::command
