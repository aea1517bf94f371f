#include "plume/tests/bench/scaling/scaling_frames.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "plume/datasets/generate.h"
#include "plume/mesh/error.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {

ScalingFrame iso_frame(const Scene& scene, int size) {
  ScalingFrame frame{&scene, named_view("iso", scene.bounds()), {}};
  orbit(frame.camera, 3, 2);
  frame.settings.width = frame.settings.height = size;
  frame.settings.threads = 1;
  frame.settings.early_termination = 0;
  return frame;
}

std::vector<FrameCost> frame_costs(const std::vector<ScalingFrame>& frames, int rounds) {
  std::vector<FrameCost> costs(frames.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < frames.size(); ++i)
    tasks.emplace_back([&frame = frames[i], &cost = costs[i]] {
      const RenderStatistics made = render(*frame.scene, frame.camera, frame.settings).statistics;
      if (made.rays_hit == 0) throw Error("no ray of a frame meets its mesh");
      if (made.lost_rays > 0) throw Error("rays of a frame were lost");
      cost.rays_hit = static_cast<double>(made.rays_hit);
      cost.cells_per_ray = static_cast<double>(made.cells_visited) / cost.rays_hit;
      cost.entries_per_ray = static_cast<double>(made.entries) / cost.rays_hit;
    });
  for (const auto& task : tasks) task();  // once beforehand, for caches and threads
  const auto seconds = take_turns(tasks, rounds);
  for (std::size_t i = 0; i < costs.size(); ++i) costs[i].seconds = median(seconds[i]);
  return costs;
}

Mesh unit_cube(const std::string& kind, double cells) {
  struct Kind {
    const char *name, *generator;
    double cells_per_cuboid;
  };
  constexpr Kind kKinds[] = {{"tetrahedra", "box-tetrahedra", 6},
                             {"hexahedra", "box-hexahedra", 1},
                             {"mixed cells", "box-mixed", 2.516},
                             {"rectilinear grid", "box-rectilinear", 1}};
  for (const Kind& one : kKinds)
    if (kind == one.name)
      return generate(
          one.generator,
          {static_cast<int>(std::lround(std::cbrt(cells / one.cells_per_cuboid))), 0.2, 1});
  throw Error("there is no kind of cells \"" + kind + "\"");
}

}  // namespace plume::bench
