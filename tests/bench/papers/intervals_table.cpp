// Ament, Weiskopf and Carr, "Direct Interval Volume Visualization", table 1.

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/papers/paper_tables.h"
#include "plume/tests/bench/papers/stand_in_fields.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

// No reconstruction, from eight samples ("explicit"), from four ("ours" in the paper): frames a
// second of a volume, and of a volume with interval volumes. Empty: the text that we have of the
// paper cannot be read there.
struct DataSet {
  const char* name;
  std::array<int, 3> points;
  StandInField field;
  std::array<const char*, 3> volume, intervals;
};
constexpr DataSet kDataSets[] = {
    {"Aneurism64*",
     {64, 64, 64},
     aneurism_field,
     {"33.12", "8.35", "18.39"},
     {"27.40", "7.69", "13.18"}},
    {"H-Atom*",
     {128, 128, 128},
     orbital_field,
     {"25.62", "5.39", "11.41"},
     {"20.74", "5.09", "9.84"}},
    {"Engine*", {256, 256, 110}, engine_field, {"16.21", "2.91", "6.73"}, {"9.91", "2.57", "4.90"}},
    {"Head*", {256, 256, 225}, head_field, {"", "", ""}, {"", "", ""}},
    {"Aneurism256*",
     {256, 256, 256},
     aneurism_field,
     {"17.75", "4.64", "10.38"},
     {"14.51", "4.12", ""}},
    {"Foot*", {256, 256, 256}, foot_field, {"10.53", "2.85", "4.97"}, {"8.25", "2.12", "4.03"}}};

// A haze of three colours; what is empty is transparent.
TransferFunction haze(const Scene& scene) {
  const float per_length = static_cast<float>(1 / scene.bounds().diagonal());
  return {{{0.02f, {0, {0.2f, 0.3f, 0.8f}}},
           {0.1f, {1.5f * per_length, {0.2f, 0.5f, 0.8f}}},
           {0.25f, {4 * per_length, {0.9f, 0.6f, 0.3f}}},
           {0.6f, {2 * per_length, {0.8f, 0.3f, 0.3f}}},
           {1, {6 * per_length, {1, 0.9f, 0.8f}}}}};
}

// One finite interval of a white thing, and an isosurface.
Classification with_intervals(const Scene& scene) {
  Classification all = scene.classification();
  all.intervals = {{0.45f, 0.7f, even_profile(0.4f, {0.95f, 0.95f, 0.9f})}};
  all.isosurfaces = {{0.15f, 0.15f, {1, 0.6f, 0.2f}}};
  return all;
}

std::string drop(const std::string& volume, const std::string& intervals) {
  if (volume.empty() || intervals.empty()) return "";
  return fmt::format("{:.0f}%", 100 * (1 - std::stod(intervals) / std::stod(volume)));
}

std::string or_illegible(const char* text) { return *text ? text : "illegible"; }

}  // namespace

std::string intervals_table_1(const PaperOptions& options) {
  const int size = options.quick ? 16 : 1024;
  std::vector<std::vector<std::string>> rows{{"data set", "points", "", "paper, fps: none",
                                              "explicit", "four samples", "here, fps: order 1",
                                              "order 3"}};
  for (const DataSet& data : kDataSets) {
    auto points = data.points;
    if (options.quick)
      for (int& count : points) count /= 16;
    const Mesh grid = stand_in_grid(data.field, points);
    Scene volume(grid), intervals(grid);
    volume.set_transfer_function(haze(volume));
    intervals.set_transfer_function(haze(intervals));
    intervals.set_classification(with_intervals(intervals));
    Camera camera = named_view("iso", volume.bounds());
    orbit(camera, 3, 2);
    std::vector<std::function<void()>> tasks;
    for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic})
      for (const Scene* scene : {&volume, &intervals}) {
        RenderSettings settings;
        settings.width = settings.height = size;
        settings.order = order;
        settings.threads = 1;
        tasks.emplace_back([=, &camera] { render(*scene, camera, settings); });
        // What is made once, beforehand.
        settings.width = settings.height = 16;
        render(*scene, camera, settings);
      }

    const auto seconds = take_turns(tasks, options.rounds);
    const auto fps = [&](std::size_t task) {
      return fmt::format("{:.3g}", 1 / median(seconds[task]));
    };
    rows.push_back({data.name, fmt::format("{} x {} x {}", points[0], points[1], points[2]), "DVR",
                    or_illegible(data.volume[0]), or_illegible(data.volume[1]),
                    or_illegible(data.volume[2]), fps(0), fps(2)});
    rows.push_back({"", "", "DVR+IV", or_illegible(data.intervals[0]),
                    or_illegible(data.intervals[1]), or_illegible(data.intervals[2]), fps(1),
                    fps(3)});
    std::vector<std::string> slower{"", "", "slower by"};
    for (std::size_t c = 0; c < 3; ++c) slower.push_back(drop(data.volume[c], data.intervals[c]));
    slower.push_back(drop(fps(0), fps(1)));
    slower.push_back(drop(fps(2), fps(3)));
    rows.push_back(slower);
  }
  return fmt::format(
             R"(Section 8. Paper: 1024 x 1024 pixels, 2.33 GHz Intel Core2 Q8200, 4 GB, NVIDIA GeForce 9800GT with 512 MB, CUDA; empty
space is skipped. Here: {0} x {0} pixels, one thread by its time on the processor, view iso, rays ended at a
transmittance of 1e-4; empty space is skipped at order 3. Medians. The paper gives neither views nor transfer functions. All
data sets are stand-ins of its sizes; one size that is hard to read in our text of the paper is taken as 256 x 256 x 110.

DVR: a volume of five knots. DVR+IV: an interval volume and an isosurface besides. None: linear between a voxel's faces,
which is order 1 here. Four samples: the paper's cubic; here order 3, which takes the same four, interpolated in full
precision, so that it is no less exact than *explicit*, which has no counterpart; order 3 goes ray by ray.

)",
             size) +
         markdown_table(rows);
}

}  // namespace plume::bench
