#include "render_series.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "other_meshes.h"
#include "planned_frames.h"
#include "plume/io/time_series.h"
#include "plume/io/whole_file.h"
#include "plume/lib/render_modes.h"
#include "read_ahead.h"
#include "render_choices.h"
#include "render_report.h"
#include "series_scene.h"
#include "stopwatch.h"

namespace plume::command {
namespace {

std::vector<std::size_t> steps_of(const std::vector<PlannedFrame>& frames) {
  std::vector<std::size_t> steps;
  for (const PlannedFrame& frame : frames)
    if (steps.empty() || steps.back() != frame.step) steps.push_back(frame.step);
  return steps;
}

SceneOptions scene_options(const RenderArguments& args, const RenderSettings& settings) {
  SceneOptions options;
  options.name = args.mesh;
  options.field.name = args.field;
  if (args.association == "point") options.field.association = Association::point;
  if (args.association == "cell") options.field.association = Association::cell;
  options.cell_data = chosen(kCellData, args.cell_data);
  options.keep_cell_numbers = asks_for(args.channels, "cell_id");
  options.keep_gradients = settings.lighting || asks_for(args.channels, "normal");
  options.compact_tetrahedra = args.compact;
  return options;
}

// Says each thing once, whatever file it is said of.
class Once {
 public:
  explicit Once(const Console& console) : console_(console) {}
  void say(const std::string& line, const std::string& without_file) {
    if (said_.insert(without_file).second) console_.say(line);
  }

 private:
  const Console& console_;
  std::set<std::string> said_;
};

class SeriesRenderer {
 public:
  SeriesRenderer(const RenderArguments& args, RenderSettings settings,
                 ImageFileOptions file_options, const Console& console)
      : args_(args),
        settings_(std::move(settings)),
        file_options_(std::move(file_options)),
        console_(console),
        once_(console),
        series_(args.mesh, read_options(args),
                [&](const std::string& line) { once_.say(line, line); }),
        frames_(plan_frames(args, series_)),
        steps_(steps_of(frames_)),
        scene_(args, console, scene_options(args, settings_), steps_.size() > 1),
        others_(args, console, scene_options(args, settings_), series_, steps_.size() > 1),
        // One thread reads at a time, and the other meshes are read here.
        reader_(series_, steps_, steps_.size() > 1 && !args.no_read_ahead && others_.empty()) {
    scene_.show_surfaces();
  }

  void run() {
    Stopwatch watch;
    const PlannedFrame* before = nullptr;
    for (const PlannedFrame& frame : frames_) {
      StageTimes ms{};
      if (!before || before->step != frame.step) show_step(frame.step, ms);
      before = &frame;
      make_picture(frame, ms);
    }
    if (!args_.stats.empty()) write_whole_file(args_.stats, render_report(std::move(records_)));
    if (frames_.size() > 1) say_what_it_came_to(watch.lap());
  }

 private:
  static ReadOptions read_options(const RenderArguments& args) {
    ReadOptions options;
    options.solution = args.solution;
    options.merge_points = args.merge_points;
    return options;
  }

  bool several_frames() const { return frames_.size() > 1; }

  // Runs `work`, whose errors speak of a step as if it were all there is.
  template <class Work>
  void of_step(std::size_t step, Work&& work) {
    try {
      work();
    } catch (const Error& error) {
      if (series_.size() == 1) throw;
      throw Error(fmt::format("{}: {}: {}", args_.mesh, series_.describe(step), error.what()));
    }
  }

  void show_step(std::size_t step, StageTimes& ms) {
    ReadAhead::Taken taken;
    of_step(step, [&] { taken = reader_.next(); });
    ms.read = taken.ms_read;
    ms.wait = taken.ms_wait;
    time_ = taken.step.time;
    const std::string file = series_.file(step).string() + ": ";
    for (const std::string& line : taken.notices)
      once_.say(line, line.starts_with(file) ? line.substr(file.size()) : line);
    Stopwatch watch;
    others_.read(step);
    ms.read += watch.lap();
    const bool first = step == steps_.front();
    of_mesh(step, [&] {
      if (first && !others_.empty())
        others_.prepare(scene_, taken.step.mesh, scene_options(args_, settings_).field);
      scene_.show(std::move(taken.step.mesh), series_);
    });
    others_.show();
    if (first) of_mesh(step, [&] { choose_looks(); });
    ms.build = watch.lap();
    if (scene_.mesh_stayed()) ++meshes_stayed_;
    if (first) say_what_is_shown();
    for (const Scene* scene : scenes())
      for (const Finding& finding : scene->findings())
        once_.say(describe(finding), describe(finding));
    choose_camera_once();
  }

