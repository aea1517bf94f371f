// Several meshes in one picture: apart, touching, one in a hole of another, overlapping.

#include "plume/tests/lib/several_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/mesh/error.h"

namespace plume::test {
namespace {

bool left(const Point& p) { return p[0] < 0.5; }
bool right(const Point& p) { return !left(p); }
bool core(const Point& p) { return std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5) < 0.3; }
bool shell(const Point& p) { return !core(p); }

const char* const kSplitForms[] = {"box-tetrahedra", "box-hexahedra", "box-mixed", "box-wedges"};

// Rays across the cut, along it, and, as their number is odd, in the very plane of its faces.
std::vector<Camera> cut_views(const Bounds& bounds) {
  std::vector<Camera> views{askew(bounds), named_view("+x", bounds), named_view("+z", bounds)};
  for (const char* along : {"+y", "+z"}) {
    views.push_back(named_view(along, bounds));
    views.back().parallel = true;
  }
  return views;
}

Scenes parts_of(const Mesh& mesh, const std::vector<bool (*)(const Point&)>& cuts,
                const Classification& classification, SceneOptions options = {}) {
  options.frame_bounds = Scene(mesh).bounds();
  Scenes parts;
  for (const auto& keep : cuts) parts.add(cells_where(mesh, keep), options, classification);
  return parts;
}

TEST(SeveralScenes, ThatAreOneMeshInTwoPartsAreThatMesh) {
  for (const char* form : kSplitForms)
    for (const double jitter : {0.0, 0.2}) {
      // The cut is at 0.4 or 0.6, which are no floats.
      const Mesh mesh = with(generate(form, {5, jitter, 3}), wavy);
      Scene whole(mesh);
      whole.set_classification(volume_alone());
      for (const auto& cuts : {std::vector{left, right}, {shell, core}}) {
        const Scenes parts = parts_of(mesh, cuts, volume_alone());
        for (const Camera& camera : cut_views(whole.bounds())) {
          SCOPED_TRACE(std::string(form) + " " + std::to_string(jitter));
          const RenderResult one = render(whole, camera, exact(41));
          const RenderResult two = render(parts.pointers(), camera, exact(41));
          EXPECT_LE(worst_difference(one.image, two.image), 2e-6);
          EXPECT_EQ(two.statistics.lost_rays, 0u);
          EXPECT_EQ(two.statistics.rays_overlapping, 0u);
          EXPECT_EQ(two.statistics.rays_hit, one.statistics.rays_hit);
        }
      }
    }
}

TEST(SeveralScenes, KeepIntervalsAndIsosurfacesWholeAcrossACut) {
  for (const char* form : kSplitForms) {
    SCOPED_TRACE(form);
    const Mesh mesh = with(generate(form, {6, 0.2, 3}), linear);
    SceneOptions options;
    options.keep_gradients = true;
    Scene whole(mesh, options);
    whole.set_classification(everything());
    for (const auto& cuts : {std::vector{left, right}, {shell, core}}) {
      const Scenes parts = parts_of(mesh, cuts, everything(), options);
      RenderSettings settings = exact(40);
      settings.channels = {"depth", "isovalue", "optical_depth", "cell_count", "normal"};
      for (const bool light : {false, true}) {
        if (light) settings.lighting = Lighting{};
        for (const Camera& camera : {askew(whole.bounds()), named_view("+x", whole.bounds())}) {
          const RenderResult one = render(whole, camera, settings);
          const RenderResult two = render(parts.pointers(), camera, settings);
          // Gradients of a linear field are the same in the parts.
          EXPECT_LE(worst_difference(one.image, two.image), kBound);
          EXPECT_EQ(one.statistics.surfaces, two.statistics.surfaces);
          EXPECT_EQ(one.statistics.visits, two.statistics.visits);
          for (std::size_t c = 0; c < one.image.channels.size(); ++c)
            for (std::size_t i = 0; i < 1600; ++i) {
              const float a = one.image.channels[c].values[i], b = two.image.channels[c].values[i];
              if (a == b || (std::isnan(a) && std::isnan(b))) continue;
              ASSERT_NEAR(a, b, kBound * std::max(1.0f, std::abs(a)))
                  << one.image.channels[c].name << ' ' << i;
            }
        }
      }
    }
  }
}

TEST(SeveralScenes, ShowTheSameNumbersInAllModes) {
  const Mesh mesh = with(generate("box-mixed", {5, 0.2, 3}), wavy);
  Scene whole(mesh);
  whole.set_classification(volume_alone());
  const Scenes parts = parts_of(mesh, {shell, core}, volume_alone());
  for (const Mode mode : {Mode::maximum, Mode::minimum, Mode::average, Mode::integral,
                          Mode::optical_depth, Mode::depth, Mode::cell_count})
    for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic}) {
      SCOPED_TRACE(static_cast<int>(mode));
      RenderSettings settings = exact(40);
      settings.mode = mode;
      settings.order = order;
      settings.scalar_tolerance = 1e-6;  // of a range, which is not the same in the parts
      // Packets cut cells that bend too much for so small a tolerance into more linear parts.
      settings.scalar_twin = true;
      settings.channels = {"depth", "optical_depth", "cell_count"};
      const Image one = render(whole, askew(whole.bounds()), settings).image;
      const Image two = render(parts.pointers(), askew(whole.bounds()), settings).image;
      EXPECT_LE(worst_difference(one, two), mode == Mode::depth ? 1e-4 : kBound);
      ASSERT_EQ(one.channels.size(), two.channels.size());
      for (std::size_t c = 0; c < one.channels.size(); ++c)
        for (std::size_t i = 0; i < 1600; ++i) {
          const float a = one.channels[c].values[i], b = two.channels[c].values[i];
          if (a == b || (std::isnan(a) && std::isnan(b))) continue;
          ASSERT_NEAR(a, b, kBound * std::max(1.0f, std::abs(a))) << one.channels[c].name << i;
        }
    }
}

