// plume render: a mesh file becomes a picture, or a series of them.

#include <memory>

#include "commands.h"
#include "console.h"
#include "parse.h"
#include "planned_frames.h"
#include "plume/io/image_file.h"
#include "plume/io/whole_file.h"
#include "plume/lib/plume.h"
#include "render_arguments.h"
#include "render_choices.h"
#include "render_series.h"

namespace plume::command {
namespace {

RenderSettings choose_settings(const RenderArguments& args) {
  RenderSettings settings;
  const PictureSize size = parse_size(args.size);
  settings.width = size.width;
  settings.height = size.height;
  settings.mode = mode_named(args.mode);
  if (!args.integrator.empty()) settings.integrator.kind = chosen(kIntegrators, args.integrator);
  settings.integrator.samples = args.samples;
  settings.interval_form = chosen(kIntervalForms, args.interval_form);
  settings.interval_way = chosen(kIntervalWays, args.interval_way);
  settings.overlap = chosen(kOverlaps, args.overlap);
  if (!args.order.empty()) settings.order = chosen(kOrders, args.order);
  if (args.early_termination) settings.early_termination = *args.early_termination;
  if (args.tolerance)
    settings.tolerance = Tolerance{*args.tolerance, args.order.empty(), args.integrator.empty(),
                                   !args.early_termination};
  settings.threads = args.threads;
  settings.channels = args.channels;
  choose_light_and_clip(args, settings);
  choose_gray_range(args, settings);
  return settings;
}

void run(const RenderArguments& args) {
  // What can be wrong without a mesh is said now, not after a long read.
  const RenderSettings settings = choose_settings(args);
  ImageFileOptions file_options;
  file_options.png_bits = args.bits;
  choose_background(args.background, file_options);
  check_image_path(first_output(args.output));
  if (!args.stats.empty()) check_writable(args.stats);
  // What can be wrong with a camera shows with any bounds.
  const double aspect_ratio = static_cast<double>(settings.width) / settings.height;
  PixelRays(choose_camera({{0, 0, 0}, {1, 1, 1}}, args, aspect_ratio), settings.width,
            settings.height);
  render_series(args, settings, file_options, Console(args.quiet));
}

}  // namespace

void add_render(CLI::App& app) {
  auto args = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Render a mesh file to a PNG or EXR picture");
  add_render_options(*command, *args);
  command->callback([args] { run(*args); });
}

}  // namespace plume::command
