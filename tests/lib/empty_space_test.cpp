// Pictures that pass over empty space are those that do not, bit for bit.

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"

namespace plume::test {
namespace {

bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

bool says_so(const RenderStatistics& statistics) {
  for (const std::string& line : statistics.plan)
    if (line.starts_with("empty space: ") && line.find("passed over") != std::string::npos)
      return true;
  return false;
}

// Renders both ways; returns how many cells were passed over.
std::uint64_t expect_same(const Scene& scene, const Camera& camera, RenderSettings settings,
                          const std::string& which) {
  const RenderResult passing = render(scene, camera, settings);
  settings.scalar_twin = true;
  const RenderResult walking = render(scene, camera, settings);
  EXPECT_TRUE(says_so(passing.statistics)) << which;
  EXPECT_FALSE(says_so(walking.statistics)) << which;
  EXPECT_TRUE(same(passing.image.rgba, walking.image.rgba)) << which;
  EXPECT_EQ(passing.image.channels.size(), walking.image.channels.size()) << which;
  for (std::size_t c = 0; c < walking.image.channels.size(); ++c)
    EXPECT_TRUE(same(passing.image.channels[c].values, walking.image.channels[c].values))
        << which << ", " << walking.image.channels[c].name;
  EXPECT_EQ(passing.statistics.surfaces, walking.statistics.surfaces) << which;
  EXPECT_EQ(passing.statistics.visits, walking.statistics.visits) << which;
  EXPECT_EQ(passing.statistics.rays_hit, walking.statistics.rays_hit) << which;
  return walking.statistics.cells_visited - passing.statistics.cells_visited;
}

RenderSettings small() {
  RenderSettings settings;
  settings.width = 96;
  settings.height = 80;
  return settings;
}

Scene scene_of(const char* field) {
  SceneOptions options;
  options.field.name = field;
  options.keep_gradients = std::string(field) == "waves";
  return Scene(generate("box-rectilinear", {40, 0.3, 3}), options);
}

// Visible around 0.8 of the range, and nowhere else.
TransferFunction narrow(const Scene& scene) {
  const float low = scene.field().low, width = scene.field().high - low;
  TransferFunction function;
  function.knots = {{low + 0.78f * width, {0, {1, 0, 0}}},
                    {low + 0.8f * width, {50, {1, 0.5f, 0}}},
                    {low + 0.82f * width, {0, {0, 0, 1}}}};
  return function;
}

std::vector<Camera> cameras(const Scene& scene) {
  std::vector<Camera> cameras;
  for (const char* view : {"iso", "+x", "-z"}) {
    cameras.push_back(named_view(view, scene.bounds()));
    orbit(cameras.back(), 3, 2);
  }
  cameras.push_back(named_view("-y", scene.bounds()));
  cameras.back().parallel = true;  // along grid lines
  cameras.push_back(named_view("iso", scene.bounds()));
  cameras.back().position = scene.bounds().center();
  cameras.back().focal_point = scene.bounds().high;
  return cameras;
}

TEST(EmptySpace, OfATransferFunctionIsPassedOver) {
  std::uint64_t over = 0;
  for (const char* field : {"waves", "cell_radius"}) {
    Scene scene = scene_of(field);
    scene.set_transfer_function(narrow(scene));
    for (const Camera& camera : cameras(scene))
      for (const Mode mode : {Mode::volume, Mode::depth})
        for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic}) {
          RenderSettings settings = small();
          settings.mode = mode;
          settings.order = order;
          // Without: packets.
          settings.channels = {"depth", "cell_id"};
          over += expect_same(scene, camera, settings, std::string(field));
        }
  }
  EXPECT_GT(over, 0u);
}

TEST(EmptySpace, AroundIsosurfacesAndIntervalsIsPassedOver) {
  std::uint64_t over = 0;
  Scene scene = scene_of("waves");
  auto at = [&](float share) {
    return scene.field().low + share * (scene.field().high - scene.field().low);
  };
  Classification classification;
  classification.isosurfaces = {{at(0.7f), 0.4f, {1, 0, 0}}, {at(0.9f), 1, {0, 1, 0}}};
  for (const bool more : {false, true}) {
    if (more) {
      classification.volume = narrow(scene);
      classification.intervals = {{at(0.1f), at(0.15f), even_profile(0.5f, {0, 0, 1})}};
    }
    scene.set_classification(classification);
    for (const Camera& camera : cameras(scene))
      for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic}) {
        RenderSettings settings = small();
        settings.order = order;
        settings.channels = {"depth", "isovalue", "normal"};
        settings.lighting.emplace();
        over += expect_same(scene, camera, settings, more ? "all" : "surfaces");
        settings.mode = Mode::depth;
        over += expect_same(scene, camera, settings, "depth");
      }
  }
  EXPECT_GT(over, 0u);
}

