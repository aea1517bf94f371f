// Pictures through the hierarchy of cells are those of the walker, bit for bit.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/lib/make_tiles.h"
#include "plume/lib/plume.h"
#include "plume/lib/search_choice.h"
#include "plume/lib/tiles.h"
#include "searched_picture.h"

namespace plume::test {
namespace {

RenderSettings small() {
  RenderSettings settings;
  settings.width = 96;
  settings.height = 80;
  return settings;
}

// Renders both ways and returns the statistics of the one through the hierarchy.
RenderStatistics expect_same(const Scene& scene, const Camera& camera, RenderSettings settings,
                             const std::string& which, bool even_beside_packets = false) {
  if (even_beside_packets && !choose_search(scene, settings, false).search) return {};
  const RenderResult searched =
      even_beside_packets ? search(scene, camera, settings) : render(scene, camera, settings);
  settings.scalar_twin = true;
  const RenderResult walked = render(scene, camera, settings);
  EXPECT_EQ(walked.statistics.rays_searched, 0u) << which;
  EXPECT_TRUE(same(searched.image.rgba, walked.image.rgba)) << which;
  EXPECT_EQ(searched.image.channels.size(), walked.image.channels.size()) << which;
  for (std::size_t c = 0; c < walked.image.channels.size(); ++c)
    EXPECT_TRUE(same(searched.image.channels[c].values, walked.image.channels[c].values))
        << which << ", " << walked.image.channels[c].name;
  EXPECT_EQ(searched.statistics.surfaces, walked.statistics.surfaces) << which;
  EXPECT_EQ(searched.statistics.rays_hit, walked.statistics.rays_hit) << which;
  EXPECT_EQ(searched.statistics.lost_rays, 0u) << which;
  return searched.statistics;
}

Classification surfaces(const std::vector<Isosurface>& list) {
  Classification classification;
  classification.isosurfaces = list;
  return classification;
}

// Values between the least and the greatest.
float at(const Scene& scene, float share) {
  return scene.field().low + share * (scene.field().high - scene.field().low);
}

TEST(HierarchyPictures, AreTheWalkers) {
  SceneOptions lit;
  lit.keep_gradients = true;
  Scene scene(generate("box-tetrahedra", {20, 0.2, 3}), lit);
  const std::vector<Classification> all{
      surfaces({{at(scene, 0.5f), 1, {1, 0.5f, 0.2f}}}),
      surfaces({{at(scene, 0.7f), 0.4f, {1, 1, 1}}}),
      surfaces({{at(scene, 0.3f), 0.3f, {1, 0, 0}}, {at(scene, 0.6f), 1, {0, 0, 1}}}),
      surfaces({{at(scene, 0.3f), 0, {1, 0, 0}}, {at(scene, 0.6f), 0.99999f, {0, 0, 1}}})};
  for (std::size_t i = 0; i < all.size(); ++i) {
    scene.set_classification(all[i]);
    for (const char* view : {"iso", "+x", "-z"}) {
      Camera camera = named_view(view, scene.bounds());
      orbit(camera, 3, 2);
      for (const bool parallel : {false, true}) {
        camera.parallel = parallel;
        RenderSettings settings = small();
        settings.channels = {"depth", "cell_id", "isovalue", "normal"};
        if (i % 2 == 0) settings.lighting.emplace();
        const std::string which = std::string(view) + ", " + std::to_string(i);
        const RenderStatistics statistics = expect_same(scene, camera, settings, which);
        EXPECT_GT(statistics.rays_searched, statistics.rays * 9 / 10) << which;
        settings.mode = Mode::depth;
        expect_same(scene, camera, settings, which + ", depth");
      }
    }
  }
}

// Straight along the grid: rays in faces and along edges.
TEST(HierarchyPictures, AreTheWalkersAlongTheGrid) {
  Scene scene(generate("box-tetrahedra", {16, 0, 3}));
  scene.set_classification(surfaces({{at(scene, 0.5f), 1, {1, 1, 1}}}));
  for (const char* view : {"+x", "-y", "+z", "iso"}) {
    Camera camera = named_view(view, scene.bounds());
    camera.parallel = true;
    expect_same(scene, camera, small(), view);
  }
}

TEST(HierarchyPictures, AreTheWalkersInTangledMeshesAndFromInside) {
  for (const double jitter : {0.5, 3.0}) {
    Scene scene(generate("box-tetrahedra", {10, jitter, 3}));
    scene.set_classification(surfaces({{at(scene, 0.5f), 1, {1, 1, 1}}}));
    expect_same(scene, named_view("iso", scene.bounds()), small(), "tangled");
  }
  Scene scene(generate("ball-tetrahedra", {8, 0.1, 3}));
  scene.set_classification(surfaces({{at(scene, 0.5f), 1, {1, 1, 1}}}));
  Camera inside = named_view("iso", scene.bounds());
  inside.position = scene.bounds().center();
  inside.focal_point = scene.bounds().high;
  expect_same(scene, inside, small(), "inside");
}

TEST(HierarchyPictures, OfTheGreatestAndTheLeastAreTheWalkers) {
  for (const double jitter : {0.0, 0.2, 0.5, 3.0})
    for (const char* name : {"box-tetrahedra", "ball-tetrahedra"}) {
      const Scene scene(generate(name, {10, jitter, 3}));
      for (const char* view : {"iso", "+x"})
        for (const Mode mode : {Mode::maximum, Mode::minimum}) {
          Camera camera = named_view(view, scene.bounds());
          camera.parallel = jitter == 0;
          RenderSettings settings = small();
          settings.mode = mode;
          const RenderStatistics statistics = expect_same(scene, camera, settings, name);
          EXPECT_TRUE(jitter != 0.2 || statistics.rays_searched > statistics.rays / 2) << name;
        }
    }
}

// What is met on the way is in channels, which only a walk fills.
TEST(HierarchyPictures, OfTheGreatestHaveTheChannelsOfTheWalkers) {
  const Scene scene(generate("box-tetrahedra", {10, 0.2, 3}));
  RenderSettings settings = small();
  settings.mode = Mode::maximum;
  settings.channels = {"depth"};
  expect_same(scene, named_view("iso", scene.bounds()), settings, "depth");
}

// Grids and cells of any kind; a further channel keeps packets from what they would do.
TEST(HierarchyPictures, OfOtherCellsAreTheWalkers) {
  struct Case {
    const char* name;
    int size;
    double jitter, least_searched;  // a share of the rays
    bool crooked = false;           // extreme values are then walked to
  };
  for (const Case& c : {Case{"twisted", 10, 0.4, 0.99}, Case{"box-hexahedra", 10, 0.2, 0.99},
                        Case{"box-hexahedra", 8, 3, 0, true}, Case{"box-mixed", 8, 0.2, 0.99},
                        Case{"box-mixed", 6, 2, 0, true}, Case{"box-polyhedra", 5, 0.2, 0.99},
                        Case{"box-wedges", 8, 0.2, 0.99}, Case{"o-grid", 8, 0.2, 0.8, true},
                        Case{"two-blocks", 6, 0.2, 0.3}}) {
    Scene scene(generate(c.name, {c.size, c.jitter, 3}));
    scene.set_classification(
        surfaces({{at(scene, 0.3f), 0.4f, {1, 0, 0}}, {at(scene, 0.6f), 1, {0, 0, 1}}}));
    for (const char* view : {"iso", "+x"})
      for (const Mode mode : {Mode::volume, Mode::depth, Mode::maximum, Mode::minimum}) {
        Camera camera = named_view(view, scene.bounds());
        camera.parallel = mode == Mode::volume;
        RenderSettings settings = small();
        settings.mode = mode;
        const bool extreme = mode == Mode::maximum || mode == Mode::minimum;
        if (mode == Mode::volume) settings.channels = {"depth", "cell_id", "isovalue"};
        const std::string which = std::string(c.name) + ", " + view;
        const RenderStatistics statistics = expect_same(scene, camera, settings, which, extreme);
        if (extreme) {
          EXPECT_EQ(statistics.rays_searched > 0, !c.crooked) << which;
          continue;
        }
        EXPECT_GE(static_cast<double>(statistics.rays_searched),
                  c.least_searched * static_cast<double>(statistics.rays))
            << which;
      }
  }
}

// Of small meshes packets make volume pictures faster.
TEST(HierarchyPictures, OfSmallGridsAreMadeByPackets) {
  Scene scene(generate("box-hexahedra", {10, 0.2, 3}));
  scene.set_classification(surfaces({{at(scene, 0.5f), 1, {1, 1, 1}}}));
  const Camera camera = named_view("iso", scene.bounds());
  RenderSettings settings = small();
  EXPECT_EQ(render(scene, camera, settings).statistics.rays_searched, 0u);
  EXPECT_GT(render(scene, camera, settings).statistics.rays_in_packets, 0u);
  settings.order = ScalarOrder::cubic;
  EXPECT_EQ(render(scene, camera, settings).statistics.rays_searched, 0u);
}

TEST(HierarchyPictures, AnIsovalueChangesWithoutARebuild) {
  Scene scene(generate("box-tetrahedra", {12, 0.2, 3}));
  const Camera camera = named_view("iso", scene.bounds());
  int made = 0;
  for (const float share : {0.5f, 0.3f, 0.8f}) {
    scene.set_classification(surfaces({{at(scene, share), 1, {1, 1, 1}}}));
    made += render(scene, camera, small()).statistics.hierarchy_made ? 1 : 0;
  }
  EXPECT_EQ(made, 1);
}

// A field that has changed is looked for anew: ranges are those of its values.
TEST(HierarchyPictures, OfANewFieldAreTheWalkers) {
  const Mesh mesh = generate("box-tetrahedra", {12, 0.2, 3});
  SceneOptions options;
  options.field.name = "radius";
  options.keep_field_order = true;
  Scene scene(mesh, options);
  const Camera camera = named_view("iso", scene.bounds());
  for (const char* field : {"radius", "waves", "linear"}) {
    scene.set_field(mesh, {field, {}});
    scene.set_classification(surfaces({{at(scene, 0.6f), 1, {1, 1, 1}}}));
    const RenderStatistics statistics = expect_same(scene, camera, small(), field);
    EXPECT_GT(statistics.rays_searched, statistics.rays / 2) << field;
  }
  const Mesh grid = generate("box-hexahedra", {8, 0.2, 3});
  Scene grid_scene(grid, options);
  RenderSettings depth = small();
  depth.mode = Mode::depth;
  for (const char* field : {"radius", "waves"}) {
    grid_scene.set_field(grid, {field, {}});
    grid_scene.set_classification(surfaces({{at(grid_scene, 0.6f), 1, {1, 1, 1}}}));
    EXPECT_GT(expect_same(grid_scene, camera, depth, field).rays_searched, 0u) << field;
  }
}

// Not made, nor used, where something else is to be seen; the plan says why.
TEST(HierarchyPictures, AreMadeWhereOnlyIsosurfacesAreToBeSeen) {
  Scene scene(generate("box-tetrahedra", {8, 0.2, 3}));
  const Camera camera = named_view("iso", scene.bounds());
  auto expect_walked = [&](const RenderSettings& settings, const std::string& why) {
    const RenderStatistics statistics = render(scene, camera, settings).statistics;
    EXPECT_EQ(statistics.rays_searched, 0u) << why;
    EXPECT_FALSE(statistics.hierarchy_made) << why;
    bool said = false;
    for (const std::string& line : statistics.plan)
      said = said || line.find(why) != std::string::npos;
    EXPECT_TRUE(said) << why;
  };
  Classification with_volume = scene.classification();
  with_volume.isosurfaces = {{at(scene, 0.5f), 1, {1, 1, 1}}};
  scene.set_classification(with_volume);
  expect_walked(small(), "all cells may be seen");
  scene.set_classification(surfaces({{at(scene, 0.5f), 1, {1, 1, 1}}}));
  RenderSettings settings = small();
  settings.channels = {"cell_count"};
  expect_walked(settings, "whole rays");
  settings = small();
  settings.clip_planes = planes_of_box(scene.bounds());
  expect_walked(settings, "clip planes");
  settings = small();
  settings.scalar_twin = true;
  expect_walked(settings, "scalar twin");
}

}  // namespace
}  // namespace plume::test
