#include "plume/tests/bench/mode_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/lib/render_modes.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

// The greatest difference of a mode's numbers, in shares of the greatest number.
double greatest_difference(const Image& image, const Image& right) {
  double worst = 0, greatest = 0;
  for (std::size_t i = 0; i < right.channels[0].values.size(); ++i) {
    if (right.rgba[4 * i + 3] == 0) continue;
    const double value = right.channels[0].values[i];
    greatest = std::max(greatest, std::abs(value));
    worst = std::max(worst, std::abs(image.channels[0].values[i] - value));
  }
  return greatest > 0 ? worst / greatest : worst;
}

bool compare_on(const std::string& name, const Mesh& mesh, const ModeFrameOptions& options) {
  Scene scene(mesh);
  // Transparent up to the middle of the range, so that a first contribution is inside of the mesh.
  TransferFunction function = seven_knots(scene);
  for (std::size_t k = 0; k < 4; ++k) function.knots[k].optics.extinction = 0;
  scene.set_transfer_function(function);
  const Camera camera = frame_cameras(scene.bounds())[3].camera;
  bool good = true;
  for (const ModeInWords& words : modes_in_words()) {
    if (words.mode == plume::Mode::volume) continue;
    RenderSettings settings;
    settings.width = settings.height = options.size;
    settings.threads = 1;
    settings.mode = words.mode;
    auto picture = [&](bool twin) {
      settings.scalar_twin = twin;
      return render(scene, camera, settings);
    };
    const RenderResult packets = picture(false), twin = picture(true);
    const auto seconds = take_turns(
        std::vector<std::function<void()>>{[&] { picture(false); }, [&] { picture(true); }},
        options.rounds);
    const double by_packets = median(seconds[0]), one_by_one = median(seconds[1]);
    const double off = greatest_difference(packets.image, twin.image);
    // Where it took another way than packets, that is what is compared.
    const char* way = packets.statistics.rays_in_packets > 0 ? "packets"
                      : packets.statistics.rays_searched > 0 ? "hierarchy"
                                                             : "ranges";
    fmt::print("{:<24}{:<15}{:<10}{:>9.1f}{:>12.1f}{:>8.1f}{:>11.1e}\n", name, words.name, way,
               1e3 * by_packets, 1e3 * one_by_one, one_by_one / by_packets, off);
    std::fflush(stdout);
    good = good && off <= 1e-5;
  }
  return good;
}

}  // namespace

bool compare_modes(const ModeFrameOptions& options) {
  fmt::print(
      "\nModes, order 1, {0} x {0} pixels, view iso, one thread; milliseconds on the processor, "
      "medians of {1} frames in\nturns. Off: the greatest difference from the twin's numbers, in "
      "shares of the greatest.\n\n",
      options.size, options.rounds);
  fmt::print("{:<24}{:<15}{:<10}{:>9}{:>12}{:>8}{:>11}\n", "mesh", "mode", "by", "ms", "one by one",
             "ratio", "off");
  bool good = true;
  for (const MeshSource& source : mesh_sources(Family::hexahedra)) {
    if (source.name != "blunt-fin") continue;
    const std::optional<Mesh> mesh = source.load();
    if (!mesh) continue;
    good = compare_on("blunt fin, hexahedra", *mesh, options) && good;
    good = compare_on("blunt fin, tetrahedra", cut_into_tetrahedra(*mesh), options) && good;
  }
  good = compare_on("mixed cells", generate("box-mixed", {24, 0.2, 1}), options) && good;
  good = compare_on("rectilinear grid", generate("box-rectilinear", {96, 0.2, 1}), options) && good;
  return good;
}

}  // namespace plume::bench