TEST(EmptySpace, BelowTheGreatestScalarIsPassedOver) {
  std::uint64_t over = 0;
  for (const char* field : {"waves", "cell_radius"}) {
    const Scene scene = scene_of(field);
    for (const Camera& camera : cameras(scene))
      for (const Mode mode : {Mode::maximum, Mode::minimum})
        for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic}) {
          RenderSettings settings = small();
          settings.mode = mode;
          settings.order = order;
          over += expect_same(scene, camera, settings, field);
        }
  }
  EXPECT_GT(over, 0u);
}

// By clip planes, opaque surfaces and limits of depth rays are shorter, and nothing else.
TEST(EmptySpace, IsPassedOverOnCutRays) {
  std::uint64_t over = 0;
  Scene scene = scene_of("waves");
  scene.set_transfer_function(narrow(scene));
  for (const Camera& camera : cameras(scene)) {
    RenderSettings settings = small();
    settings.clip_planes = {{scene.bounds().center(), {1, 2, 3}}};
    over += expect_same(scene, camera, settings, "clipped");
  }
  EXPECT_GT(over, 0u);
}

TEST(EmptySpace, OfANewFieldIsItsOwn) {
  std::uint64_t over = 0;
  const Mesh mesh = generate("box-rectilinear", {40, 0.3, 3});
  SceneOptions options;
  options.field.name = "waves";
  options.keep_field_order = true;
  Scene scene(mesh, options);
  for (const char* field : {"waves", "radius", "waves"}) {
    scene.set_field(mesh, {field, {}});
    RenderSettings settings = small();
    settings.mode = Mode::maximum;
    over += expect_same(scene, named_view("iso", scene.bounds()), settings, field);
  }
  EXPECT_GT(over, 0u);
}

// A table blurs what is empty beside what is not, and that is seen: pictures stay as they are.
TEST(EmptySpace, OfATableIsAsWithoutPassingOver) {
  Scene scene = scene_of("waves");
  const float low = scene.field().low, width = scene.field().high - low;
  TransferFunction peaks;
  peaks.knots = {{low, {0, {1, 0, 0}}},
                 {low + 0.05f * width, {0, {1, 0, 0}}},
                 {low + 0.06f * width, {90, {1, 0.5f, 0}}},
                 {low + 0.07f * width, {0, {0, 0, 1}}},
                 {low + width, {0, {0, 0, 1}}}};
  scene.set_transfer_function(peaks);
  RenderSettings settings = small();
  settings.integrator.kind = IntegratorKind::table;
  settings.integrator.table.scalar_count = 32;
  const Camera camera = named_view("iso", scene.bounds());
  const RenderResult ours = render(scene, camera, settings);
  settings.scalar_twin = true;
  const RenderResult walked = render(scene, camera, settings);
  EXPECT_TRUE(same(ours.image.rgba, walked.image.rgba));
}

// Where nothing may be gained, or the picture may differ, all is walked.
TEST(EmptySpace, IsWalkedThroughWhereItMatters) {
  Scene scene = scene_of("waves");
  const Camera camera = named_view("iso", scene.bounds());
  EXPECT_FALSE(says_so(render(scene, camera, small()).statistics)) << "all is visible";
  scene.set_transfer_function(narrow(scene));
  RenderSettings settings = small();
  settings.channels = {"cell_count"};
  EXPECT_FALSE(says_so(render(scene, camera, settings).statistics));
  settings.channels = {};
  settings.order = ScalarOrder::quadratic;
  EXPECT_FALSE(says_so(render(scene, camera, settings).statistics));
  settings.order = ScalarOrder::linear;
  settings.mode = Mode::integral;
  EXPECT_FALSE(says_so(render(scene, camera, settings).statistics));
}

}  // namespace
}  // namespace plume::test