TEST(SeveralScenes, OfHigherOrderAreTheWholeMesh) {
  const Mesh mesh = with(generate("box-hexahedra", {4, 0.2, 3}), wavy);
  Scene whole(mesh);
  whole.set_classification(volume_alone());
  const Scenes parts = parts_of(mesh, {left, right}, volume_alone());
  for (const ScalarOrder order :
       {ScalarOrder::quadratic, ScalarOrder::cubic, ScalarOrder::adaptive}) {
    RenderSettings settings = exact(40);
    settings.order = order;
    settings.scalar_tolerance = 1e-6;  // of a range, which is not the same in the parts
    // Packets cut cells that bend too much for so small a tolerance into more linear parts.
    settings.scalar_twin = true;
    EXPECT_LE(worst_difference(render(whole, askew(whole.bounds()), settings).image,
                               render(parts.pointers(), askew(whole.bounds()), settings).image),
              kBound);
  }
}

// Isosurfaces of two fields in one place, in the order along the ray.
TEST(SeveralScenes, HaveTheirIsosurfacesInOneOrder) {
  Scenes scenes;
  for (const double turned : {0.0, 1.0}) {
    Classification surfaces;
    for (const float value : {0.2f, 0.6f})
      surfaces.isosurfaces.push_back(
          {value, 0.5f, turned == 0 ? std::array{1.0f, 0.0f, 0.0f} : std::array{0.0f, 1.0f, 0.0f}});
    scenes.add(with(generate("box-tetrahedra", {3, 0.2, 3}),
                    [&](const Point& p) { return std::abs(turned - p[0]); }),
               {}, surfaces);
  }
  Camera camera = named_view("+x", scenes.all[0].bounds());
  camera.parallel = true;
  camera.parallel_scale = 0.3;
  RenderSettings settings = exact(16);
  settings.channels = {"depth", "isovalue"};
  const Image image = render(scenes.pointers(), camera, settings).image;
  // At x = 0.2 red, 0.4 green, 0.6 red, 0.8 green.
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      ASSERT_NEAR(image.pixel(x, y)[0], 0.5 + 0.125, 1e-6);
      ASSERT_NEAR(image.pixel(x, y)[1], 0.25 + 0.0625, 1e-6);
      ASSERT_NEAR(image.channels[0].values[0], 0.2 - camera.position[0], 1e-5);
      ASSERT_EQ(image.channels[1].values[0], 0.2f);
    }
}

// Each mesh's field is its own, and so is what it looks like.
TEST(SeveralScenes, MayEachShowIntervalsAVolumeOrSurfaces) {
  const Mesh mesh = with(generate("box-mixed", {5, 0.2, 3}), linear);
  Scene whole(mesh);
  whole.set_classification(everything());
  const Camera camera = askew(whole.bounds());
  // The same, in two scenes: what is no volume shares the ray with a volume of nothing.
  Classification clear = everything(), thin = everything();
  thin.volume.reset();
  clear.intervals.clear();
  clear.isosurfaces.clear();
  for (auto& knot : clear.volume->knots) knot.optics.extinction = 0;
  thin.volume = everything().volume;
  Scenes scenes;
  scenes.add(mesh, {}, thin);
  scenes.add(mesh, {}, clear);
  const Image one = render(whole, camera, exact(40)).image;
  EXPECT_LE(worst_difference(one, render(scenes.pointers(), camera, exact(40)).image), kBound);
  EXPECT_LE(worst_difference(one, render(scenes.reversed(), camera, exact(40)).image), kBound);
}

TEST(SeveralScenes, HaveOpaqueSurfacesBetweenThem) {
  const Mesh mesh = with(generate("box-hexahedra", {5, 0.2, 3}), wavy);
  Scene whole(mesh);
  whole.set_classification(volume_alone());
  Scenes parts = parts_of(mesh, {left, right}, volume_alone());
  OpaqueSurface plate;
  plate.points = {{0.3, -1, -1}, {0.8, 2, -1}, {0.8, 2, 2}, {0.3, -1, 2}};
  plate.triangles = {{0, 1, 2}, {0, 2, 3}};
  whole.add_surface(plate);
  parts.all[1].add_surface(plate);
  for (const Camera& camera : cut_views(whole.bounds()))
    for (const Mode mode : {Mode::volume, Mode::depth}) {
      RenderSettings settings = exact(40);
      settings.mode = mode;
      EXPECT_LE(worst_difference(render(whole, camera, settings).image,
                                 render(parts.pointers(), camera, settings).image),
                mode == Mode::volume ? 2e-6 : 1e-4);
    }
}

