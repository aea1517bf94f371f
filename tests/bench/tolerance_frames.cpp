#include "plume/tests/bench/tolerance_frames.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "plume/lib/planner.h"
#include "plume/lib/plume.h"
#include "plume/lib/render_modes.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

constexpr std::array kTolerances{1e-2, 1e-3, 1e-4};

bool check_scene(const std::string& name, const Mesh& mesh, int size, int rounds) {
  Scene scene(mesh);
  scene.set_transfer_function(seven_knots(scene));
  const Camera camera = frame_cameras(scene.bounds())[3].camera;
  bool good = true;
  for (const ModeInWords& words : modes_in_words()) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.mode = words.mode;
    const double start = wall_seconds();
    const RenderResult right = render(scene, camera, reference_settings(settings));
    const Image& reference = right.image;
    fmt::print("{:<24}{:<15}{:>9}{:>11}{:>10}{:>9.0f}\n", name, words.name, "0", "", "",
               1e3 * (wall_seconds() - start));
    const double width = shade_width(right.statistics);
    for (const double asked : kTolerances) {
      settings.tolerance = Tolerance{asked};
      std::vector<double> planning, all;
      RenderResult result;
      for (int round = 0; round < rounds; ++round) {
        const double begin = wall_seconds();
        result = render(scene, camera, settings);
        all.push_back(wall_seconds() - begin);
        planning.push_back(result.statistics.seconds_planning);
      }
      const double error = greatest_difference(result.image, reference, words.mode, width);
      std::string order;
      for (const std::string& line : result.statistics.plan)
        if (line.rfind("order of the scalar: ", 0) == 0) order = line.substr(21);
      fmt::print("{:<39}{:>9.0e}{:>11.1e}{:>10.0f}{:>9.0f}  {}{}\n", "", asked, error,
                 1e3 * median(planning), 1e3 * (median(all) - median(planning)), order,
                 error > asked ? "  ABOVE WHAT WAS ASKED" : "");
      std::fflush(stdout);
      good = good && error <= asked;
    }
  }
  return good;
}

}  // namespace

bool check_tolerances(int size, int rounds) {
  fmt::print(
      "\nTolerances, {0} x {0} pixels, view iso, all threads, medians of {1}: greatest error of a "
      "channel\nagainst the reference, milliseconds to plan and to render, and the order that was "
      "chosen and why.\n\n",
      size, rounds);
  fmt::print("{:<24}{:<15}{:>9}{:>11}{:>10}{:>9}\n", "mesh", "mode", "asked", "error", "plan ms",
             "ms");
  bool good = true;
  for (const MeshSource& source : mesh_sources(Family::hexahedra)) {
    if (source.name == "twisted") continue;
    const auto mesh = source.load();
    if (!mesh) continue;
    good = check_scene(source.name, *mesh, size, rounds) && good;
    if (source.name == "blunt-fin")
      good = check_scene("blunt-fin, tetrahedra", cut_into_tetrahedra(*mesh), size, rounds) && good;
  }
  return good;
}

}  // namespace plume::bench
