// Cost and memory against the number of cells.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "plume/tests/bench/counted_memory.h"
#include "plume/tests/bench/frame_scenes.h"
#include "plume/tests/bench/scaling/scaling_frames.h"
#include "plume/tests/bench/scaling/scaling_series.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

ScalingSeries::Point measure(const std::string& kind, double wanted,
                             const ScalingOptions& options) {
  const Mesh mesh = unit_cube(kind, wanted);
  const auto cells = static_cast<double>(mesh.cell_count());
  std::fprintf(stderr, "plume_scaling: %.0f %s\n", cells, kind.c_str());
  std::vector<double> wall, processor, peak;
  std::unique_ptr<Scene> scene;
  for (int round = 0; round < options.rounds; ++round) {
    scene.reset();
    const std::size_t before = counted_bytes();
    forget_peak();
    const double start = wall_seconds(), processor_start = process_seconds();
    scene = std::make_unique<Scene>(mesh);
    wall.push_back(wall_seconds() - start);
    processor.push_back(process_seconds() - processor_start);
    peak.push_back(static_cast<double>(counted_peak() - before));
  }
  scene->set_transfer_function(seven_knots(*scene));
  const FrameCost cost =
      frame_costs({iso_frame(*scene, options.quick ? 32 : 512)}, options.rounds).front();
  return {cells,
          {median(wall), median(processor), static_cast<double>(scene->bytes()) / cells,
           *std::max_element(peak.begin(), peak.end()) / cells, cost.cells_per_ray,
           1e3 * cost.seconds, cost.ns_per_cell()}};
}

}  // namespace

void scale_cells(const ScalingOptions& options, const SeriesMade& made) {
  struct Kind {
    const char* name;
    double most, most_large;
  };
  for (const Kind& kind : {Kind{"tetrahedra", 1e7, 5e7},
                           {"hexahedra", 1e7, 5e7},
                           {"mixed cells", 3.2e6, 1e7},
                           {"rectilinear grid", 1e7, 5e7}}) {
    ScalingSeries series{"cells",
                         kind.name,
                         "cells",
                         {"build, s by the clock", "build, s on processors", "kept, bytes a cell",
                          "peak, bytes a cell", "cells a ray", "frame, ms", "ns a cell met"},
                         {}};
    const double most = options.quick ? 3e3 : options.large ? kind.most_large : kind.most;
    for (const double cells : {1e3, 3e3, 1e4, 3.2e4, 1e5, 3.2e5, 1e6, 3.2e6, 1e7, 5e7})
      if (cells <= most && (cells >= 1e4 || options.quick))
        series.points.push_back(measure(kind.name, cells, options));
    made(series);
  }
}

}  // namespace plume::bench