TEST(SeveralScenes, OfWhichThereIsOneAreThatScene) {
  Scene scene(generate("box-tetrahedra", {4, 0.2, 3}));
  const Camera camera = askew(scene.bounds());
  EXPECT_EQ(render({&scene}, camera, exact(24)).image.rgba,
            render(scene, camera, exact(24)).image.rgba);
}

std::string refusal(const std::function<void()>& of) {
  try {
    of();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SeveralScenes, AreRefusedWhereTheyOverlapIfSoWished) {
  const Mesh mesh = with(generate("box-tetrahedra", {4, 0.2, 3}), wavy);
  SceneOptions stator, rotor;
  stator.name = "stator.vts";
  rotor.name = "rotor.vtu";
  Scenes scenes;
  scenes.add(mesh, stator, volume_alone());
  scenes.add(moved(mesh, 0.5, {0.75, 0.25, 0.25}), rotor, volume_alone());
  Camera camera = named_view("+x", visible_bounds(scenes.pointers()));
  camera.parallel = true;
  RenderSettings settings = exact(33);
  settings.overlap = Overlap::refuse;
  std::string words = refusal([&] { render(scenes.pointers(), camera, settings); });
  EXPECT_NE(words.find("mesh 'stator.vts' and mesh 'rotor.vtu' overlap"), std::string::npos)
      << words;
  EXPECT_NE(words.find("--overlap"), std::string::npos) << words;
  // The same pixel, whatever thread comes first.
  settings.threads = 1;
  EXPECT_EQ(refusal([&] { render(scenes.pointers(), camera, settings); }), words);
  // What touches does not overlap, be it in a frame of its own.
  Scenes parts;
  for (const auto& keep : {shell, core}) parts.add(cells_where(mesh, keep), {}, volume_alone());
  for (const Camera& view : cut_views(parts.all[0].bounds()))
    EXPECT_EQ(refusal([&] { render(parts.pointers(), view, settings); }), "no error");
}

TEST(SeveralScenes, SayWhatTheyHaveNoAnswerTo) {
  Scene one(with(generate("box-tetrahedra", {3, 0.2, 3}), wavy));
  SceneOptions radius;
  radius.field.name = "cell_radius";
  Scene other(generate("box-hexahedra", {3, 0.2, 3}), radius);
  const Camera camera = askew(one.bounds());
  auto refused = [&](auto&& change) {
    RenderSettings settings = exact(8);
    change(settings);
    return refusal([&] { render({&one, &other}, camera, settings); });
  };
  using S = RenderSettings;
  EXPECT_EQ(refused([](S&) {}), "no error");
  for (const auto& [words, in] : {
           std::pair{"a tolerance", refused([](S& s) { s.tolerance = Tolerance{}; })},
           {"an integrator other",
            refused([](S& s) { s.integrator.kind = IntegratorKind::midpoint; })},
           {"linear form", refused([](S& s) { s.interval_form = IntervalForm::linear; })},
           {"from tables", refused([](S& s) { s.interval_way = IntervalWay::table; })},
           {"cell_id", refused([](S& s) { s.channels = {"cell_id"}; })},
           {"'value' and mesh 2 shows 'cell_radius'",
            refused([](S& s) { s.mode = Mode::maximum; })},
           {"mode integral", refused([](S& s) { s.mode = Mode::integral; })},
           {"isovalue", refused([](S& s) { s.channels = {"isovalue"}; })},
           {"pixels", refused([](S& s) { s.width = 0; })},
       })
    EXPECT_NE(in.find(words), std::string::npos) << words << ": " << in;
  EXPECT_EQ(refused([](S& s) { s.mode = Mode::optical_depth; }), "no error");
  Scene same(with(generate("box-tetrahedra", {3, 0.2, 3}), wavy));
  same.set_transfer_function({{{0, {1, {1, 1, 1}}}}});
  RenderSettings settings = exact(8);
  settings.mode = Mode::average;
  EXPECT_NE(refusal([&] {
              render({&one, &same}, camera, settings);
            }).find("transfer functions"),
            std::string::npos);
  SceneOptions framed;
  framed.frame_bounds = Bounds{{0, 0, 0}, {0.5, 1, 1}};
  EXPECT_NE(refusal([&] {
              Scene(generate("box-tetrahedra", {3, 0.2, 3}), framed);
            }).find("must contain the mesh"),
            std::string::npos);
  EXPECT_NE(refusal([&] { render(std::vector<const Scene*>{}, camera); }).find("no scene"),
            std::string::npos);
}

}  // namespace
}  // namespace plume::test
