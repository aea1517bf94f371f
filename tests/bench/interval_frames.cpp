#include "plume/tests/bench/interval_frames.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/picture_error.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

constexpr double kAim = 1.3;
// Of linear RGBA. A ray that just reaches an isosurface by the one and just misses it by the other
// would be off by its opacity; none of these does.
constexpr double kSameThing = 1e-4;

// Of the values from the 1st to the 99th percentile: two intervals, and an isosurface between them.
Classification with_surfaces(const Scene& scene) {
  Classification all = scene.classification();
  const float low = all.volume->knots.front().scalar, high = all.volume->knots.back().scalar;
  auto at = [&](float share) { return low + share * (high - low); };
  all.intervals = {{at(0.3f), at(0.4f), even_profile(0.3f, {0.2f, 0.5f, 1})},
                   {at(0.7f), at(0.8f), even_profile(0.4f, {1, 0.5f, 0.1f})}};
  all.isosurfaces = {{at(0.55f), 0.4f, {0.9f, 0.9f, 0.9f}}};
  return all;
}

struct Sums {
  double volume = 0, surfaces = 0, lit = 0;
};

class Comparison {
 public:
  Comparison(const IntervalFrameOptions& options, std::string name, const Mesh& mesh)
      : options_(options),
        name_(std::move(name)),
        volume_(mesh, {{}, false, CellData::constant, true}),
        surfaces_(mesh, {{}, false, CellData::constant, true}) {
    volume_.set_transfer_function(seven_knots(volume_));
    surfaces_.set_transfer_function(volume_.transfer_function());
    surfaces_.set_classification(with_surfaces(surfaces_));
  }

  bool run() {
    bool same = true;
    Sums sums;
    for (const NamedCamera& view : frame_cameras(volume_.bounds())) same = row(view, sums) && same;
    fmt::print("{:<12}{:<14}{:>9.1f}{:>9.1f}{:>8.2f}{:>16}{:>9.1f}{:>8.2f}   (aimed at: {})\n",
               name_, "all", 1e3 * sums.volume, 1e3 * sums.surfaces, sums.surfaces / sums.volume,
               "", 1e3 * sums.lit, sums.lit / sums.volume, kAim);
    std::fflush(stdout);
    return same;
  }

 private:
  RenderSettings settings(bool lit) const {
    RenderSettings made;
    made.width = made.height = options_.size;
    made.threads = 1;
    made.early_termination = 0;
    if (lit) made.lighting = Lighting{};
    return made;
  }

  bool row(const NamedCamera& view, Sums& sums) {
    auto picture = [&](const Scene& scene, const RenderSettings& how) {
      return render(scene, view.camera, how).image;
    };
    RenderSettings twin = settings(true);
    twin.scalar_twin = true;
    const PictureError off =
        picture_error(picture(surfaces_, settings(true)), picture(surfaces_, twin));
    const std::vector<std::function<void()>> tasks{[&] { picture(volume_, settings(false)); },
                                                   [&] { picture(surfaces_, settings(false)); },
                                                   [&] { picture(surfaces_, settings(true)); }};
    const auto seconds = take_turns(tasks, options_.rounds);
    std::vector<double> ratios;
    for (std::size_t round = 0; round < seconds[0].size(); ++round)
      ratios.push_back(seconds[1][round] / seconds[0][round]);
    const double alone = median(seconds[0]), with = median(seconds[1]), lit = median(seconds[2]);
    sums.volume += alone;
    sums.surfaces += with;
    sums.lit += lit;
    fmt::print("{:<12}{:<14}{:>9.1f}{:>9.1f}{:>8.2f}{:>16}{:>9.1f}{:>8.2f}{:>10.1e}{:>10.1e}\n",
               name_, view.name, 1e3 * alone, 1e3 * with, with / alone,
               fmt::format("{:.2f} to {:.2f}", *std::min_element(ratios.begin(), ratios.end()),
                           *std::max_element(ratios.begin(), ratios.end())),
               1e3 * lit, lit / alone, off.largest, off.rms);
    std::fflush(stdout);
    return off.largest < kSameThing;
  }

  const IntervalFrameOptions options_;
  const std::string name_;
  Scene volume_, surfaces_;
};

}  // namespace

