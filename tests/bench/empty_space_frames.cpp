#include "plume/tests/bench/empty_space_frames.h"

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/mesh/range_tree.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/picture_error.h"
#include "plume/tests/bench/timing.h"

namespace plume::bench {
namespace {

// Visible around a share of the range, and from there `width` of it either way. What is almost
// nothing elsewhere keeps the tree away, and looks the same.
TransferFunction around(const ScalarField& field, float share, float width, float elsewhere) {
  const float range = field.high - field.low, middle = field.low + share * range;
  TransferFunction function;
  function.knots = {{middle - width * range, {elsewhere, {1, 0, 0}}},
                    {middle, {20, {1, 0.5f, 0}}},
                    {middle + width * range, {elsewhere, {0, 0, 1}}}};
  return function;
}

Classification surface(const ScalarField& field, float share, float elsewhere) {
  Classification classification;
  classification.isosurfaces = {{field.low + share * (field.high - field.low), 1, {1, 1, 1}}};
  if (elsewhere > 0) {
    classification.volume.emplace();
    classification.volume->knots = {{field.low, {elsewhere, {1, 1, 1}}}};
  }
  return classification;
}

Classification volume(const TransferFunction& function) {
  Classification classification;
  classification.volume = function;
  return classification;
}

}  // namespace

bool compare_empty_space(const EmptySpaceOptions& options) {
  const Mesh mesh = generate("box-rectilinear", {options.cells, 0.2, 1});
  SceneOptions of_waves;
  of_waves.field.name = "waves";
  Scene scene(mesh, of_waves);
  const WalkableRectilinear grid =
      make_walkable_rectilinear(mesh, select_field(mesh, of_waves.field));
  std::vector<double> build;
  for (int round = 0; round < options.rounds; ++round) {
    const double start = wall_seconds();
    const RangeTree tree(grid);
    build.push_back(wall_seconds() - start);
  }
  fmt::print(
      "\nEmpty space of {0} cells, {1} x {1} pixels, one thread; milliseconds, medians of {2} "
      "frames "
      "in turns\nTree of ranges: {3:.2f} s on all threads, {4:.2f} bytes a cell\n",
      scene.cell_count(), options.size, options.rounds, median(build),
      static_cast<double>(RangeTree(grid).bytes()) / static_cast<double>(scene.cell_count()));
  fmt::print("{:<26}{:>10}{:>10}{:>10}{:>9}{:>10}{:>9}\n", "shown", "visible", "tree", "walk",
             "ratio", "packets", "ratio");
  const Camera camera = named_view("iso", scene.bounds());
  // Extinction over the whole range that no picture shows.
  constexpr float kNothing = 1e-20f;
  struct Case {
    std::string name;
    Classification shown, everywhere;
  };
  std::vector<Case> cases;
  for (const float width : {0.1f, 0.05f, 0.02f, 0.01f, 0.003f})
    cases.push_back({fmt::format("range of {:g}", 2 * width),
                     volume(around(scene.field(), 0.7f, width, 0)),
                     volume(around(scene.field(), 0.7f, width, kNothing))});
  for (const float share : {0.7f, 0.95f})
    cases.push_back({fmt::format("isosurface at {:g}", share), surface(scene.field(), share, 0),
                     surface(scene.field(), share, kNothing)});
  bool same = true;
  for (const Case& c : cases) {
    Scene everywhere(mesh, of_waves);
    scene.set_classification(c.shown);
    everywhere.set_classification(c.everywhere);
    RenderSettings settings;
    settings.width = settings.height = options.size;
    settings.threads = 1;
    // Without packets, so that the tree is taken however much is visible.
    settings.channels = {"depth"};
    RenderSettings walked = settings;
    walked.scalar_twin = true;
    RenderSettings packets = settings;
    packets.channels = {};
    const RenderResult ours = render(scene, camera, settings);
    const RenderResult twin = render(scene, camera, walked);
    const RenderResult theirs = render(everywhere, camera, packets);
    same = same && ours.image.rgba == twin.image.rgba &&
           picture_error(theirs.image, ours.image).largest < 4e-5;
    const std::vector<std::function<void()>> tasks{[&] { render(scene, camera, settings); },
                                                   [&] { render(scene, camera, walked); },
                                                   [&] { render(everywhere, camera, packets); }};
    const auto seconds = take_turns(tasks, options.rounds);
    const double tree = median(seconds[0]), walk = median(seconds[1]);
    const double by_packets = median(seconds[2]);
    fmt::print("{:<26}{:>9.1f}%{:>10.1f}{:>10.1f}{:>9.1f}{:>10.1f}{:>9.2f}\n", c.name,
               100 * static_cast<double>(ours.statistics.cells_visited) /
                   static_cast<double>(twin.statistics.cells_visited),
               1e3 * tree, 1e3 * walk, walk / tree, 1e3 * by_packets, by_packets / tree);
    std::fflush(stdout);
  }
  if (!same) std::fputs("plume_frame_bench: the pictures differ\n", stderr);
  return same;
}

}  // namespace plume::bench