  std::vector<const Scene*> scenes() const { return others_.scenes_with(scene_.scene()); }

  void choose_looks() {
    if (others_.empty())
      scene_.choose_look(look_fitted_to(scene_.scene()));
    else
      others_.choose_looks(scene_);
  }

  // As of_step(), of a mesh, which a file of one step is.
  template <class Work>
  void of_mesh(std::size_t step, Work&& work) {
    of_step(step, [&] {
      try {
        work();
      } catch (const Error& error) {
        const std::string words = error.what();
        if (series_.size() > 1 || others_.is_of_one(words)) throw;
        throw Error(args_.mesh + ": " + words);
      }
    });
  }

  void say_what_is_shown() {
    for (const Scene* scene : scenes()) {
      const ScalarField& field = scene->field();
      console_.say(fmt::format("{}: {} cells, coloured by '{}' ({}, {:g} to {:g})", scene->name(),
                               with_separators(scene->cell_count()), field.name,
                               scene->cell_data_averaged() ? "cell data averaged to points"
                               : field.association == Association::point ? "point data"
                                                                         : "cell data",
                               field.low, field.high));
    }
    if (!scene_.fitted_to().empty()) {
      const auto& knots = scene_.scene().transfer_function().knots;
      console_.say(fmt::format("colours and opacity are fitted to {}, {:g} to {:g}",
                               scene_.fitted_to(), knots.front().scalar, knots.back().scalar));
    }
  }

  void choose_camera_once() {
    const Bounds bounds = visible_bounds(scenes());
    if (!camera_) {
      const double aspect_ratio = static_cast<double>(settings_.width) / settings_.height;
      camera_ = choose_camera(bounds, args_, aspect_ratio);
      first_bounds_ = bounds;
    } else if (args_.camera.empty() &&
               (bounds.low != first_bounds_.low || bounds.high != first_bounds_.high)) {
      const std::string line = "the mesh moves; the camera stays where it sees the first step";
      once_.say(line, line);
    }
  }

  void make_picture(const PlannedFrame& frame, StageTimes& ms) {
    const Camera camera = turned(*camera_, args_, frame.turn);
    Stopwatch watch;
    RenderResult result;
    of_step(frame.step,
            [&] { result = render(scenes(), camera, settings_, console_.progress_bar()); });
    ms.render = watch.lap();
    const RenderStatistics& statistics = result.statistics;
    take_values(statistics);
    if (!several_frames()) say_values();
    say_whether_tolerance_is_kept(statistics);
    if (args_.verbose && records_.empty())
      for (const std::string& line : statistics.plan) console_.say(line);

    file_options_.metadata = metadata(frame, camera, statistics);
    write_image(result.image, frame.output, file_options_);
    ms.write = watch.lap();
    records_.push_back(
        render_record({frame.output, frame.step, time_, frame.turn, scene_.mesh_stayed()}, scenes(),
                      settings_, args_, statistics, ms));
    const std::string walked =
        fmt::format("{} cells walked, {} rays lost, {:.0f} ms",
                    with_separators(statistics.cells_visited), statistics.lost_rays, ms.render);
    console_.say(several_frames()
                     ? fmt::format("{}: {}, {}", frame.output, series_.describe(frame.step), walked)
                     : fmt::format("{}: {} x {}, {}", frame.output, settings_.width,
                                   settings_.height, walked));
  }

  void say_whether_tolerance_is_kept(const RenderStatistics& statistics) {
    if (statistics.keeps_tolerance) return;
    once_.say(fmt::format("what is forced does not keep to --tolerance {:g}: its error is "
                          "estimated at {:.1g}; --verbose says of what",
                          settings_.tolerance->max_error, *statistics.error_estimate),
              "tolerance");
  }

