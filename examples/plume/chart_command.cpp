// plume chart: error against time, of every way to make a picture of a mesh.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <memory>

#include "chart.h"
#include "chart_file.h"
#include "chart_plot.h"
#include "chart_report.h"
#include "chart_walkers.h"
#include "commands.h"
#include "console.h"
#include "parse.h"
#include "plume/io/read_file.h"
#include "plume/io/read_mesh.h"
#include "plume/io/whole_file.h"
#include "render_arguments.h"
#include "render_choices.h"
#include "stopwatch.h"

namespace plume::command {
namespace {

struct ChartArguments {
  RenderArguments picture;
  std::vector<std::string> outputs, others;
  int rounds = 0;
  bool quick = false;
};

bool is_drawn(const std::string& output) {
  const std::string extension = lower_extension(output);
  return extension == ".png" || extension == ".svg";
}

void check_outputs(const std::vector<std::string>& outputs) {
  for (const std::string& output : outputs) {
    const std::string extension = lower_extension(output);
    if (!is_drawn(output) && extension != ".csv" && extension != ".json")
      throw Error(fmt::format("{}: a chart is written as .png, .svg, .csv or .json", output));
    check_writable(output);
  }
  if (std::any_of(outputs.begin(), outputs.end(), is_drawn)) require_gnuplot();
}

void write_chart(const Chart& chart, const std::string& output) {
  const std::string extension = lower_extension(output);
  if (extension == ".csv")
    write_whole_file(output, chart_csv(chart));
  else if (extension == ".json")
    write_whole_file(output, chart_json(chart));
  else
    draw_chart(chart, output);
}

RenderSettings base_settings(const ChartArguments& args) {
  RenderSettings settings;
  const PictureSize size = parse_size(!args.picture.size.empty() ? args.picture.size
                                      : args.quick               ? "160x120"
                                                                 : "640x480");
  settings.width = size.width;
  settings.height = size.height;
  settings.threads = args.picture.threads;
  return settings;
}

int threads_of(const RenderSettings& settings) {
  const int available = tbb::this_task_arena::max_concurrency();
  return settings.threads > 0 ? std::min(settings.threads, available) : available;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  return fmt::format("{:04}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
}

std::string in_words(double seconds) {
  return seconds < 90 ? fmt::format("{:.0f} s", std::max(1.0, seconds))
                      : fmt::format("{:.0f} min", seconds / 60);
}

// Shows where it is: a line that changes where there is a terminal, else one line for the estimate.
class ProgressTeller {
 public:
  ProgressTeller(const Console& console, std::size_t ways) : console_(console), ways_(ways) {}

  void operator()(const ChartProgress& at) {
    if (at.seconds_left && !estimated_) {
      estimated_ = true;
      console_.progress_line({});
      console_.say(fmt::format("{} ways rendered once in {}; timing them takes about {} more",
                               ways_, in_words(watch_.lap() / 1000), in_words(*at.seconds_left)));
    }
    console_.progress_line(
        at.share >= 1
            ? std::string{}
            : fmt::format("[{:=<{}}{:<{}}] {:3.0f}%{} {}", "", static_cast<int>(at.share * 30), "",
                          30 - static_cast<int>(at.share * 30), at.share * 100,
                          at.seconds_left ? ", " + in_words(*at.seconds_left) + " to go:" : ":",
                          at.doing));
  }

 private:
  const Console& console_;
  const std::size_t ways_;
  Stopwatch watch_;
  bool estimated_ = false;
};

Scene make_scene(const ChartArguments& args, const Console& console) {
  const RenderArguments& picture = args.picture;
  ReadOptions options;
  options.solution = picture.solution;
  options.merge_points = picture.merge_points;
  const Mesh mesh =
      read_mesh(picture.mesh, options, [&](const std::string& line) { console.say(line); });
  SceneOptions scene_options;
  scene_options.field.name = picture.field;
  if (picture.association == "point") scene_options.field.association = Association::point;
  if (picture.association == "cell") scene_options.field.association = Association::cell;
  scene_options.cell_data = chosen(kCellData, picture.cell_data);
  try {
    return Scene(mesh, scene_options);
  } catch (const Error& error) {
    throw Error(picture.mesh + ": " + error.what());
  }
}

ChartSubject subject_of(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                        const ChartArguments& args, int rounds) {
  return {std::filesystem::path(args.picture.mesh).filename().string(),
          scene.form(),
          scene.cell_count(),
          scene.field().name,
          settings.width,
          settings.height,
          threads_of(settings),
          rounds,
          processor_name(),
          today(),
          describe_camera(camera)};
}

void run(const ChartArguments& args) {
  // What can be wrong without a mesh is said now, not after a long read.
  const RenderSettings settings = base_settings(args);
  check_outputs(args.outputs);
  std::vector<ChartPoint> others;
  for (const std::string& file : args.others) {
    const std::vector<ChartPoint> points = read_chart_csv(file);
    others.insert(others.end(), points.begin(), points.end());
  }
  const double aspect_ratio = static_cast<double>(settings.width) / settings.height;
  PixelRays(choose_camera({{0, 0, 0}, {1, 1, 1}}, args.picture, aspect_ratio), settings.width,
            settings.height);

  const Console console(args.picture.quiet);
  Scene scene = make_scene(args, console);
  choose_transfer_function(scene, look_fitted_to(scene), args.picture, console);
  const Camera camera = choose_camera(scene.visible_bounds(), args.picture, aspect_ratio);
  const int rounds = args.rounds > 0 ? args.rounds : args.quick ? 2 : 5;
  std::vector<ChartWay> ways = chart_ways(scene, settings, args.quick);
  if (!args.quick)
    for (ChartWay& way : other_walkers(scene, camera, settings)) ways.push_back(std::move(way));
  for (ChartWay& way : planned_ways(scene, camera, settings)) ways.push_back(std::move(way));
  console.say(fmt::format("{}: {} cells ({}), {} ways to make {} x {} pixels, {} rounds",
                          args.picture.mesh, with_separators(scene.cell_count()), scene.form(),
                          ways.size(), settings.width, settings.height, rounds));
  ProgressTeller teller(console, ways.size());
  ChartMeasurement measured =
      measure_ways(scene, camera, settings, std::move(ways), rounds, std::ref(teller));
  const Chart chart =
      make_chart(subject_of(scene, camera, settings, args, rounds), std::move(measured), others);
  if (!args.picture.quiet) std::fputs(chart_report(chart).c_str(), stdout);
  for (const std::string& output : args.outputs) {
    write_chart(chart, output);
    console.say(output);
  }
}

}  // namespace

void add_chart(CLI::App& app) {
  auto args = std::make_shared<ChartArguments>();
  args->picture.size.clear();
  CLI::App* command = app.add_subcommand(
      "chart", "Measure error against time, of every way to make a picture of a mesh file");
  add_mesh_options(*command, args->picture);
  command
      ->add_option("-o,--output", args->outputs,
                   "Write the chart: .png or .svg (drawn by gnuplot), .csv or .json (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--size", args->picture.size, "Pixels: WIDTHxHEIGHT (640x480)");
  add_camera_options(*command, args->picture);
  add_color_options(*command, args->picture);
  command->add_option("--threads", args->picture.threads, "Threads, 0 for all (0)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--rounds", args->rounds, "Frames timed of each way, in turns (5)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--quick", args->quick,
                    "Few ways, two rounds and 160x120 pixels unless said otherwise");
  command
      ->add_option("--also", args->others,
                   "Show points measured elsewhere, too, and compare: a CSV file with the columns "
                   "method,family,milliseconds,max_error,rms_error (repeatable)")
      ->allow_extra_args(false);
  command->add_flag("--quiet", args->picture.quiet, "Print nothing but errors");
  command->callback([args] { run(*args); });
}

}  // namespace plume::command
