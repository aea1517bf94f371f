// The walkers of hexahedra that are timed against each other do the same work, as far as they take
// faces for the same surface, and are found out where they do not.

#include <gtest/gtest.h>

#include <vector>

#include "plume/datasets/generate.h"
#include "plume/tests/bench/agreement.h"

namespace plume::bench {
namespace {

const BenchWalker& walker_named(const std::string& name) {
  for (const BenchWalker& walker : walkers(Family::hexahedra))
    if (walker.name == name) return walker;
  throw std::out_of_range(name);
}

TEST(GridBenchWalkers, DoTheSameWork) {
  for (const char* name : {"twisted", "box-hexahedra", "blunt-body"}) {
    SCOPED_TRACE(name);
    const BenchMesh mesh = make_bench_mesh(generate(name, {12, 0.2, 2}), Family::hexahedra);
    std::vector<BenchView> views = make_views(mesh, 100);
    ASSERT_EQ(views.size(), 4u);
    const Agreement all = drop_lost(mesh, views);
    EXPECT_GT(all.total(), 10000u);
    EXPECT_LE(all.different.size(), 2u);
    for (const Mode mode : kModes)
      for (const BenchView& view : views) {
        std::vector<PassageSum> right(view.passages.size()), sums(view.passages.size());
        reference(Family::hexahedra).walk(mesh, view, mode, right);
        for (const BenchWalker& walker : walkers(Family::hexahedra)) {
          if (!walker.has(mode)) continue;
          walker.walk(mesh, view, mode, sums);
          EXPECT_EQ(problem(walker, mesh, mode, right, sums), "") << view.name;
        }
      }
  }
}

TEST(GridBenchWalkers, MeetOtherCellsOnlyWhereFacesAreTwisted) {
  auto share_of_other_cells = [](const char* name, double jitter) {
    const BenchMesh mesh = make_bench_mesh(generate(name, {12, jitter, 2}), Family::hexahedra);
    const BenchView view = make_views(mesh, 100).front();
    std::vector<PassageSum> right(view.passages.size()), sums(view.passages.size());
    reference(Family::hexahedra).walk(mesh, view, Mode::integral, right);
    walker_named("hybrid").walk(mesh, view, Mode::integral, sums);
    const Agreement agreement = compare(mesh, Mode::integral, right, sums, true);
    return static_cast<double>(agreement.other_way) / static_cast<double>(agreement.total());
  };
  EXPECT_EQ(share_of_other_cells("box-hexahedra", 0), 0);
  EXPECT_GT(share_of_other_cells("twisted", 0), 0.1);
}

TEST(GridBenchWalkers, AreFoundOutWhereTheySkipWork) {
  const BenchMesh mesh = make_bench_mesh(generate("twisted", {6, 0.2, 2}), Family::hexahedra);
  const BenchView view = make_views(mesh, 32).front();
  const BenchWalker& hybrid = walker_named("hybrid");
  for (const Mode mode : kModes) {
    std::vector<PassageSum> right(view.passages.size());
    reference(Family::hexahedra).walk(mesh, view, mode, right);
    std::vector<PassageSum> sums = right;
    EXPECT_EQ(problem(hybrid, mesh, mode, right, sums), "");
    // Of three passages in four nothing but the first cell.
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (i % 4 != 0) sums[i] = {1, 0, 0};
    EXPECT_NE(problem(hybrid, mesh, mode, right, sums), "") << mode_name(mode);
    EXPECT_NE(problem(reference(Family::hexahedra), mesh, mode, right, sums), "");
  }
}

}  // namespace
}  // namespace plume::bench
