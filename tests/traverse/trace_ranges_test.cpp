// Passing by blocks of cells: what is visited is what a walk through all of them visits there.

#include "plume/traverse/trace_ranges.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rectilinear_meshes.h"

namespace plume::test {
namespace {

bool same(const Segment& a, const Segment& b) {
  return a.cell == b.cell && a.order == b.order && a.t_in == b.t_in && a.t_out == b.t_out &&
         a.s_in == b.s_in && a.s_out == b.s_out && a.inner[0] == b.inner[0] &&
         a.inner[1] == b.inner[1];
}

const GridCase kCases[] = {{"regular", {21, 16, 19}},
                           {"uneven", {33, 7, 18}, 0.9},
                           {"one cell", {1, 1, 1}},
                           {"flat", {40, 1, 3}, 0.5, 2},
                           {"descending", {16, 9, 14}, 0.7, 7},
                           {"shifted", {18, 7, 6}, 0.5, 3, 1, 1e7}};

class TraceRanges : public testing::TestWithParam<GridCase> {};

// Values are random: what matters is chosen by block, so that every pattern of blocks comes up.
TEST_P(TraceRanges, VisitsWhatAWalkVisitsInBlocksThatMatter) {
  const GridCase& c = GetParam();
  for (const Association association : {Association::point, Association::cell}) {
    const Mesh user = rectilinear(c, association);
    const Bounds bounds = check_structure(user);
    WalkableRectilinear mesh = make_walkable_rectilinear(user, select_field(user));
    const BoundaryIndex<RectilinearWalker> boundary(mesh);
    const RangeTree tree(mesh);
    RectilinearRays make_ray(user, bounds, 7);
    std::size_t over = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      Ray ray = make_ray(i);
      if (i % 3 == 0) ray.t_min = -std::numeric_limits<double>::infinity();
      const float limit = 0.9f + 0.0001f * static_cast<float>(i % 1000);
      auto matters = [&](float, float greatest) { return greatest > limit; };
      const ScalarOrder order = i % 2 == 0 ? ScalarOrder::linear : ScalarOrder::cubic;
      std::vector<Segment> expected, found;
      const std::uint32_t across = mesh.points(0) - 1, down = mesh.points(1) - 1;
      std::uint64_t cells = 0;
      trace(mesh, boundary, ray,
            [&](const Segment& s) {
              ++cells;
              const RangeTree::Range& range =
                  tree.around({s.cell % across, s.cell / across % down, s.cell / across / down}, 0);
              if (matters(range.least, range.greatest)) expected.push_back(s);
              return true;
            },
            {order, 0});
      bool passed = false;
      const TraceResult result = trace_ranges(
          mesh, tree, ray, matters,
          [&](const Segment& s) {
            // Said where something is left out, and nowhere else.
            EXPECT_TRUE(found.empty() || passed || s.t_in == found.back().t_out);
            passed = false;
            found.push_back(s);
            return true;
          },
          [&] { passed = true; }, order);
      const std::string which = c.name + (" ray " + std::to_string(i));
      ASSERT_EQ(result.end, WalkEnd::left) << which;
      ASSERT_EQ(result.cells, found.size()) << which;
      ASSERT_EQ(found.size(), expected.size()) << which;
      for (std::size_t s = 0; s < found.size(); ++s)
        ASSERT_TRUE(same(found[s], expected[s])) << which << " segment " << s;
      over += cells - found.size();
    }
    EXPECT_TRUE(over > 0 || mesh.cell_count() == 1) << "nothing was passed over";
  }
}

TEST_P(TraceRanges, StopsWhereItIsTold) {
  const Mesh user = rectilinear(GetParam());
  const Bounds bounds = check_structure(user);
  const WalkableRectilinear mesh = make_walkable_rectilinear(user, select_field(user));
  const RangeTree tree(mesh);
  RectilinearRays make_ray(user, bounds, 9);
  for (std::uint64_t i = 0; i < 200; ++i) {
    std::size_t visits = 0;
    const TraceResult result = trace_ranges(
        mesh, tree, make_ray(i), [](float, float) { return true; },
        [&](const Segment&) { return ++visits < 3; }, [] {}, ScalarOrder::linear);
    ASSERT_LE(visits, 3u);
    ASSERT_EQ(result.end, visits == 3 ? WalkEnd::stopped : WalkEnd::left);
  }
}

std::string name_of(const testing::TestParamInfo<GridCase>& grid) {
  std::string name = grid.param.name;
  std::erase(name, ' ');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Grids, TraceRanges, testing::ValuesIn(kCases), name_of);

}  // namespace
}  // namespace plume::test
