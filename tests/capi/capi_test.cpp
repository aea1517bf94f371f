// The C interface against the library that it is made of: the same pictures, and errors that stay
// on their side.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "plume/capi/plume_c.h"
#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"

namespace plume::test {
namespace {

plume_array array_of(const Array& array) {
  constexpr plume_type kTypes[] = {PLUME_UINT8, PLUME_INT32, PLUME_INT64, PLUME_FLOAT32,
                                   PLUME_FLOAT64};
  return {array.data(), array.size(), kTypes[static_cast<std::size_t>(array.type())]};
}

// The same mesh through the C interface.
plume_mesh* c_mesh(const Mesh& mesh) {
  plume_mesh* result = nullptr;
  plume_status status;
  if (mesh.is_rectilinear())
    status = plume_mesh_of_axes(array_of(mesh.axes[0]), array_of(mesh.axes[1]),
                                array_of(mesh.axes[2]), &result);
  else if (mesh.is_grid())
    status = plume_mesh_of_grid(mesh.dimensions[0], mesh.dimensions[1], mesh.dimensions[2],
                                array_of(mesh.points), &result);
  else
    status = plume_mesh_of_cells(array_of(mesh.points), array_of(mesh.cells.types),
                                 array_of(mesh.cells.offsets), array_of(mesh.cells.connectivity),
                                 &result);
  EXPECT_EQ(status, PLUME_OK) << plume_last_error();
  if (!mesh.cells.polyhedron_faces.empty()) {
    status = plume_mesh_set_polyhedra(result, array_of(mesh.cells.polyhedron_faces),
                                      array_of(mesh.cells.polyhedron_locations));
    EXPECT_EQ(status, PLUME_OK);
  }
  for (const Field& field : mesh.fields)
    EXPECT_EQ(
        plume_mesh_add_field(result, field.name.c_str(),
                             field.association == Association::point ? PLUME_POINT : PLUME_CELL,
                             field.components, array_of(field.values)),
        PLUME_OK);
  return result;
}

constexpr int kWidth = 40, kHeight = 30;
constexpr std::size_t kPixels = kWidth * kHeight;

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(CInterface, GivesThePicturesOfTheLibrary) {
  for (const char* name :
       {"box-tetrahedra", "box-mixed", "box-polyhedra", "twisted", "box-rectilinear"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = generate(name, {5, 0.2, 1});
    plume_mesh* c = c_mesh(mesh);
    plume_scene* c_scene = nullptr;
    const unsigned flags = PLUME_KEEP_FIELD_ORDER | PLUME_KEEP_GRADIENTS;
    ASSERT_EQ(plume_scene_create(c, "radius", flags, &c_scene), PLUME_OK) << plume_last_error();
    SceneOptions options;
    options.field.name = "radius";
    options.keep_gradients = true;
    Scene scene(mesh, options);

    plume_camera camera;
    ASSERT_EQ(plume_camera_view(c_scene, "iso", 4.0 / 3, &camera), PLUME_OK);
    RenderSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    const Camera ours = named_view("iso", scene.bounds(), 4.0 / 3);
    std::vector<float> rgba(4 * kPixels), depth(kPixels);
    ASSERT_EQ(plume_render(c_scene, &camera, nullptr, kWidth, kHeight, rgba.data()), PLUME_OK);
    EXPECT_TRUE(same_bits(rgba, render(scene, ours, settings).image.rgba));

    // All that can be set at once.
    plume_settings* set = nullptr;
    ASSERT_EQ(plume_settings_create(&set), PLUME_OK);
    const double point[] = {0.3, 0, 0}, normal[] = {1, 0, 0};
    const float surface[] = {0.4f, 0.7f, 1, 0.5f, 0};
    EXPECT_EQ(plume_settings_set_order(set, 3), PLUME_OK);
    EXPECT_EQ(plume_settings_set_threads(set, 1), PLUME_OK);
    EXPECT_EQ(plume_settings_set_early_termination(set, 0), PLUME_OK);
    EXPECT_EQ(plume_settings_set_headlight(set, 1), PLUME_OK);
    EXPECT_EQ(plume_settings_add_clip_plane(set, point, normal), PLUME_OK);
    EXPECT_EQ(plume_settings_add_channel(set, "depth", depth.data()), PLUME_OK);
    EXPECT_EQ(plume_scene_set_color_map(c_scene, "viridis", 0.1, 0.8, 0.5, 2), PLUME_OK);
    EXPECT_EQ(plume_scene_set_isosurfaces(c_scene, 1, surface, 1), PLUME_OK);
    ASSERT_EQ(plume_render(c_scene, &camera, set, kWidth, kHeight, rgba.data()), PLUME_OK)
        << plume_last_error();
    settings.order = ScalarOrder::cubic;
    settings.early_termination = 0;
    settings.lighting.emplace();
    settings.clip_planes = {{{0.3, 0, 0}, {1, 0, 0}}};
    settings.channels = {"depth"};
    scene.set_transfer_function(
        to_transfer_function(rescaled(*preset("viridis"), 0.1, 0.8), 0.5, 2));
    Classification classification = scene.classification();
    classification.isosurfaces = {{0.4f, 0.7f, {1, 0.5f, 0}}};
    scene.set_classification(classification);
    const Image image = render(scene, ours, settings).image;
    EXPECT_TRUE(same_bits(rgba, image.rgba));
    EXPECT_TRUE(same_bits(depth, image.channel("depth")->values));

    // Another field, another mode, its channel.
    // To a tolerance, whichever method that takes.
    EXPECT_EQ(plume_settings_set_tolerance(set, 1e-3), PLUME_OK);
    ASSERT_EQ(plume_render(c_scene, &camera, set, kWidth, kHeight, rgba.data()), PLUME_OK);
    settings.tolerance.emplace().max_error = 1e-3;
    EXPECT_TRUE(same_bits(rgba, render(scene, ours, settings).image.rgba));

    ASSERT_EQ(plume_scene_set_field(c_scene, c, "waves"), PLUME_OK) << plume_last_error();
    plume_settings_free(set);
    ASSERT_EQ(plume_settings_create(&set), PLUME_OK);
    std::vector<float> integral(kPixels);
    EXPECT_EQ(plume_settings_set_mode(set, PLUME_INTEGRAL), PLUME_OK);
    EXPECT_EQ(plume_settings_add_channel(set, "integral", integral.data()), PLUME_OK);
    ASSERT_EQ(plume_render(c_scene, &camera, set, kWidth, kHeight, rgba.data()), PLUME_OK);
    const Scene waves(mesh, {{"waves", {}}});
    float range[2];
    double bounds[6];
    EXPECT_EQ(plume_scene_range(c_scene, range), PLUME_OK);
    EXPECT_EQ(range[0], waves.field().low);
    EXPECT_EQ(range[1], waves.field().high);
    EXPECT_EQ(plume_scene_bounds(c_scene, bounds), PLUME_OK);
    EXPECT_EQ(bounds[2], waves.bounds().low[1]);
    EXPECT_EQ(bounds[5], waves.bounds().high[2]);
    RenderSettings radiograph;
    radiograph.width = kWidth;
    radiograph.height = kHeight;
    radiograph.mode = Mode::integral;
    EXPECT_TRUE(
        same_bits(integral, render(waves, ours, radiograph).image.channel("integral")->values));
    plume_settings_free(set);
    plume_scene_free(c_scene);
    plume_mesh_free(c);
  }
}

class CErrors : public testing::Test {
 protected:
  CErrors() : mesh_(generate("box-tetrahedra", {3, 0.1, 1})), c_(c_mesh(mesh_)) {
    EXPECT_EQ(plume_scene_create(c_, nullptr, PLUME_DEFAULT, &scene_), PLUME_OK);
    EXPECT_EQ(plume_camera_view(scene_, "+x", 1, &camera_), PLUME_OK);
    EXPECT_EQ(plume_settings_create(&settings_), PLUME_OK);
  }
  ~CErrors() override {
    plume_settings_free(settings_);
    plume_scene_free(scene_);
    plume_mesh_free(c_);
  }
  static void expect_refused(plume_status status, const std::string& message) {
    EXPECT_EQ(status, PLUME_BAD_INPUT);
    EXPECT_NE(std::string(plume_last_error()).find(message), std::string::npos)
        << plume_last_error() << "\nwhere this was expected: " << message;
  }

  Mesh mesh_;
  plume_mesh* c_;
  plume_scene* scene_ = nullptr;
  plume_camera camera_;
  plume_settings* settings_ = nullptr;
  std::vector<float> rgba_ = std::vector<float>(4 * 16 * 16, -1);
};

TEST_F(CErrors, AreWordsAndStatus) {
  plume_scene* scene = nullptr;
  expect_refused(plume_scene_create(c_, "nothing", 0, &scene), "no field 'nothing'; there are: ");
  expect_refused(plume_scene_create(c_, nullptr, 64, &scene), "64 is unknown");
  expect_refused(plume_scene_create(nullptr, nullptr, 0, &scene), "mesh is NULL");
  expect_refused(plume_scene_create(c_, nullptr, 0, nullptr), "scene is NULL");
  EXPECT_EQ(scene, nullptr);
  expect_refused(plume_scene_set_field(scene_, c_, nullptr), "keep_field_order");
  expect_refused(plume_scene_set_color_map(scene_, "beige", 0, 1, 0, 1), "no colour map 'beige'");
  expect_refused(plume_scene_set_color_map(scene_, "turbo", 1, 1, 0, 1), "from 1 to 1");
  expect_refused(plume_scene_set_color_map(scene_, nullptr, 0, 0, -2, 1), "distance of -2");
  const float falling[] = {1, 1, 1, 1, 1, 0, 1, 1, 1, 1};
  expect_refused(plume_scene_set_transfer_function(scene_, 2, falling), "transfer function");
  const float opaque[] = {0.5f, 2, 1, 1, 1};
  expect_refused(plume_scene_set_isosurfaces(scene_, 1, opaque, 0), "opacity");
  expect_refused(plume_settings_set_mode(settings_, static_cast<plume_mode>(9)), "number 9");
  expect_refused(plume_settings_set_order(settings_, 4), "order 4");
  EXPECT_EQ(plume_settings_set_tolerance(settings_, 1.5), PLUME_OK);
  expect_refused(plume_render(scene_, &camera_, settings_, 16, 16, rgba_.data()), "1.5");
  expect_refused(plume_settings_set_order(nullptr, 1),
                 "plume_settings_set_order: settings is NULL");
  expect_refused(plume_render(scene_, &camera_, nullptr, 0, 16, rgba_.data()), "0x16");
  expect_refused(plume_render(scene_, &camera_, nullptr, 16, 16, nullptr), "rgba is NULL");
  expect_refused(plume_camera_view(scene_, "sideways", 1, &camera_), "sideways");
  camera_.view_angle = 200;
  expect_refused(plume_render(scene_, &camera_, nullptr, 16, 16, rgba_.data()), "200");
  EXPECT_EQ(rgba_, std::vector<float>(4 * 16 * 16, -1)) << "untouched";
  EXPECT_STREQ(plume_version(), version());
}

TEST_F(CErrors, OfArraysNameThem) {
  plume_mesh* mesh = nullptr;
  const plume_array none{nullptr, 0, PLUME_INT32};
  expect_refused(plume_mesh_of_cells({nullptr, 12, PLUME_FLOAT32}, none, none, none, &mesh),
                 "points: 12 numbers at NULL");
  expect_refused(
      plume_mesh_of_cells(none, none, none, {rgba_.data(), 1, static_cast<plume_type>(7)}, &mesh),
      "connectivity: no type has the number 7");
  expect_refused(plume_mesh_of_grid(1, 3, 3, none, &mesh), "1 x 3 x 3");
  expect_refused(plume_mesh_of_axes(none, none, none, &mesh), "0 coordinates");
  EXPECT_EQ(mesh, nullptr);
  expect_refused(plume_mesh_add_field(c_, nullptr, PLUME_POINT, 1, none), "name is NULL");
  expect_refused(plume_mesh_add_field(c_, "a", PLUME_POINT, 0, none), "'a' of 0 components");
  // Of what is in the arrays, the library speaks.
  const std::int32_t ids[] = {0, 1, 2, 999};
  const std::uint8_t type = 10;
  ASSERT_EQ(plume_mesh_of_cells(array_of(mesh_.points), {&type, 1, PLUME_UINT8}, none,
                                {ids, 4, PLUME_INT32}, &mesh),
            PLUME_OK);
  ASSERT_EQ(plume_mesh_add_field(mesh, "f", PLUME_POINT, 1, array_of(mesh_.fields[0].values)),
            PLUME_OK);
  plume_scene* scene = nullptr;
  expect_refused(plume_scene_create(mesh, nullptr, 0, &scene), "999");
  plume_mesh_free(mesh);
}

TEST_F(CErrors, AreOfTheThreadThatMadeThem) {
  expect_refused(plume_settings_set_order(settings_, 7), "order 7");
  std::thread([&] {
    EXPECT_STREQ(plume_last_error(), "");
    expect_refused(plume_settings_set_order(settings_, 8), "order 8");
  }).join();
  EXPECT_NE(std::string(plume_last_error()).find("order 7"), std::string::npos);
}

TEST_F(CErrors, CancellingIsOne) {
  int calls = 0;
  auto stop = [](void* user, double share) {
    EXPECT_GT(share, 0);
    ++*static_cast<int*>(user);
    return 0;
  };
  ASSERT_EQ(plume_settings_set_progress(settings_, stop, &calls), PLUME_OK);
  std::vector<float> large(4 * 256 * 256);
  EXPECT_EQ(plume_render(scene_, &camera_, settings_, 256, 256, large.data()), PLUME_CANCELLED);
  EXPECT_EQ(calls, 1);
}

TEST_F(CErrors, NothingIsFreed) {
  plume_mesh_free(nullptr);
  plume_scene_free(nullptr);
  plume_settings_free(nullptr);
}

TEST_F(CErrors, TraceStopsWhereItIsTold) {
  struct Seen {
    int segments = 0;
    double length = 0;
  } all, first;
  const double origin[] = {-1, 0.41, 0.37}, direction[] = {1, 0, 0};
  auto add = [](void* user, const plume_segment* segment) {
    auto& seen = *static_cast<Seen*>(user);
    ++seen.segments;
    seen.length += segment->t_out - segment->t_in;
    return 1;
  };
  auto one = [](void* user, const plume_segment*) {
    ++static_cast<Seen*>(user)->segments;
    return 0;
  };
  EXPECT_EQ(plume_trace(scene_, origin, direction, add, &all), PLUME_OK);
  EXPECT_NEAR(all.length, 1, 1e-6);
  EXPECT_GT(all.segments, 3);
  EXPECT_EQ(plume_trace(scene_, origin, direction, one, &first), PLUME_OK);
  EXPECT_EQ(first.segments, 1);
  expect_refused(plume_trace(scene_, origin, direction, nullptr, &first), "visit is NULL");
}

}  // namespace
}  // namespace plume::test
