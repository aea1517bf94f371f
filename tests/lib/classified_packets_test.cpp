// Volume, intervals and isosurfaces by packets of rays, against the scalar twin.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "hwy/targets.h"
#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"
#include "plume/tests/lib/interval_scenes.h"
#include "plume/tests/preint/classified_rays.h"
#include "plume/traverse/packets.h"

namespace plume::test {
namespace {

// From 0 to 6, with turns along each ray.
double waves(const Point& p) {
  return 3 + 3 * std::sin(7 * p[0] + 2 * p[1]) * std::cos(5 * p[1] - 6 * p[2]);
}

RenderSettings settings_of(int width, double early_termination = 0) {
  RenderSettings settings;
  settings.width = width;
  settings.height = 2 * width / 3;
  settings.early_termination = early_termination;
  return settings;
}

float most_opaque(const Image& image) {
  float most = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) most = std::max(most, image.rgba[i]);
  return most;
}

// Packets against the twin: the worst difference; what is counted must be the same.
double off_twin(const Scene& scene, const Camera& camera, RenderSettings settings) {
  settings.scalar_twin = false;
  const RenderResult packets = render(scene, camera, settings);
  settings.scalar_twin = true;
  const RenderResult twin = render(scene, camera, settings);
  // Isosurfaces alone, of tetrahedra, are not walked to (hierarchy_test.cpp).
  if (packets.statistics.rays_searched > 0) return worst_difference(packets.image, twin.image);
  EXPECT_TRUE(has(packets.statistics.plan, "rays: in packets"));
  EXPECT_TRUE(has(twin.statistics.plan, "rays: one by one"));
  EXPECT_GT(packets.statistics.rays_in_packets, 0u);
  EXPECT_EQ(packets.statistics.rays_hit, twin.statistics.rays_hit);
  // A ray that nothing can change any more ends a little earlier or later.
  if (settings.early_termination == 0 && most_opaque(twin.image) < 0.9999f) {
    EXPECT_EQ(packets.statistics.surfaces, twin.statistics.surfaces);
    EXPECT_EQ(packets.statistics.visits, twin.statistics.visits);
  }
  return worst_difference(packets.image, twin.image);
}

template <class Body>
void for_each_instruction_set(const Body& body) {
  for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) {
    limit_packet_instruction_sets(all & -all);
    SCOPED_TRACE(packet_instruction_set());
    body();
  }
  limit_packet_instruction_sets(0);
}

