// Compact tetrahedra make the pictures of whole ones: to the bit where both are walked alike.

#include <gtest/gtest.h>

#include "plume/datasets/generate.h"
#include "plume/lib/plume.h"

namespace plume::test {
namespace {

RenderSettings small(Mode mode = Mode::volume) {
  RenderSettings settings;
  settings.width = settings.height = 48;
  settings.mode = mode;
  return settings;
}

class CompactTetrahedra : public testing::TestWithParam<Mode> {};
INSTANTIATE_TEST_SUITE_P(EveryMode, CompactTetrahedra,
                         testing::Values(Mode::volume, Mode::maximum, Mode::minimum, Mode::average,
                                         Mode::integral, Mode::depth));

TEST_P(CompactTetrahedra, MakeThePictureOfWholeOnes) {
  for (const char* name : {"box-tetrahedra", "ball-tetrahedra"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = generate(name, {8, 0.2, 2});
    SceneOptions options;
    const Scene whole(mesh, options);
    options.compact_tetrahedra = true;
    const Scene compact(mesh, options);
    EXPECT_LT(compact.bytes(), whole.bytes());
    EXPECT_EQ(compact.cell_count(), whole.cell_count());
    EXPECT_EQ(compact.connected_part_count(), whole.connected_part_count());
    const Camera camera = named_view("iso", whole.bounds());
    for (const bool twin : {false, true}) {
      RenderSettings settings = small(GetParam());
      settings.scalar_twin = twin;
      const RenderResult of_whole = render(whole, camera, settings);
      const RenderResult of_compact = render(compact, camera, settings);
      EXPECT_GT(of_compact.statistics.cells_visited, 200u);
      // Maxima and minima are looked for, and other numbers found by packets, in whole ones alone.
      const float bound = twin || GetParam() == Mode::volume ? 0 : 1e-5f;
      ASSERT_EQ(of_compact.image.rgba.size(), of_whole.image.rgba.size());
      for (std::size_t i = 0; i < of_whole.image.rgba.size(); ++i)
        ASSERT_NEAR(of_compact.image.rgba[i], of_whole.image.rgba[i], bound) << i;
    }
  }
}

TEST(CompactTetrahedra, AreWalkedToForIsosurfaces) {
  const Mesh mesh = generate("box-tetrahedra", {8, 0.2, 2});
  SceneOptions options;
  Scene whole(mesh, options);
  options.compact_tetrahedra = true;
  Scene compact(mesh, options);
  const auto& knots = whole.transfer_function().knots;
  const Classification surface{
      std::nullopt, {}, {{0.5f * (knots.front().scalar + knots.back().scalar), 1, {1, 1, 1}}}};
  whole.set_classification(surface);
  compact.set_classification(surface);
  const Camera camera = named_view("iso", whole.bounds());
  const RenderResult of_whole = render(whole, camera, small());
  const RenderResult of_compact = render(compact, camera, small());
  EXPECT_GT(of_whole.statistics.rays_searched, 0u);
  EXPECT_EQ(of_compact.statistics.rays_searched, 0u);
  for (std::size_t i = 0; i < of_whole.image.rgba.size(); ++i)
    ASSERT_NEAR(of_compact.image.rgba[i], of_whole.image.rgba[i], 2e-6) << i;
}

}  // namespace
}  // namespace plume::test
