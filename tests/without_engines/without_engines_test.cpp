// A build without TetGen and CGAL says what is missing. Compiled with without_tetgen.cpp and
// without_cgal.cpp, whatever the build has.
#include <gtest/gtest.h>

#include "plume/mesh/error.h"
#include "plume/mesh/tetrahedralize.h"

namespace plume::test {
namespace {

std::string error_of(auto&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

PointSet four_points() {
  PointSet set;
  set.points = Array::own(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  return set;
}

TEST(WithoutEngines, HasNone) {
  EXPECT_FALSE(has_engine(TetrahedralizationEngine::automatic));
  EXPECT_FALSE(has_engine(TetrahedralizationEngine::tetgen));
  EXPECT_FALSE(has_engine(TetrahedralizationEngine::cgal));
}

TEST(WithoutEngines, NamesTheOptionAndThePackage) {
  using Engine = TetrahedralizationEngine;
  const auto with = [](Engine engine) {
    return error_of([&] { tetrahedralize(four_points(), engine); });
  };
  EXPECT_EQ(with(Engine::tetgen),
            "this build has no TetGen: configure with -DPLUME_WITH_TETGEN=ON (Debian: "
            "libtet1.5-dev; its licence is the AGPL)");
  EXPECT_EQ(with(Engine::cgal),
            "this build has no CGAL: configure with -DPLUME_WITH_CGAL=ON (Debian: libcgal-dev; its "
            "triangulations' licence is the GPL)");
  for (const char* part : {"-DPLUME_WITH_TETGEN=ON", "libtet1.5-dev", "AGPL",
                           "-DPLUME_WITH_CGAL=ON", "libcgal-dev", "GPL"})
    EXPECT_NE(with(Engine::automatic).find(part), std::string::npos) << part;
}

TEST(WithoutEngines, SaysSoOfSurfaces) {
  TriangleSurface surface{four_points(), {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}}};
  EXPECT_NE(error_of([&] { tetrahedralize(surface); }).find("-DPLUME_WITH_TETGEN=ON"),
            std::string::npos);
}

}  // namespace
}  // namespace plume::test
