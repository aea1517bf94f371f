// Pictures of orders above 1 by packets of rays against those of the plain scalar code, with every
// instruction set.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hwy/targets.h"
#include "plume/datasets/generate.h"
#include "plume/lib/mode_difference.h"
#include "plume/lib/planner.h"
#include "plume/lib/plume.h"
#include "plume/lib/render_modes.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/tests/lib/slabs.h"
#include "plume/traverse/packets.h"

namespace plume::test {
namespace {

class CurvedPackets : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Each, CurvedPackets,
                         testing::Values("box-hexahedra", "twisted", "box-wedges", "box-mixed"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::erase(name, '-');
                           return name;
                         });

constexpr double kTolerance = 3e-5;  // of the field's range
// Of what differs within the tolerance, the extinction changes by a few times that; along a ray
// most of it cancels.
constexpr double kBound = 2 * kTolerance;
constexpr ScalarOrder kHigher[] = {ScalarOrder::quadratic, ScalarOrder::cubic,
                                   ScalarOrder::adaptive};

// A wave that cells of a ninth of the box bend.
Mesh wavy(Mesh mesh) {
  std::vector<float> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    const auto at = point_at(mesh, p);
    values.push_back(static_cast<float>(std::sin(4 * at[0] + 2) * std::cos(3 * at[1] - 3 * at[2])));
  }
  mesh.fields = {{"wave", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "wave";
  return mesh;
}

TransferFunction bumps() {
  return {{{-0.9f, {0, {0, 0, 1}}},
           {-0.3f, {3, {0, 1, 1}}},
           {0, {0.5f, {1, 1, 0}}},
           {0.4f, {0, {1, 0, 0}}},
           {0.9f, {4, {1, 0.5f, 0.2f}}}}};
}

RenderSettings settings_of(ScalarOrder order) {
  RenderSettings settings;
  settings.width = 61;  // no multiple of a tile
  settings.height = 47;
  settings.early_termination = 0;
  settings.order = order;
  // Both cut the scalar into linear parts, but elsewhere.
  settings.scalar_tolerance = kTolerance;
  return settings;
}

Camera oblique(const Scene& scene) { return fitted_camera(scene.bounds(), {-0.6, 0.5, -0.62}); }

// The scalar code. Its parts are chords, all of which lie on one side of a bend; packets' keep the
// mean, and are closer. So that packets' errors are seen and not the chords', it cuts finer.
RenderSettings closer_twin(RenderSettings settings) {
  settings.scalar_twin = true;
  settings.scalar_tolerance = 1e-6;
  return settings;
}

void expect_close(const Scene& scene, const Camera& camera, RenderSettings settings, double bound) {
  const RenderResult packets = render(scene, camera, settings);
  settings = closer_twin(settings);
  const RenderResult twin = render(scene, camera, settings);
  EXPECT_GT(packets.statistics.rays_in_packets, 0u);
  EXPECT_EQ(twin.statistics.rays_in_packets, 0u);
  EXPECT_EQ(packets.statistics.cells_visited, twin.statistics.cells_visited);
  double worst = 0;
  for (std::size_t i = 0; i < twin.image.rgba.size(); ++i) {
    const double difference =
        std::abs(static_cast<double>(packets.image.rgba[i]) - twin.image.rgba[i]);
    ASSERT_FALSE(std::isnan(difference)) << i;
    worst = std::max(worst, difference);
  }
  EXPECT_LE(worst, bound);
}

template <class Body>
void for_each_set(const Body& body) {
  for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) {
    limit_packet_instruction_sets(all & -all);
    SCOPED_TRACE(packet_instruction_set());
    body();
  }
  limit_packet_instruction_sets(0);
}

TEST_P(CurvedPackets, CompositeAsTheTwinDoes) {
  Scene scene(wavy(generate(GetParam(), {9, 0.2, 2})));
  scene.set_transfer_function(bumps());
  for_each_set([&] {
    for (const ScalarOrder order : kHigher)
      expect_close(scene, oblique(scene), settings_of(order), kBound);
  });
  // And not as at order 1.
  const Camera camera = oblique(scene);
  const Image linear = render(scene, camera, settings_of(ScalarOrder::linear)).image;
  const Image quadratic = render(scene, camera, settings_of(ScalarOrder::quadratic)).image;
  const Image cubic = render(scene, camera, settings_of(ScalarOrder::cubic)).image;
  double from_linear = 0, from_quadratic = 0;
  for (std::size_t i = 0; i < cubic.rgba.size(); ++i) {
    from_linear = std::max<double>(from_linear, std::abs(cubic.rgba[i] - linear.rgba[i]));
    from_quadratic = std::max<double>(from_quadratic, std::abs(cubic.rgba[i] - quadratic.rgba[i]));
  }
  EXPECT_GT(from_linear, 5e-3);
  EXPECT_GT(from_quadratic, 1e-4);
  EXPECT_LT(from_quadratic, from_linear);
}

// Numbers in shares of what they may come to: the field's range, extinctions up to 4, and the box's
// diagonal.
double bound_of(Mode mode) {
  switch (mode) {
    case Mode::maximum:
    case Mode::minimum:
    case Mode::average:
    case Mode::integral:
      return 4e-6;
    case Mode::optical_depth:
      return 4 * kBound;
    case Mode::depth:
      // Where a polynomial of such a value meets the first knot.
      return 1e-4;
    default:
      return 0;
  }
}

// What cubics may be off by, in the field's unit, over the box's diagonal.
constexpr double kOfCubics = 2 * 1.8 * kTolerance;

TEST_P(CurvedPackets, FindTheNumbersThatTheTwinFinds) {
  Scene scene(wavy(generate(GetParam(), {9, 0.2, 2})));
  scene.set_transfer_function(bumps());
  const Camera camera = oblique(scene);
  for_each_set([&] {
    for (const ScalarOrder order : kHigher)
      for (const Mode mode : {Mode::maximum, Mode::minimum, Mode::average, Mode::integral,
                              Mode::optical_depth, Mode::depth, Mode::cell_count}) {
        SCOPED_TRACE(in_words(mode).name);
        RenderSettings settings = settings_of(order);
        settings.mode = mode;
        const RenderResult packets = render(scene, camera, settings);
        settings = closer_twin(settings);
        const RenderResult twin = render(scene, camera, settings);
        EXPECT_GT(packets.statistics.rays_in_packets, 0u);
        EXPECT_EQ(twin.statistics.rays_in_packets, 0u);
        double worst = 0;
        for (std::size_t i = 0; i < twin.image.channels[0].values.size(); ++i) {
          ASSERT_EQ(packets.image.rgba[4 * i + 3], twin.image.rgba[4 * i + 3]) << i;
          if (twin.image.rgba[4 * i + 3] == 0) continue;
          const double difference = std::abs(static_cast<double>(twin.image.channels[0].values[i]) -
                                             packets.image.channels[0].values[i]);
          ASSERT_FALSE(std::isnan(difference)) << i;
          worst = std::max(worst, difference);
        }
        EXPECT_LE(worst, bound_of(mode) + (order == ScalarOrder::adaptive ? kOfCubics : 0));
      }
  });
}

TEST_P(CurvedPackets, GoOnBehindGaps) {
  Scene scene(wavy(slabs(GetParam())));
  scene.set_transfer_function(bumps());
  const Camera camera = fitted_camera(scene.bounds(), {-1, 0.1, -0.07});
  for_each_set([&] {
    for (const ScalarOrder order : kHigher) expect_close(scene, camera, settings_of(order), kBound);
  });
}

TEST_P(CurvedPackets, SeeThroughCellsWithWhatIsNotANumber) {
  Mesh mesh = wavy(generate(GetParam(), {9, 0.2, 2}));
  std::vector<float> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    values.push_back(p % 19 == 0   ? std::numeric_limits<float>::quiet_NaN()
                     : p % 31 == 0 ? std::numeric_limits<float>::infinity()
                                   : static_cast<float>(point_at(mesh, p)[0]));
  mesh.fields = {{"holes", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "holes";
  Scene scene(mesh);
  scene.set_transfer_function(bumps());
  for_each_set([&] {
    for (const ScalarOrder order : kHigher)
      expect_close(scene, oblique(scene), settings_of(order), kBound);
  });
}

TEST_P(CurvedPackets, EndARayWhereItIsOpaque) {
  Scene scene(wavy(generate(GetParam(), {9, 0.2, 2})));
  scene.set_transfer_function({{{0, {20, {1, 0.5f, 0.2f}}}}});
  RenderSettings settings = settings_of(ScalarOrder::quadratic);
  settings.early_termination = 1e-3;
  const RenderResult packets = render(scene, oblique(scene), settings);
  settings.scalar_twin = true;
  const RenderResult twin = render(scene, oblique(scene), settings);
  for (std::size_t i = 0; i < twin.image.rgba.size(); ++i)
    ASSERT_NEAR(packets.image.rgba[i], twin.image.rgba[i], 2e-3);
  RenderSettings whole = settings;
  whole.early_termination = 0;
  EXPECT_LT(packets.statistics.cells_visited,
            render(scene, oblique(scene), whole).statistics.cells_visited);
}

// As closely as was asked for, against the reference: parts keep the mean of what they stand for,
// so that pictures come closer than the scalar code's.
TEST_P(CurvedPackets, OfAdaptiveOrderKeepToTheirTolerance) {
  Scene scene(wavy(generate(GetParam(), {5, 0.3, 2})));
  scene.set_transfer_function(bumps());
  const Camera camera = oblique(scene);
  RenderSettings settings = settings_of(ScalarOrder::adaptive);
  const Image right = render(scene, camera, reference_settings(settings)).image;
  for_each_set([&] {
    for (const double to : {1e-2, 1e-3, 1e-4}) {
      settings.scalar_tolerance = to;
      const RenderResult packets = render(scene, camera, settings);
      EXPECT_GT(packets.statistics.rays_in_packets, 0u);
      EXPECT_LE(greatest_difference(packets.image, right, Mode::volume, 0), to);
    }
  });
}

// Cells so twisted that no cubic follows the scalar along a ray.
TEST(CurvedPacketsOfAdaptiveOrder, FollowWhatNoCubicDoes) {
  const Mesh mesh = wavy(generate("twisted", {3, 0.45, 2}));
  Scene scene(mesh);
  scene.set_transfer_function(bumps());
  const Camera camera = oblique(scene);
  RenderSettings settings = settings_of(ScalarOrder::cubic);
  const Image right = render(scene, camera, reference_settings(settings)).image;
  EXPECT_GT(greatest_difference(render(scene, camera, settings).image, right, Mode::volume, 0),
            4 * kTolerance);
  settings.order = ScalarOrder::adaptive;
  for_each_set([&] {
    const RenderResult packets = render(scene, camera, settings);
    EXPECT_GT(packets.statistics.rays_in_packets, 0u);
    EXPECT_LE(greatest_difference(packets.image, right, Mode::volume, 0), kTolerance);
  });
}

// Cells that no vector inverts: the scalar code is asked, or they are linear.
TEST(CurvedPacketsOfBadCells, AreAsTheTwins) {
  Mesh mesh = wavy(generate("box-hexahedra", {9, 0, 2}));
  std::vector<double> points;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    auto at = point_at(mesh, p);
    at[2] = at[2] > 0.7 ? 0.7 + 1e-6 * at[2] : at[2];  // layers, nearly without thickness
    if (at[0] > 0.9) at[1] *= 0.5;
    if (at[0] < 0.3 && at[1] > 0.7) at[0] = 0;  // collapsed
    points.insert(points.end(), at.begin(), at.end());
  }
  mesh.points = Array::own(std::move(points));
  Scene scene(mesh);
  scene.set_transfer_function(bumps());
  for_each_set([&] {
    for (const ScalarOrder order : kHigher)
      expect_close(scene, oblique(scene), settings_of(order), kBound);
  });
}

}  // namespace
}  // namespace plume::test
