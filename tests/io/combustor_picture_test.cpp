// A picture whose order cannot be told from most of its pixels: in the combustor's cells about the
// axis, nearly collapsed, the scalar along some rays is none that a cubic follows.

#include <gtest/gtest.h>

#include <string>

#include "plume/lib/mode_difference.h"
#include "plume/lib/planner.h"
#include "plume/lib/plume.h"
#include "plume/tests/io/read_test_files.h"

namespace plume::test {
namespace {

TEST(CombustorPicture, IsWithinAThousandthByPackets) {
  const auto grid = dataset("combustor/combxyz.bin");
  PLUME_SKIP_WITHOUT(grid);
  const Scene scene(read(grid, {.solution = dataset("combustor/combq.bin")}).mesh);
  RenderSettings settings;
  settings.width = 160;
  settings.height = 120;
  settings.early_termination = 0;
  const Camera camera = named_view("iso", scene.bounds(), 160.0 / 120);
  const Image right = render(scene, camera, reference_settings(settings)).image;
  auto error = [&](const RenderResult& result) {
    EXPECT_EQ(result.statistics.rays_in_packets, 160u * 120u);
    return greatest_difference(result.image, right, Mode::volume, 0);
  };
  settings.order = ScalarOrder::cubic;
  EXPECT_GT(error(render(scene, camera, settings)), 1e-3);
  settings.order = ScalarOrder::adaptive;
  EXPECT_LT(error(render(scene, camera, settings)), 2e-4);
  settings.tolerance = Tolerance{1e-3};
  const RenderResult planned = render(scene, camera, settings);
  EXPECT_EQ(planned.statistics.order, ScalarOrder::adaptive);
  EXPECT_LE(error(planned), 1e-3);
}

}  // namespace
}  // namespace plume::test
