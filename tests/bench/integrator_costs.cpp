#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/lib/scene_body.h"
#include "plume/preint/closed_form.h"
#include "plume/preint/piece_table.h"
#include "plume/preint/preintegrated_table.h"
#include "plume/tests/bench/integrator_errors.h"
#include "plume/tests/bench/interleaved.h"
#include "plume/tests/bench/markdown_table.h"
#include "plume/tests/bench/segment_lanes.h"
#include "plume/tests/bench/timing.h"
#include "plume/tests/preint/transfer_functions.h"
#include "plume/traverse/packets.h"

namespace plume::bench {
namespace {

constexpr std::size_t kSegments = 20480;

// Ends anywhere, lengths from 1e-3 to 10: 3.7 of the 8 knots' pieces a segment.
LaneSegments any_segments(std::mt19937_64& random) {
  std::uniform_real_distribution<float> unit(0, 1);
  LaneSegments list;
  for (std::size_t i = 0; i < kSegments; ++i) {
    list.s_in.push_back(unit(random));
    list.s_out.push_back(unit(random));
    list.length.push_back(tests::random_length(random, 1e-3f, 10));
  }
  return list;
}

// Rays on which the scalar goes on from segment to segment by up to 0.03, on 0.02 of length.
LaneSegments mesh_segments(std::mt19937_64& random) {
  std::uniform_real_distribution<float> unit(0, 1);
  LaneSegments list;
  std::vector<float> last(LaneSegments::rays, 0.5f);
  for (std::size_t i = 0; i < kSegments; ++i) {
    float& scalar = last[i % LaneSegments::rays];
    list.s_in.push_back(scalar);
    scalar = std::clamp(scalar + 0.06f * (unit(random) - 0.5f), 0.0f, 1.0f);
    list.s_out.push_back(scalar);
    list.length.push_back(0.02f * unit(random) + 1e-3f);
  }
  return list;
}

template <class Integrator>
void sum_up(const Integrator& integrator, const LaneSegments& segments) {
  float sum = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const SegmentColor color =
        integrator.integrate(segments.s_in[i], segments.s_out[i], segments.length[i]);
    sum += color.r + color.g + color.b + color.alpha;
  }
  volatile float kept = sum;
  (void)kept;
}

std::string new_transfer_function(int rounds, bool quick) {
  const Mesh mesh = generate("box-tetrahedra", {quick ? 8 : 32, 0.2, 1});
  Scene scene(mesh);
  const Camera camera = named_view("iso", scene.bounds());
  RenderSettings settings;
  settings.width = settings.height = 512;
  const std::vector<TransferFunction> functions{tests::random_function(1, 64, 10),
                                                tests::random_function(2, 64, 10)};
  std::vector<double> changes, frames;
  for (int round = 0; round < rounds; ++round) {
    double start = wall_seconds();
    scene.set_transfer_function(functions[static_cast<std::size_t>(round % 2)]);
    // What render() makes of it before it traces.
    const PieceTable pieces(scene.transfer_function());
    const auto integrator =
        scene.body().integrators.get(scene.transfer_function(), settings.integrator);
    changes.push_back(wall_seconds() - start);
    start = wall_seconds();
    render(scene, camera, settings);
    frames.push_back(wall_seconds() - start);
  }
  return fmt::format(
      "A new transfer function of 64 knots takes {:.3f} ms by the closed form (checked, kept, cut "
      "at "
      "its knots), a frame of {} tetrahedra, 512 x 512 pixels, {:.0f} ms: {:.5f} of a frame.\n",
      1e3 * median(changes), scene.cell_count(), 1e3 * median(frames),
      median(changes) / median(frames));
}

}  // namespace

std::string integrator_costs(const IntegratorBenchOptions& options) {
  const TransferFunction function = tests::smooth_function();
  const ClosedForm closed_form(function);
  const PieceTable pieces(function);
  const auto table_of = [&](int scalars) {
    return PreintegratedTable(function,
                              {scalars, 32, std::array{0.0f, 1.0f}, std::array{1e-3f, 10.0f}});
  };
  const PreintegratedTable small = table_of(64), usual = table_of(128);
  std::vector<std::vector<std::string>> rows{{"segments", "evaluated", "closed form, ns",
                                              "table 128 x 128 x 32, ns", "closed form : table",
                                              "table 64 x 64 x 32, ns", "closed form : table"}};
  std::mt19937_64 random(options.seed);
  LaneColors colors;
  colors.resize(kSegments);
  for (const bool mesh : {false, true}) {
    const LaneSegments segments = mesh ? mesh_segments(random) : any_segments(random);
    const std::vector<std::vector<std::function<void()>>> ways{
        {[&] { sum_up(closed_form, segments); }, [&] { sum_up(usual, segments); },
         [&] { sum_up(small, segments); }},
        {[&] { closed_form_by_lanes(pieces, segments, colors); },
         [&] { table_by_lanes(usual, segments, colors); },
         [&] { table_by_lanes(small, segments, colors); }}};
    for (std::size_t way = 0; way < ways.size(); ++way) {
      const auto seconds = take_turns(ways[way], options.rounds);
      const auto ns = [&](std::size_t i) { return 1e9 * median(seconds[i]) / kSegments; };
      rows.push_back({mesh ? "as in a mesh" : "any",
                      way == 0 ? "one by one" : std::string(packet_instruction_set()),
                      fmt::format("{:.1f}", ns(0)), fmt::format("{:.1f}", ns(1)),
                      fmt::format("{:.2f}", ns(0) / ns(1)), fmt::format("{:.1f}", ns(2)),
                      fmt::format("{:.2f}", ns(0) / ns(2))});
    }
  }
  return "### Cost for 8 knots\n\n" + markdown_table(rows) + '\n' +
         new_transfer_function(options.rounds, options.quick);
}

}  // namespace plume::bench
