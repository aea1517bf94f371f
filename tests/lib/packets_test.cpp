// Pictures by packets of rays against those of the plain scalar code, with every instruction set.

#include "plume/traverse/packets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "hwy/targets.h"
#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/tests/lib/slabs.h"

namespace plume::test {
namespace {

constexpr double kBound = 1e-5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where channel values differ most, packets against twin.
double worst_difference(const Scene& scene, const Camera& camera, double early_termination = 0,
                        bool by_packets = true, int width = 61, int height = 47) {
  RenderSettings settings;
  settings.width = width;  // 61 and 47: no multiple of a tile
  settings.height = height;
  settings.early_termination = early_termination;
  const RenderResult packets = render(scene, camera, settings);
  settings.scalar_twin = true;
  const RenderResult twin = render(scene, camera, settings);
  EXPECT_NE(packets.statistics.plan, twin.statistics.plan);
  EXPECT_EQ(packets.statistics.rays_in_packets > 0, by_packets);
  EXPECT_EQ(twin.statistics.rays_in_packets, 0u);
  EXPECT_EQ(packets.statistics.rays_hit, twin.statistics.rays_hit);
  EXPECT_EQ(packets.statistics.lost_rays, 0u);
  float most_opaque = 0;
  for (std::size_t i = 3; i < twin.image.rgba.size(); i += 4)
    most_opaque = std::max(most_opaque, twin.image.rgba[i]);
  // A ray that nothing can change any more may end, and does so a little earlier or later.
  if (early_termination == 0 && most_opaque < 0.9999f) {
    EXPECT_EQ(packets.statistics.entries, twin.statistics.entries);
    EXPECT_EQ(packets.statistics.cells_visited, twin.statistics.cells_visited);
  }
  double worst = 0;
  for (std::size_t i = 0; i < twin.image.rgba.size(); ++i) {
    const double difference =
        std::abs(static_cast<double>(packets.image.rgba[i]) - twin.image.rgba[i]);
    // The greater of a number and none is the number: that would hide it.
    if (std::isnan(difference)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, difference);
  }
  return worst;
}

Camera oblique(const Scene& scene) { return fitted_camera(scene.bounds(), {-0.6, 0.5, -0.62}); }

std::vector<std::pair<std::string, TransferFunction>> transfer_functions() {
  TransferFunction random;
  std::mt19937_64 generator(3);
  auto uniform = [&] { return static_cast<float>(generator() >> 40) * 0x1p-24f; };
  for (int i = 0; i < 64; ++i)
    random.knots.push_back({6 * (static_cast<float>(i) + 0.9f * uniform()) / 64,
                            {4 * uniform(), {uniform(), uniform(), uniform()}}});
  return {
      {"uniform", {{{0, {2, {1, 0.5f, 0.2f}}}}}},
      {"ramp", {{{0, {0, {0, 0, 1}}}, {6, {3, {1, 0, 0}}}}}},
      {"steps",
       {{{1, {0, {0, 0, 1}}},
         {1, {5, {0, 1, 0}}},
         {2, {5, {0, 1, 0}}},
         {2, {0.5f, {1, 1, 1}}},
         {4, {0, {1, 0, 0}}}}}},
      {"spike", {{{2, {0, {1, 1, 1}}}, {2.01f, {300, {1, 0.8f, 0}}}, {2.02f, {0, {1, 1, 1}}}}}},
      {"random", random},
      {"opaque at once",
       {{{0, {1e8f, {0.2f, 0.4f, 1}}},
         {3, {1e8f, {1, 0.5f, 0}}},
         {3.5f, {0.1f, {1, 1, 1}}},
         {6, {1e8f, {0, 1, 0}}}}}},
      {"nearly opaque", {{{0, {1e4f, {0.2f, 0.4f, 1}}}, {6, {1e6f, {1, 0.5f, 0}}}}}},
      {"nearly transparent", {{{0, {1e-5f, {0.2f, 0.4f, 1}}}, {6, {1e-6f, {1, 0.5f, 0}}}}}},
  };
}

class EachInstructionSet : public testing::Test {
 protected:
  template <class Body>
  void for_each(const Body& body) {
    for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) {
      limit_packet_instruction_sets(all & -all);
      SCOPED_TRACE(packet_instruction_set());
      body();
    }
    limit_packet_instruction_sets(0);
  }
};

// Meshes that packets walk.
class Packets : public EachInstructionSet, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(Each, Packets,
                         testing::Values("box-tetrahedra", "box-hexahedra", "twisted", "box-wedges",
                                         "box-mixed", "box-polyhedra", "box-rectilinear"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(Packets, CompositeAsTheTwinDoesForEveryTransferFunction) {
  Scene scene(generate(GetParam(), {9, 0.2, 2}), {{"linear", {}}});
  for (const auto& [name, transfer_function] : transfer_functions()) {
    SCOPED_TRACE(name);
    scene.set_transfer_function(transfer_function);
    // The spike's extinction changes by 30,000 per unit of the scalar, whose values on faces are
    // floats near 2, both in packets and in the twin: rounding them by 2.4e-7 changes extinction by
    // 7e-3 over the 5e-3 of path inside of the spike.
    const double bound = name == "spike" ? 7e-3 * 5e-3 : kBound;
    for_each([&] { EXPECT_LE(worst_difference(scene, oblique(scene)), bound); });
  }
}

TEST_P(Packets, EndARayWhereItIsOpaque) {
  Scene scene(generate(GetParam(), {9, 0.2, 2}), {{"linear", {}}});
  scene.set_transfer_function({{{0, {20, {1, 0.5f, 0.2f}}}}});
  for_each([&] { EXPECT_LE(worst_difference(scene, oblique(scene), 1e-3), 2e-3); });
}

TEST_P(Packets, LeaveCamerasInsideToTheTwin) {
  Scene scene(generate(GetParam(), {6, 0.2, 2}));
  Camera camera;
  camera.position = {0.4, 0.5, 0.6};
  camera.focal_point = {1, 0.6, 0.5};
  camera.view_angle = 100;
  EXPECT_EQ(worst_difference(scene, camera, 0, false), 0);
}

// Rays of one axis wait while those of another are walked, whole tiles of them.
TEST_P(Packets, TakeRaysOfAllAxesInOnePicture) {
  Scene scene(generate(GetParam(), {5, 0.2, 2}), {{"linear", {}}});
  scene.set_transfer_function({{{0, {0, {0, 0, 1}}}, {6, {3, {1, 0, 0}}}}});
  Camera camera = fitted_camera(scene.bounds(), {-1, -1, -1});
  for (std::size_t a = 0; a < 3; ++a)
    camera.position[a] += 0.6 * (camera.focal_point[a] - camera.position[a]);
  camera.view_angle = 80;
  EXPECT_LE(worst_difference(scene, camera, 0, true, 161, 143), kBound);
}

TEST_P(Packets, TakeCellData) {
  Mesh mesh = generate(GetParam(), {9, 0.2, 2});
  std::vector<float> values;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    values.push_back(static_cast<float>(c * 7919 % 1000));
  mesh.fields.push_back({"numbers", Association::cell, 1, Array::own(std::move(values))});
  Scene scene(mesh, {{"numbers", {}}});
  for_each([&] { EXPECT_LE(worst_difference(scene, oblique(scene)), kBound); });
}

TEST_P(Packets, EnterAgainWhereTheMeshHasGaps) {
  const Scene scene(slabs(GetParam()), {{"linear", {}}});
  Camera camera = fitted_camera(scene.bounds(), {-1, 0.1, -0.07});
  RenderSettings settings;
  settings.width = settings.height = 32;
  settings.early_termination = 0;
  const RenderStatistics statistics = render(scene, camera, settings).statistics;
  EXPECT_GT(statistics.entries, 3 * statistics.rays_hit);
  // Hidden cells of a rectilinear grid are left to the twin.
  if (std::string(scene.form()) == "rectilinear grid") {
    for (const std::string& line : statistics.plan)
      EXPECT_EQ(line.find("packets"), std::string::npos) << line;
    return;
  }
  for_each([&] { EXPECT_LE(worst_difference(scene, camera), kBound); });
}

TEST_P(Packets, SeeThroughWhatIsNotANumber) {
  Mesh mesh = generate(GetParam(), {6, 0.2, 2});
  std::vector<float> values;
  const std::size_t row = mesh.is_rectilinear() ? mesh.axes[0].size() : 1;
  for (std::size_t i = 0; i < mesh.point_count(); ++i) {
    const float x = mesh.is_rectilinear() ? static_cast<float>(mesh.axes[0].at<double>(i % row))
                                          : mesh.points.at<float>(3 * i);
    values.push_back(i % 7 == 0    ? std::numeric_limits<float>::quiet_NaN()
                     : i % 31 == 0 ? std::numeric_limits<float>::infinity()
                                   : x);
  }
  mesh.fields = {{"holes", Association::point, 1, Array::own(std::move(values))}};
  const Scene scene(mesh);
  for_each([&] { EXPECT_LE(worst_difference(scene, oblique(scene)), kBound); });
}

}  // namespace
}  // namespace plume::test
