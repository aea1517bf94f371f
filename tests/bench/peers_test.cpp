// Other renderers get the same rays: what they show comes nearer to the reference as they are given
// more samples or pixels, and what they cannot get wrong agrees at once.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>

#include "plume/datasets/generate.h"
#include "plume/lib/planner.h"
#include "plume/lib/plume.h"
#include "plume/tests/bench/embree_locator.h"
#include "plume/tests/bench/fixed_step.h"
#include "plume/tests/bench/peer.h"
#include "plume/tests/bench/peer_table.h"

namespace plume::bench {
namespace {

TransferFunction gentle(const ScalarField& field) {
  TransferFunction made;
  const Optics optics[] = {{0.2f, {0, 0, 1}}, {1, {0, 1, 0.5f}}, {0.5f, {1, 0.5f, 0}}};
  for (std::size_t i = 0; i < 3; ++i)
    made.knots.push_back(
        {field.low + (field.high - field.low) * 0.5f * static_cast<float>(i), optics[i]});
  return made;
}

struct Shown {
  explicit Shown(const std::string& name, bool parallel = false, bool constant = false) {
    Mesh mesh = generate(name, {5, 0.2, 1});
    if (constant)
      for (Field& field : mesh.fields)
        field.values = Array::own(std::vector<float>(field.values.size(), 1.0f));
    peers = make_peer_scene(mesh, "");
    Scene scene(mesh);
    peers.transfer_function = gentle(scene.field());
    if (constant)
      peers.transfer_function.knots = {{0, {0.8f, {1, 0.5f, 0.25f}}},
                                       {2, {0.8f, {1, 0.5f, 0.25f}}}};
    scene.set_transfer_function(peers.transfer_function);
    peers.camera = named_view("iso", scene.bounds());
    orbit(peers.camera, 3, 2);
    peers.camera.parallel = parallel;
    peers.size = 24;
    RenderSettings settings;
    settings.width = settings.height = peers.size;
    reference = render(scene, peers.camera, reference_settings(settings)).image;
  }
  PictureError error(const PeerWay& way) const {
    way.frame();
    return picture_error(way.picture(), reference);
  }

