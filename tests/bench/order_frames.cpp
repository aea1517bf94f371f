// What orders 2 and 3 cost, and what they gain.

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plume/lib/plume.h"
#include "plume/tests/bench/bench_meshes.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/hexahedra_frames.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/picture_error.h"
#include "plume/tests/bench/scalar_error.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

struct Way {
  const char* name;
  ScalarOrder order;
  bool scalar_twin;
};
constexpr Way kWays[] = {
    {"1, packets", ScalarOrder::linear, false},    {"1, scalar twin", ScalarOrder::linear, true},
    {"2, packets", ScalarOrder::quadratic, false}, {"2, scalar twin", ScalarOrder::quadratic, true},
    {"3, packets", ScalarOrder::cubic, false},     {"3, scalar twin", ScalarOrder::cubic, true}};

bool compare_on(const std::string& name, const Mesh& mesh, const HexahedraFrameOptions& options) {
  Scene scene(mesh);
  scene.set_transfer_function(seven_knots(scene));
  const Camera camera = frame_cameras(scene.bounds())[3].camera;
  RenderSettings settings;
  settings.width = settings.height = options.size;
  settings.threads = 1;
  settings.early_termination = 0;
  auto picture = [&](const Way& way) {
    settings.order = way.order;
    settings.scalar_twin = way.scalar_twin;
    return render(scene, camera, settings).image;
  };
  std::vector<std::function<void()>> tasks;
  for (const Way& way : kWays) tasks.emplace_back([&] { picture(way); });
  const auto seconds = take_turns(tasks, options.rounds);
  const double plain = median(seconds[1]);
  const Image cubic = picture(kWays[5]);
  bool nearer = true;
  double before = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Way& way = kWays[i];
    const ScalarError error = scalar_error(mesh, scene, camera, way.order, 2 * options.size);
    if (i > 0 && way.order != kWays[i - 1].order) nearer = nearer && error.rms < before;
    before = error.rms;
    fmt::print("{:<12}{:<16}{:>9.0f}{:>10.2f}{:>11.1e}{:>11.1e}{:>11.1e}{:>12}\n",
               i == 0 ? name : "", way.name, 1e3 * median(seconds[i]), median(seconds[i]) / plain,
               error.rms, error.largest, picture_error(picture(way), cubic).rms,
               error.unanswered > 0
                   ? fmt::format("{}/{}", error.unanswered, error.unanswered + error.samples)
                   : "0");
  }
  std::fflush(stdout);
  if (!nearer) fmt::print(stderr, "plume_frame_bench: {}: a higher order is not nearer\n", name);
  return nearer;
}

}  // namespace

bool compare_orders(const HexahedraFrameOptions& options) {
  fmt::print(
      "\nOrders of the scalar, {0} x {0} pixels, view iso, one thread; medians of {1} frames in "
      "turns.\nErrors of the scalar along {2} rays against the isoparametric oracle, in shares of "
      "the field's range;\npicture: RMS of RGBA from order 3's. Unanswered: places for which the "
      "oracle has no answer.\n\n",
      options.size, options.rounds, 2 * options.size);
  fmt::print("{:<12}{:<16}{:>9}{:>10}{:>11}{:>11}{:>11}{:>12}\n", "mesh", "order", "ms", "x scalar",
             "RMS", "largest", "picture", "unanswered");
  bool nearer = true;
  for (const MeshSource& source : mesh_sources(Family::hexahedra)) {
    const std::optional<Mesh> mesh = source.load();
    if (mesh) nearer = compare_on(source.name, *mesh, options) && nearer;
  }
  return nearer;
}

}  // namespace plume::bench
