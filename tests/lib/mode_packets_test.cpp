// The modes that show one number a ray by packets of rays, against the plain scalar code, with
// every instruction set.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hwy/targets.h"
#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/lib/render_modes.h"
#include "plume/tests/lib/slabs.h"
#include "plume/traverse/packets.h"

namespace plume::test {
namespace {

// Meshes that packets walk.
class ModePackets : public testing::TestWithParam<const char*> {
 protected:
  template <class Body>
  void for_each_set(const Body& body) {
    for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) {
      limit_packet_instruction_sets(all & -all);
      SCOPED_TRACE(packet_instruction_set());
      body();
    }
    limit_packet_instruction_sets(0);
  }
};
INSTANTIATE_TEST_SUITE_P(Each, ModePackets,
                         testing::Values("box-tetrahedra", "box-hexahedra", "twisted", "box-wedges",
                                         "box-mixed", "box-rectilinear"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::erase(name, '-');
                           return name;
                         });

constexpr Mode kModes[] = {Mode::maximum,       Mode::minimum, Mode::average,   Mode::integral,
                           Mode::optical_depth, Mode::depth,   Mode::cell_count};

RenderSettings settings_of(Mode mode) {
  RenderSettings settings;
  settings.width = 61;  // no multiple of a tile
  settings.height = 47;
  settings.mode = mode;
  return settings;
}

// Of what is measured in single precision, but for the scalar's steepness, which is 1 in the scenes
// of box's side 1; of the depth, in world units.
double bound_of(const Scene& scene, Mode mode) {
  const double range = std::max(std::abs(scene.field().low), std::abs(scene.field().high));
  const double chord = scene.bounds().diagonal();
  switch (mode) {
    case Mode::maximum:
    case Mode::minimum:
    case Mode::average:
      return 1e-6 * range;
    case Mode::integral:
      return 1e-6 * range * chord;
    case Mode::optical_depth: {
      float most = 0;
      for (const auto& knot : scene.transfer_function().knots)
        most = std::max(most, knot.optics.extinction);
      return 4e-6 * most * chord;
    }
    case Mode::depth:
      return 2e-6 * chord;
    default:
      return 0;
  }
}

// Through the hierarchy instead, or past blocks of cells without a greater or lesser scalar.
bool goes_another_way(const Scene& scene, Mode mode) {
  const std::string form = scene.form();
  return (mode == Mode::maximum || mode == Mode::minimum) &&
         (form == "rectilinear grid" ||
          (form == "tetrahedra" && scene.field().association == Association::point));
}

// The same pixels are seen, and nowhere do numbers differ by more than `bound`.
void expect_close(const Scene& scene, const Camera& camera, Mode mode, double bound,
                  bool by_packets = true) {
  SCOPED_TRACE(in_words(mode).name);
  RenderSettings settings = settings_of(mode);
  const RenderResult packets = render(scene, camera, settings);
  settings.scalar_twin = true;
  const RenderResult twin = render(scene, camera, settings);
  EXPECT_EQ(twin.statistics.rays_in_packets, 0u);
  EXPECT_EQ(packets.statistics.rays_in_packets > 0, by_packets && !goes_another_way(scene, mode));
  EXPECT_EQ(packets.statistics.rays_hit, twin.statistics.rays_hit);
  EXPECT_EQ(packets.statistics.lost_rays, 0u);
  if (packets.statistics.rays_in_packets > 0 && mode != Mode::depth) {
    EXPECT_EQ(packets.statistics.entries, twin.statistics.entries);
    EXPECT_EQ(packets.statistics.cells_visited, twin.statistics.cells_visited);
  }
  const auto& found = packets.image.channels.at(0).values;
  const auto& right = twin.image.channels.at(0).values;
  std::size_t seen = 0;
  double worst = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    ASSERT_EQ(packets.image.rgba[4 * i + 3], twin.image.rgba[4 * i + 3]) << "pixel " << i;
    if (twin.image.rgba[4 * i + 3] == 0) continue;
    ++seen;
    const double difference = std::abs(static_cast<double>(found[i]) - right[i]);
    ASSERT_FALSE(std::isnan(difference) && found[i] != right[i]) << found[i] << " " << right[i];
    worst = std::max(worst, difference);
  }
  EXPECT_GT(seen, right.size() / 8);
  EXPECT_LE(worst, bound);
}

Camera oblique(const Scene& scene) { return fitted_camera(scene.bounds(), {-0.6, 0.5, -0.62}); }