  PeerScene peers;
  Image reference;
};

// Each way is nearer than the one before, by RMS, and the last within `last` in every channel.
void expect_convergence(const Shown& shown, const std::vector<PeerWay>& ways, double last) {
  ASSERT_GE(ways.size(), 2u);
  PictureError before{1, 1, 0};
  for (const PeerWay& way : ways) {
    const PictureError error = shown.error(way);
    EXPECT_LT(error.rms, before.rms) << way.family << ", " << way.method;
    EXPECT_EQ(error.not_numbers, 0u) << way.method;
    before = error;
  }
  EXPECT_LT(before.largest, last) << ways.back().family;
}

TEST(Peers, samples_converge_to_the_reference) {
  const Shown shown("box-tetrahedra");
  expect_convergence(shown, embree_ways(shown.peers, false), 1e-3);
  expect_convergence(shown, vtk_locator_ways(shown.peers, false), 1e-3);
}

TEST(Peers, samples_of_mixed_cells_converge_to_the_isoparametric_reference) {
  const Shown shown("box-mixed");
  EXPECT_TRUE(shown.peers.cut);
  expect_convergence(shown, vtk_locator_ways(shown.peers, true), 1e-2);
  // Cut into tetrahedra the field is another, so that the error stays; but it is the same picture.
  EXPECT_LT(shown.error(embree_ways(shown.peers, true).back()).rms, 0.02);
}

TEST(Peers, voxels_come_nearer) {
  const Shown shown("box-tetrahedra");
  expect_convergence(shown, voxel_ways(shown.peers, true), 0.05);
}

TEST(Peers, z_sweep_comes_nearer_with_pixels) {
  const Shown shown("box-tetrahedra");
  std::vector<PeerWay> linear = vtk_z_sweep_ways(shown.peers, false);
  std::erase_if(linear, [](const PeerWay& way) { return way.method.find("linear") != 0; });
  ASSERT_EQ(linear.size(), 3u);
  expect_convergence(shown, linear, 0.1);
}

TEST(Peers, ray_cast_has_our_rays) {
  const Shown shown("box-tetrahedra", true);
  const std::vector<PeerWay> ways = vtk_ray_cast_ways(shown.peers);
  EXPECT_LT(shown.error(ways.front()).largest, 1e-4);
}

TEST(Peers, projected_tetrahedra_of_a_constant_field_have_our_pixels) {
#ifdef PLUME_WITH_VTK_OPENGL
  const Shown shown("box-tetrahedra", true, true);
  limit_rasterizer_threads(1);
  const std::vector<PeerWay> ways = vtk_projected_tetrahedra_ways(shown.peers);
  if (ways.empty()) GTEST_SKIP() << "NO OPENGL: projected tetrahedra are NOT tested";
  // Colours are in 8 bits, rounded down; so would half a pixel's shift be ten times as far off.
  EXPECT_LT(shown.error(ways.front()).rms, 4e-3);
  EXPECT_LT(shown.error(ways.front()).largest, 0.02);
#else
  GTEST_SKIP() << "VTK'S OPENGL IS NOT INSTALLED: projected tetrahedra are NOT tested";
#endif
}

TEST(Peers, embree_finds_the_cell_and_nothing_outside) {
  Mesh mesh = generate("box-tetrahedra", {4, 0.2, 1});
  std::vector<float> linear;
  mesh.points.visit([&](auto values) {
    for (std::size_t i = 0; i < values.size(); i += 3)
      linear.push_back(static_cast<float>(1 + 2 * values[i] - 3 * values[i + 1] + values[i + 2]));
  });
  mesh.fields = {{"linear", Association::point, 1, Array::own(std::move(linear))}};
  const PeerScene scene = make_peer_scene(mesh, "linear");
  const EmbreeLocator locator(scene.tetrahedra);
  EmbreeLocator::Sampler sampler(locator);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> anywhere(-0.2, 1.2);
  for (int i = 0; i < 2000; ++i) {
    const std::array<double, 3> p{anywhere(random), anywhere(random), anywhere(random)};
    bool inside = true;
    for (const double x : p) inside = inside && x > 0 && x < 1;
    const float scalar = sampler(p);
    ASSERT_EQ(std::isnan(scalar), !inside) << p[0] << ' ' << p[1] << ' ' << p[2];
    if (inside) {
      ASSERT_NEAR(scalar, 1 + 2 * p[0] - 3 * p[1] + p[2], 2e-6);
    }
  }
}

TEST(Peers, look_ups_are_the_transfer_function) {
  TransferFunction function;
  const float scalars[] = {-1, -0.999f, 0.3f, 0.3f, 0.30001f, 7};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto x = static_cast<float>(i);
    function.knots.push_back({scalars[i], {x, {1 - x / 6, x / 6, 0.5f}}});
  }
  const KnotTable table(function);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> anywhere(-2, 8), near_knots(0.29f, 0.31f);
  for (int i = 0; i < 4000; ++i) {
    const float scalar = i < 6 ? scalars[i] : i % 2 == 0 ? anywhere(random) : near_knots(random);
    const Optics expected = function.at(scalar), found = table.at(scalar);
    ASSERT_NEAR(found.extinction, expected.extinction, 1e-5) << scalar;
    ASSERT_NEAR(found.color[0], expected.color[0], 1e-5) << scalar;
  }
}

TEST(Peers, who_has_taken_the_limit_stands_by) {
  const Image picture = empty_picture(1);
  int slow_frames = 0, quick_frames = 0;
  const PeerWay slow{"a", "slow",
                     [&] {
                       ++slow_frames;
                       std::this_thread::sleep_for(std::chrono::milliseconds(30));
                     },
                     [&] { return picture; }};
  const PeerWay quick{"b", "quick", [&] { ++quick_frames; }, [&] { return picture; }};
  const std::vector<PeerWay> ways{slow, quick};
  PeerTimings timings;
  timings.rounds = 3;
  timings.limit = 0.02;
  timings.one_thread = false;  // sleep takes no time on the processor
  const std::vector<PeerRow> rows = compare_peers(ways, picture, timings);
  EXPECT_EQ(slow_frames, 1);
  EXPECT_TRUE(rows[0].cold);
  EXPECT_GE(rows[0].seconds, 0.03);
  EXPECT_EQ(quick_frames, 4);
  EXPECT_EQ(rows[1].frames, 3);
  const std::string csv = peer_csv(rows);
  EXPECT_EQ(csv.find("method,family,milliseconds,max_error,rms_error\nslow,a,"), 0u) << csv;
}

TEST(Peers, what_they_cannot_show_is_refused) {
  Mesh mesh = generate("box-tetrahedra", {3, 0.2, 1});
  mesh.fields.push_back(
      {"in cells", Association::cell, 1, Array::own(std::vector<float>(mesh.cell_count(), 1.0f))});
  EXPECT_THROW(make_peer_scene(mesh, "in cells"), Error);
}

}  // namespace
}  // namespace plume::bench
