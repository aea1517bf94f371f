// Takes the place of tetgen_engine.cpp in a build without TetGen.
#include "plume/mesh/error.h"
#include "plume/mesh/tetrahedralization_engines.h"

namespace plume {
namespace {

[[noreturn]] void refuse() {
  throw Error(
      "this build has no TetGen: configure with -DPLUME_WITH_TETGEN=ON (Debian: libtet1.5-dev; its "
      "licence is the AGPL)");
}

}  // namespace

bool has_tetgen() { return false; }

Array tetgen_delaunay(std::span<const double>) { refuse(); }

TetgenMesh tetgen_fill(std::span<const double>, const std::vector<std::array<std::uint32_t, 3>>&,
                       const std::vector<std::uint32_t>&, const SurfaceMeshing&) {
  refuse();
}

}  // namespace plume