class ClassifiedPackets : public testing::TestWithParam<const char*> {
 protected:
  static Mesh mesh(const Function& of, int size = 7) {
    return with(generate(GetParam(), {size, 0.2, 4}), of);
  }
};
INSTANTIATE_TEST_SUITE_P(Each, ClassifiedPackets,
                         testing::Values("box-tetrahedra", "box-hexahedra", "twisted", "box-wedges",
                                         "box-mixed", "box-polyhedra", "box-rectilinear",
                                         "two-blocks"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(ClassifiedPackets, ShowWhatTheTwinShows) {
  for (const Function& field : {Function(linear), Function(waves)}) {
    Scene scene(mesh(field));
    scene.set_classification(everything());
    for_each_instruction_set(
        [&] { EXPECT_LE(off_twin(scene, askew(scene.bounds()), settings_of(48)), kBound); });
  }
}

// Also tables of more pieces than are permuted, and each part alone.
TEST_P(ClassifiedPackets, ShowAnyClassificationAsTheTwinDoes) {
  auto sixth = [](const Point& p) { return static_cast<float>(waves(p)) / 6; };
  Scene scene(mesh(sixth, 5));
  const Camera camera = askew(scene.bounds());
  std::mt19937_64 random(7);
  double worst = 0;
  for (int i = 0; i < 30; ++i) {
    Classification classification = tests::random_classification(random);
    // Scalars on faces are off by some 2e-7 in single precision. Where a ray turns back inside of
    // an interval of width 0.02 and of an extinction of 4, that is 4e-5 of optical depth at the
    // worst, and seldom more than a tenth of it; narrower ones would need a wider bound.
    std::erase_if(classification.intervals,
                  [](const auto& interval) { return interval.high - interval.low < 0.02f; });
    if (i % 5 == 0) classification.volume.reset();
    if (i % 7 == 0) classification.intervals.clear();
    if (i % 6 == 0 && !classification.intervals.empty()) classification.isosurfaces.clear();
    ASSERT_EQ(classification.problem(), std::nullopt);
    scene.set_classification(classification);
    if (scene.classification().is_plain_volume()) continue;
    const double off = off_twin(scene, camera, settings_of(24));
    EXPECT_LE(off, kBound) << i;
    worst = std::max(worst, off);
  }
  RecordProperty("worst", std::to_string(worst * 1e6) + "e-6");
}

TEST_P(ClassifiedPackets, AreLitAsTheTwinIs) {
  SceneOptions options;
  options.keep_gradients = true;
  Scene scene(mesh(waves), options);
  scene.set_classification(everything());
  RenderSettings settings = settings_of(36);
  settings.lighting = Lighting{};
  settings.lighting->lights = {{}, {{{1, 2, 1}}, 0.5}};
  for_each_instruction_set(
      [&] { EXPECT_LE(off_twin(scene, askew(scene.bounds()), settings), kBound); });
  settings.lighting->intervals = false;
  EXPECT_LE(off_twin(scene, askew(scene.bounds()), settings), kBound);
}

TEST_P(ClassifiedPackets, EndARayWhereItIsOpaque) {
  Scene scene(mesh(waves));
  Classification opaque = everything();
  for (auto& surface : opaque.isosurfaces) surface.opacity = 1;
  scene.set_classification(opaque);
  EXPECT_LE(off_twin(scene, askew(scene.bounds()), settings_of(48, 1e-3)), 2e-3);
  EXPECT_LE(off_twin(scene, askew(scene.bounds()), settings_of(48, 0)), kBound);
}

TEST_P(ClassifiedPackets, LetCellsThatAreConstantJump) {
  Mesh cells = generate(GetParam(), {7, 0.2, 4});
  std::vector<float> values;
  for (std::size_t c = 0; c < cells.cell_count(); ++c)
    values.push_back(static_cast<float>(c * 7919 % 13) * 0.5f);  // also at bounds
  values[values.size() / 2] = std::numeric_limits<float>::quiet_NaN();
  cells.fields = {{"numbers", Association::cell, 1, Array::own(std::move(values))}};
  cells.active_field = "numbers";
  Scene scene(cells);
  scene.set_classification(everything());
  for_each_instruction_set(
      [&] { EXPECT_LE(off_twin(scene, askew(scene.bounds()), settings_of(36)), kBound); });
}

TEST_P(ClassifiedPackets, BeginAnewBehindWhatIsNotANumber) {
  auto holes = [](const Point& p) {
    return std::fmod(17 * p[0] + 31 * p[1] + 23 * p[2], 1.0) < 0.1
               ? std::numeric_limits<double>::quiet_NaN()
               : waves(p);
  };
  Scene scene(mesh(holes));
  scene.set_classification(everything());
  for_each_instruction_set(
      [&] { EXPECT_LE(off_twin(scene, askew(scene.bounds()), settings_of(36)), kBound); });
}

// Values of vertices, and regions where the field is constant at them.
TEST_P(ClassifiedPackets, HaveNoSpecklesAtTheValuesOfVertices) {
  Scene scene(with(generate(GetParam(), {6, 0, 1}),
                   [](const Point& p) { return std::floor(8 * p[2] * p[2]) * 0.5; }));
  Classification surfaces;
  surfaces.intervals = {{0.5f, 1, even_profile(0.3f, {1, 1, 1})},
                        {1, 1.5f, even_profile(0.6f, {1, 0, 1})}};
  surfaces.isosurfaces = {{1.5f, 0.5f, {1, 0, 0}}, {2, 0.25f, {0, 1, 0}}, {3, 0.4f, {0, 0, 1}}};
  scene.set_classification(surfaces);
  for (const Point& view : {Point{0.05, 0.03, -1}, Point{0.02, 0.04, 1}})
    EXPECT_LE(off_twin(scene, fitted_camera(scene.bounds(), view), settings_of(60)), kBound);
}

TEST(ClassifiedPacketsOnly, WhereTheyServe) {
  Scene scene(with(generate("box-tetrahedra", {3, 0.2, 4}), linear));
  scene.set_classification(everything());
  auto one_by_one = [&](const RenderSettings& settings) {
    return has(render(scene, askew(scene.bounds()), settings).statistics.plan, "rays: one by one");
  };
  EXPECT_FALSE(one_by_one(settings_of(8)));
  RenderSettings linear_form = settings_of(8);
  linear_form.interval_form = IntervalForm::linear;
  EXPECT_TRUE(one_by_one(linear_form));
  RenderSettings depth = settings_of(8);
  depth.mode = Mode::depth;
  EXPECT_TRUE(one_by_one(depth));
  Classification narrow = everything();
  narrow.intervals.push_back({0, 1e-35f, even_profile(0.5f, {1, 1, 1})});
  scene.set_classification(narrow);
  EXPECT_TRUE(one_by_one(settings_of(8)));
}

}  // namespace
}  // namespace plume::test