  void take_values(const RenderStatistics& statistics) {
    // The first picture that has a range of grays gives it to those after it.
    if (several_frames() && !settings_.gray_range) settings_.gray_range = statistics.gray_range;
    if (!statistics.values) return;
    const auto& [low, high] = *statistics.values;
    mode_values_ = mode_values_ ? std::array{std::min((*mode_values_)[0], low),
                                             std::max((*mode_values_)[1], high)}
                                : *statistics.values;
  }

  void say_values() {
    if (!mode_values_) return;
    const std::string unit = in_words(settings_.mode).unit;
    console_.say(fmt::format("{} of '{}': {:g} to {:g}{}", in_words(settings_.mode).channel,
                             scene_.scene().field().name, (*mode_values_)[0], (*mode_values_)[1],
                             unit.empty() ? "" : " (" + unit + ")"));
  }

  std::vector<std::pair<std::string, std::string>> metadata(
      const PlannedFrame& frame, const Camera& camera, const RenderStatistics& statistics) const {
    std::vector<std::pair<std::string, std::string>> lines{
        {"Software", std::string("plume ") + version()},
        {"plume:mesh", series_.file(frame.step).filename().string()},
        {"plume:field", scene_.scene().field().name},
        {"plume:mode", args_.mode},
        {"plume:plan", fmt::format("{}", fmt::join(statistics.plan, "; "))},
        {"plume:camera", describe_camera(camera)}};
    for (const std::string& other : args_.others) lines.emplace_back("plume:with", other);
    if (series_.size() > 1) lines.emplace_back("plume:step", std::to_string(frame.step));
    if (time_) lines.emplace_back("plume:time", fmt::format("{}", *time_));
    return lines;
  }

  // What was chosen from the first step may not suit all.
  void say_what_it_came_to(double ms) {
    say_values();
    const std::string& field = scene_.scene().field().name;
    const auto& [low, high] = scene_.values();
    const auto& colors = scene_.scene().transfer_function().knots;
    if (steps_.size() > 1 && (low < colors.front().scalar || high > colors.back().scalar))
      console_.say(
          fmt::format("'{}' ran from {:g} to {:g}, and colours from {:g} to {:g}; --tf-range "
                      "{:g},{:g} shows all",
                      field, low, high, colors.front().scalar, colors.back().scalar, low, high));
    if (settings_.gray_range && mode_values_ &&
        ((*mode_values_)[0] < (*settings_.gray_range)[0] ||
         (*mode_values_)[1] > (*settings_.gray_range)[1]))
      console_.say(
          fmt::format("shades of gray ran from {:g} to {:g}; --gray-range {:g},{:g} shows all",
                      (*settings_.gray_range)[0], (*settings_.gray_range)[1], (*mode_values_)[0],
                      (*mode_values_)[1]));
    console_.say(fmt::format(
        "{} pictures of {} time step{} in {:.1f} s{}", frames_.size(), steps_.size(),
        steps_.size() > 1 ? "s" : "", ms / 1000,
        meshes_stayed_ > 0 ? fmt::format("; the mesh stayed {} times", meshes_stayed_) : ""));
  }

  const RenderArguments& args_;
  RenderSettings settings_;
  ImageFileOptions file_options_;
  const Console& console_;
  Once once_;
  TimeSeries series_;
  const std::vector<PlannedFrame> frames_;
  const std::vector<std::size_t> steps_;
  SeriesScene scene_;
  OtherMeshes others_;
  std::optional<double> time_;  // of the step shown
  std::optional<Camera> camera_;
  Bounds first_bounds_{};
  std::optional<std::array<float, 2>> mode_values_;  // of all pictures
  std::size_t meshes_stayed_ = 0;
  std::vector<nlohmann::json> records_;
  ReadAhead reader_;  // reads from series_ in a thread of its own
};

}  // namespace

void render_series(const RenderArguments& args, RenderSettings settings,
                   ImageFileOptions file_options, const Console& console) {
  SeriesRenderer(args, std::move(settings), std::move(file_options), console).run();
}

}  // namespace plume::command