// Transparent at the ends and in the middle.
TransferFunction two_bumps(const Scene& scene) {
  const auto low = static_cast<float>(scene.field().low);
  const float range = static_cast<float>(scene.field().high) - low;
  return {{{low + 0.3f * range, {0, {0, 0, 1}}},
           {low + 0.35f * range, {3, {0, 1, 1}}},
           {low + 0.4f * range, {0, {0, 1, 0}}},
           {low + 0.6f * range, {0, {1, 1, 0}}},
           {low + 0.7f * range, {2, {1, 0, 0}}},
           {low + 0.7f * range, {0, {1, 0, 0}}}}};
}

// More pieces than are permuted.
TransferFunction forty_knots(const Scene& scene) {
  TransferFunction many;
  const auto low = static_cast<float>(scene.field().low);
  const float range = static_cast<float>(scene.field().high) - low;
  for (int k = 0; k < 40; ++k)
    many.knots.push_back(
        {low + range * static_cast<float>(k) / 39, {static_cast<float>(k * 7 % 5), {1, 1, 1}}});
  return many;
}

TEST_P(ModePackets, FindWhatTheTwinFinds) {
  Scene scene(generate(GetParam(), {9, 0.2, 2}), {{"linear", {}}});
  scene.set_transfer_function(two_bumps(scene));
  for_each_set([&] {
    for (const Mode mode : kModes) expect_close(scene, oblique(scene), mode, bound_of(scene, mode));
  });
  scene.set_transfer_function(forty_knots(scene));
  for_each_set([&] {
    expect_close(scene, oblique(scene), Mode::optical_depth, bound_of(scene, Mode::optical_depth));
  });
}

TEST_P(ModePackets, FindTheGreatestAndTheLeastOfCellsBitForBit) {
  Mesh mesh = generate(GetParam(), {9, 0.2, 2});
  std::vector<float> values;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    values.push_back(c % 11 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                 : static_cast<float>(c * 7919 % 1000));
  mesh.fields.push_back({"numbers", Association::cell, 1, Array::own(std::move(values))});
  Scene scene(mesh, {{"numbers", {}}});
  scene.set_transfer_function(two_bumps(scene));
  for_each_set([&] {
    for (const Mode mode : kModes) {
      const bool exact = mode == Mode::maximum || mode == Mode::minimum;
      // Of a ray through a thousandth of the box, lengths are known to a ten thousandth.
      const double factor = exact ? 0 : mode == Mode::average ? 100 : 1;
      expect_close(scene, oblique(scene), mode, factor * bound_of(scene, mode));
    }
  });
}

TEST_P(ModePackets, GoOnBehindGaps) {
  Scene scene(slabs(GetParam()), {{"linear", {}}});
  scene.set_transfer_function(two_bumps(scene));
  const Camera camera = fitted_camera(scene.bounds(), {-1, 0.1, -0.07});
  for_each_set([&] {
    for (const Mode mode : kModes) {
      if (std::string(scene.form()) == "rectilinear grid") continue;  // hidden cells: the twin's
      expect_close(scene, camera, mode, bound_of(scene, mode));
    }
  });
}

TEST_P(ModePackets, PassOverWhatIsNotANumber) {
  Mesh mesh = generate(GetParam(), {6, 0.2, 2});
  std::vector<float> values;
  for (std::size_t i = 0; i < mesh.point_count(); ++i)
    values.push_back(i % 7 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                : static_cast<float>(i * 7919 % 1000) * 1e-3f);
  mesh.fields = {{"holes", Association::point, 1, Array::own(std::move(values))}};
  Scene scene(mesh);
  scene.set_transfer_function(two_bumps(scene));
  for_each_set([&] {
    for (const Mode mode : kModes) {
      // The place of a first contribution, where the scalar is steep and known in bits, is not.
      if (mode == Mode::depth) continue;
      expect_close(scene, oblique(scene), mode, 8 * bound_of(scene, mode));
    }
  });
}

TEST_P(ModePackets, LeaveCamerasInsideToTheTwin) {
  Scene scene(generate(GetParam(), {6, 0.2, 2}));
  Camera camera;
  camera.position = {0.4, 0.5, 0.6};
  camera.focal_point = {1, 0.6, 0.5};
  camera.view_angle = 100;
  for (const Mode mode : {Mode::integral, Mode::cell_count}) {
    expect_close(scene, camera, mode, 0, false);
  }
}

}  // namespace
}  // namespace plume::test
