#include "plume/tests/bench/tolerance_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "plume/lib/planner.h"
#include "plume/lib/plume.h"
#include "plume/lib/render_modes.h"
#include "plume/lib/render_plan.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

constexpr std::array kTolerances{1e-2, 1e-3, 1e-4};

// A frame's planning and what follows, in seconds.
struct PlannedFrame {
  RenderResult result;
  double planning = 0, rendering = 0;
};

PlannedFrame planned_frame(const Scene& scene, const Camera& camera,
                           const RenderSettings& settings) {
  const double begin = wall_seconds();
  PlannedFrame frame{render(scene, camera, settings)};
  frame.planning = frame.result.statistics.seconds_planning;
  frame.rendering = wall_seconds() - begin - frame.planning;
  return frame;
}

std::string order_of(const RenderStatistics& statistics) {
  for (const std::string& line : statistics.plan)
    if (line.rfind("order of the scalar: ", 0) == 0) return line.substr(21);
  return "";
}

// What a new transfer function, a new view and nothing new cost before a frame, in shares of it.
void time_planning(const std::string& name, Scene& scene, int size, int rounds) {
  const TransferFunction look = scene.transfer_function();
  TransferFunction other = look;
  for (auto& knot : other.knots) knot.optics.extinction *= 1.5f;
  fmt::print("\n{}: milliseconds before a frame, and the frame\n", name);
  for (const double asked : kTolerances) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.tolerance = Tolerance{asked};
    Camera camera = frame_cameras(scene.bounds())[3].camera;
    std::vector<double> anew, again, view, frame;
    for (int round = 0; round < rounds; ++round) {
      scene.set_transfer_function(round % 2 == 0 ? look : other);
      settings.tolerance->keep_plans = false;
      anew.push_back(planned_frame(scene, camera, settings).planning);
      settings.tolerance->keep_plans = true;
      planned_frame(scene, camera, settings);
      PlannedFrame same = planned_frame(scene, camera, settings);
      again.push_back(same.planning);
      frame.push_back(same.rendering);
      orbit(camera, 3, 0);
      view.push_back(planned_frame(scene, camera, settings).planning);
    }
    fmt::print(
        "{:>9.0e}  a new transfer function {:8.3f}  another view {:8.3f}  nothing new {:8.5f}  the "
        "frame {:6.1f}\n",
        asked, 1e3 * median(anew), 1e3 * median(view), 1e3 * median(again), 1e3 * median(frame));
    std::fflush(stdout);
  }
  scene.set_transfer_function(look);
}

// Orbits of six views by which plans are kept: none may be above what was asked.
bool check_orbit(const std::string& name, const Scene& scene, int size) {
  bool good = true;
  for (const plume::Mode mode : {plume::Mode::volume, plume::Mode::integral})
    for (const double asked : kTolerances) {
      RenderSettings settings;
      settings.width = settings.height = size;
      settings.mode = mode;
      Camera camera = frame_cameras(scene.bounds())[3].camera;
      double worst = 0;
      int anew = 0;
      for (int view = 0; view < 6; ++view) {
        orbit(camera, 25, 0);
        settings.tolerance.reset();
        const RenderResult right = render(scene, camera, reference_settings(settings));
        settings.tolerance = Tolerance{asked};
        const RenderResult result = render(scene, camera, settings);
        worst = std::max(worst, greatest_difference(result.image, right.image, mode,
                                                    shade_width(right.statistics)));
        if (order_of(result.statistics).find("as for an earlier") == std::string::npos) ++anew;
      }
      fmt::print(
          "{}, {}, an orbit of 6 views, {:.0e} asked: at most {:.1e}, planned anew {} times{}\n",
          name, in_words(mode).name, asked, worst, anew,
          worst > asked ? "  ABOVE WHAT WAS ASKED" : "");
      std::fflush(stdout);
      good = good && worst <= asked;
    }
  return good;
}

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
      settings.tolerance->keep_plans = false;
      std::vector<double> planning, rendering;
      PlannedFrame frame;
      for (int round = 0; round < rounds; ++round) {
        frame = planned_frame(scene, camera, settings);
        planning.push_back(frame.planning);
        rendering.push_back(frame.rendering);
      }
      const RenderResult& result = frame.result;
      const double error = greatest_difference(result.image, reference, words.mode, width);
      const std::string order = order_of(result.statistics);
      fmt::print("{:<39}{:>9.0e}{:>11.1e}{:>10.0f}{:>9.0f}  {}{}\n", "", asked, error,
                 1e3 * median(planning), 1e3 * median(rendering), order,
                 error > asked ? "  ABOVE WHAT WAS ASKED" : "");
      std::fflush(stdout);
      good = good && error <= asked;
    }
  }
  if (!has_linear_cells(scene)) good = check_orbit(name, scene, size) && good;
  time_planning(name, scene, size, rounds);
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
