// How much memory it takes to make tetrahedra walkable: what the benchmarks report.

#include <gtest/gtest.h>

#include <vector>

#include "plume/datasets/generate.h"
#include "plume/mesh/validate.h"
#include "plume/mesh/walkable_tets.h"
#include "plume/tests/bench/build_bench.h"
#include "plume/tests/bench/counted_memory.h"

namespace plume::bench {
namespace {

TEST(CountedMemory, CountsWhatIsTakenAndGivenBack) {
  const std::size_t before = counted_bytes();
  forget_peak();
  {
    std::vector<char> first(1 << 20);
    EXPECT_GE(counted_bytes(), before + (1 << 20));
    EXPECT_LT(counted_bytes(), before + (1 << 20) + 65536);
    std::vector<char>(1 << 21).swap(first);
    EXPECT_GE(counted_bytes(), before + (2 << 20));
    EXPECT_LT(counted_bytes(), before + (2 << 20) + 65536);
  }
  EXPECT_LT(counted_bytes(), before + 65536);
  EXPECT_GE(counted_peak(), before + (3 << 20));
  EXPECT_LT(counted_peak(), before + (3 << 20) + 65536);
}

TEST(WalkableTets, TakeLittleMoreToBuildThanToKeep) {
  const Mesh mesh = generate("box-tetrahedra", {24, 0.2, 1});
  const Bounds bounds = check_structure(mesh);
  const ScalarField field = select_field(mesh);
  const auto cells = static_cast<double>(mesh.cell_count());
  const std::size_t before = counted_bytes();
  forget_peak();
  const WalkableTets tets = make_walkable_tets(mesh, field, bounds, false);
  const double kept = static_cast<double>(tets.bytes()) / cells;
  const double peak = static_cast<double>(counted_peak() - before) / cells;
  EXPECT_LE(kept, kMostBytesPerCell);
  EXPECT_NEAR(static_cast<double>(counted_bytes() - before) / cells, kept, 0.5);
  EXPECT_LE(peak, 48);
}

}  // namespace
}  // namespace plume::bench