bool compare_with_volume_alone(const IntervalFrameOptions& options) {
  const std::optional<Mesh> grid = mesh_sources(Family::hexahedra).front().load();
  if (!grid) return true;
  fmt::print(
      "\nThe blunt fin as a volume of seven knots, alone and with two intervals and an isosurface, "
      "{0} x {0} pixels,\norder 1, one thread; milliseconds on the processor, medians of {1} "
      "frames "
      "in turns. Range: of the ratio from\nround to round. Off the twin: of linear RGBA, lit, "
      "packets against the scalar twin.\n\n",
      options.size, options.rounds);
  fmt::print("{:<12}{:<14}{:>9}{:>9}{:>8}{:>16}{:>9}{:>8}{:>10}{:>10}\n", "cells", "view", "volume",
             "added", "ratio", "range", "lit", "ratio", "off, most", "RMS");
  const bool hexahedra = Comparison(options, "hexahedra", *grid).run();
  const bool tetrahedra = Comparison(options, "tetrahedra", cut_into_tetrahedra(*grid)).run();
  if (!hexahedra || !tetrahedra)
    std::fputs("plume_frame_bench: packets and twin are not of the same thing\n", stderr);
  return hexahedra && tetrahedra;
}

void compare_ways(const IntervalFrameOptions& options) {
  // Tables are built on all threads, and only this one's time is taken.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const std::optional<Mesh> grid = mesh_sources(Family::hexahedra).front().load();
  if (!grid) return;
  Scene scene(cut_into_tetrahedra(*grid));
  scene.set_transfer_function(seven_knots(scene));
  scene.set_classification(with_surfaces(scene));
  const Camera camera = frame_cameras(scene.bounds())[3].camera;
  RenderSettings split;
  split.width = split.height = options.size;
  split.threads = 1;
  split.early_termination = 0;
  split.scalar_twin = true;
  const Image exact = render(scene, camera, split).image;
  fmt::print(
      "\nIntervals and isosurface split in data space and from tables of that many entries along "
      "each axis of\nscalars and 16 lengths, ray by ray, tetrahedra, view iso. Off: of linear "
      "RGBA. "
      "Pixels: off by more than 0.01.\nOf a table's time, that to build it on one thread.\n\n");
  fmt::print("{:<16}{:>10}{:>10}{:>8}{:>10}{:>10}{:>9}\n", "way", "ms", "of which", "ratio",
             "off, most", "RMS", "pixels");
  for (const int scalars : {64, 128, 256, 512}) {
    RenderSettings table = split;
    table.interval_way = IntervalWay::table;
    table.interval_table.scalar_count = scalars;
    // One pixel: hardly more than the table.
    RenderSettings nothing = table;
    nothing.width = nothing.height = 1;
    const Image picture = render(scene, camera, table).image;
    const std::vector<std::function<void()>> tasks{[&] { render(scene, camera, split); },
                                                   [&] { render(scene, camera, table); },
                                                   [&] { render(scene, camera, nothing); }};
    const auto seconds = take_turns(tasks, options.rounds);
    const PictureError off = picture_error(picture, exact);
    std::size_t far = 0;
    for (std::size_t i = 0; i < exact.rgba.size(); i += 4) {
      float most = 0;
      for (std::size_t c = i; c < i + 4; ++c)
        most = std::max(most, std::abs(picture.rgba[c] - exact.rgba[c]));
      if (most > 0.01f) ++far;
    }
    if (scalars == 64)
      fmt::print("{:<16}{:>10.1f}{:>10}{:>8}\n", "split", 1e3 * median(seconds[0]), "", 1);
    fmt::print("{:<16}{:>10.1f}{:>10.1f}{:>8.2f}{:>10.1e}{:>10.1e}{:>8.1f}%\n",
               fmt::format("table, {}", scalars), 1e3 * median(seconds[1]),
               1e3 * median(seconds[2]), median(seconds[1]) / median(seconds[0]), off.largest,
               off.rms, 400.0 * static_cast<double>(far) / static_cast<double>(exact.rgba.size()));
    std::fflush(stdout);
  }
}

}  // namespace plume::bench
