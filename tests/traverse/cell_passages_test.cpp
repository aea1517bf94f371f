// Passages through single cells: a walk's, and never backwards in a cell that is not crooked.

#include "plume/traverse/cell_passages.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "adversarial_rays.h"
#include "plume/datasets/generate.h"
#include "plume/mesh/crooked_cell.h"
#include "plume/mesh/validate.h"
#include "traced.h"

namespace plume::test {
namespace {

struct Tally {
  std::size_t passages = 0, backwards = 0, backwards_in_crooked = 0;
};

template <class Walker>
void go_through_all(const typename Walker::Mesh& mesh, const Mesh& of, std::size_t rays,
                    Tally& tally) {
  AdversarialRays make_ray(of, bounds_of(of.points), 5);
  CellPassages<Walker> passages(mesh);
  for (std::size_t i = 0; i < rays; ++i) {
    ShearedFrame frame;
    if (!frame.set(make_ray(i), mesh.frame)) continue;
    for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell)
      for (const auto& [in, out] : passages.through(cell, frame)) {
        ++tally.passages;
        // Beyond what rounding may do.
        if ((out.place.z - in.place.z) * frame.sign() >= -0x1p-20) continue;
        ++(is_crooked(mesh, cell) ? tally.backwards_in_crooked : tally.backwards);
      }
  }
}

TEST(CellPassages, GoForwardInCellsThatAreNotCrooked) {
  for (const double jitter : {0.2, 0.6, 1.5}) {
    Tally tally;
    const Mesh grid = generate("box-hexahedra", {4, jitter, 7});
    go_through_all<GridWalker>(make_walkable_grid(grid, select_field(grid), check_structure(grid)),
                               grid, 1500, tally);
    const Mesh mixed = generate("box-mixed", {3, jitter, 7});
    go_through_all<CellWalker>(
        make_walkable_cells(mixed, select_field(mixed), check_structure(mixed), false), mixed, 1500,
        tally);
    EXPECT_GT(tally.passages, 1000u);
    EXPECT_EQ(tally.backwards, 0u) << jitter;
    EXPECT_TRUE(jitter < 1 || tally.backwards_in_crooked > 0) << jitter;
  }
}

// Each segment of a walk is one of its cell's passages, bit for bit.
template <class Walker>
void expect_as_walked(const Traced<Walker>& traced, const Mesh& of) {
  AdversarialRays make_ray(of, bounds_of(of.points), 9);
  CellPassages<Walker> passages(traced.mesh);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < 1500; ++i) {
    const Ray ray = make_ray(i);
    ShearedFrame frame;
    if (!frame.set(ray, traced.mesh.frame)) continue;
    trace(traced.mesh, traced.boundary, ray, [&](const Segment& segment) {
      // Where rays are cut, or would have to go back, places are others.
      bool found = false;
      for (const auto& [in, out] : passages.through(segment.cell, frame))
        found = found || (frame.t(out.place.z) == segment.t_out &&
                          in.place.scalar == segment.s_in && out.place.scalar == segment.s_out);
      if (segment.t_in > ray.t_min && segment.t_out < ray.t_max && segment.t_in < segment.t_out) {
        EXPECT_TRUE(found) << i;
        ++compared;
      }
      return true;
    });
  }
  EXPECT_GT(compared, 3000u);
}

TEST(CellPassages, AreAWalks) {
  const Mesh grid = generate("twisted", {6, 0.3, 7});
  expect_as_walked<GridWalker>(trace_as_grid<GridWalker>(grid), grid);
  const Mesh mixed = generate("box-mixed", {5, 0.2, 7});
  expect_as_walked<CellWalker>(trace_as_cells(mixed), mixed);
}

}  // namespace
}  // namespace plume::test
