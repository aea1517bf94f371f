// The baseline is an honest one: right where nothing is degenerate, as cheap as the thesis says,
// and lost where the thesis' rule gets lost. And whatever is timed has done the same work.

#include "plume/tests/bench/plucker_walker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/mesh/explicit_cells.h"
#include "plume/tests/bench/agreement.h"
#include "plume/tests/reference/box_chord.h"
#include "plume/tests/traverse/adversarial_rays.h"
#include "plume/traverse/trace.h"

namespace plume::bench {
namespace {

struct Fixture {
  Mesh mesh;
  BenchMesh made;
  BoundaryIndex<TetWalker> boundary;

  explicit Fixture(int size, double jitter)
      : mesh(generate("box-tetrahedra", {size, jitter, 1})),
        made(make_bench_mesh(mesh)),
        boundary(made.tets) {}

  BenchView view(const std::vector<Ray>& rays) const {
    return make_view(made, boundary, "test", rays);
  }
};

// Every sixth adversarial ray is a random one.
std::vector<Ray> random_rays(const Fixture& fixture, std::uint64_t count) {
  test::AdversarialRays make_ray(fixture.mesh, fixture.made.bounds, 3);
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < count; ++i) rays.push_back(make_ray(6 * i));
  return rays;
}

struct Audited {
  std::uint64_t cells = 0, tests = 0, lost = 0;
};

template <PluckerProducts kProducts>
Audited audit(const Fixture& fixture, const BenchView& view) {
  Audited audited;
  CountingAudit counting;
  for (const Passage& passage : view.passages) {
    CellsConsumer<float> consumer(fixture.made.optics);
    const PluckerWalk walk = walk_plucker<kProducts>(
        fixture.made.plucker, PluckerRay(view.rays[passage.ray], fixture.made.plucker.frame),
        fixture.made.tets.boundary[passage.entry.boundary], consumer, counting);
    audited.cells += walk.cells;
    audited.lost += walk.lost ? 1 : 0;
  }
  audited.tests = counting.tests;
  return audited;
}

TEST(PluckerWalker, MeetsAsManyCellsAsOursOnRandomRays) {
  const Fixture fixture(16, 0.2);
  const BenchView view = fixture.view(random_rays(fixture, 20000));
  ASSERT_GT(view.passages.size(), 15000u);
  std::vector<PassageSum> right(view.passages.size()), sums(view.passages.size());
  for (const Mode mode : kModes) {
    SCOPED_TRACE(mode_name(mode));
    reference().walk(fixture.made, view, mode, right);
    baseline().walk(fixture.made, view, mode, sums);
    const Agreement agreement = compare(fixture.made, mode, right, sums);
    // Single precision may go around the other side of an edge that a ray all but meets.
    EXPECT_GE(agreement.same, view.passages.size() - 10);
    EXPECT_LE(agreement.different.size(), 1u);
  }
}

TEST(PluckerWalker, TakesTwoAndTwoThirdsTestsACell) {
  const Fixture fixture(16, 0.2);
  const BenchView view = fixture.view(random_rays(fixture, 20000));
  for (const Audited& audited : {audit<PluckerProducts::thesis>(fixture, view),
                                 audit<PluckerProducts::relative>(fixture, view)}) {
    EXPECT_NEAR(static_cast<double>(audited.tests) / static_cast<double>(audited.cells), 2.67, 0.1);
    EXPECT_LE(audited.lost, 5u);
  }
}

TEST(PluckerWalker, LosesRaysAtVerticesWhereOursLosesNone) {
  const Fixture fixture(16, 0);
  std::vector<Ray> rays;
  for (const Ray& random : random_rays(fixture, 5000)) {
    // From the same origin exactly at a vertex: where the lattice lies is known to single
    // precision.
    const std::size_t vertex = rays.size() * 7919 % fixture.mesh.point_count();
    const std::array<double, 3> target = point_at(fixture.mesh, vertex);
    Ray ray = random;
    for (std::size_t a = 0; a < 3; ++a) ray.direction[a] = target[a] - ray.origin[a];
    const double length = std::hypot(ray.direction[0], ray.direction[1], ray.direction[2]);
    for (double& x : ray.direction) x /= length;
    rays.push_back(ray);
  }
  const BenchView view = fixture.view(rays);
  ASSERT_GT(view.passages.size(), 4000u);
  EXPECT_GT(audit<PluckerProducts::thesis>(fixture, view).lost, view.passages.size() / 100);
  EXPECT_GT(audit<PluckerProducts::relative>(fixture, view).lost, view.passages.size() / 100);

  const Bounds& bounds = fixture.made.bounds;
  for (const Ray& ray : rays) {
    double sum = 0;
    const TraceResult result =
        trace(fixture.made.tets, fixture.boundary, ray, [&sum](const Segment& segment) {
          sum += segment.t_out - segment.t_in;
          return true;
        });
    ASSERT_EQ(result.end, WalkEnd::left);
    ASSERT_NEAR(sum, reference::box_chord(bounds.low, bounds.high, ray.origin, ray.direction),
                1e-3);
  }
}

TEST(PluckerWalker, StandsInTheSameOrderOfCellsAndPoints) {
  const Fixture fixture(5, 0.2);
  const WalkableTets& tets = fixture.made.tets;
  const PluckerMesh& plucker = fixture.made.plucker;
  ASSERT_EQ(plucker.cells.size(), tets.cells.size());
  ASSERT_EQ(plucker.points.size(), tets.points.size());
  for (std::size_t p = 0; p < tets.points.size(); ++p)
    for (std::size_t a = 0; a < 3; ++a)
      ASSERT_EQ(plucker.points[p].position[a], tets.points[p].position[a]);
  for (const WalkableTets::Boundary& face : tets.boundary) {
    const PluckerMesh::Cell& cell = plucker.cells[face.cell];
    std::size_t at = 0;
    while (at < 4 && cell.points[at] != face.apex) ++at;
    ASSERT_LT(at, 4u);
    ASSERT_EQ(cell.neighbors[at], kNone);
  }
  for (std::uint32_t c = 0; c < plucker.cells.size(); ++c)
    for (const std::uint32_t next : plucker.cells[c].neighbors) {
      if (next == kNone) continue;
      ASSERT_EQ(plucker.cells[next / 4].neighbors[next % 4] / 4, c);
    }
}

TEST(BenchWalkers, DoTheSameWork) {
  for (const CellOrder order : {CellOrder::hilbert, CellOrder::random}) {
    const BenchMesh mesh =
        make_bench_mesh(generate("box-tetrahedra", {12, 0.2, 2}), Family::tetrahedra, order);
    std::vector<BenchView> views = make_views(mesh, 100);
    ASSERT_EQ(views.size(), 4u);
    const Agreement all = drop_lost(mesh, views);
    EXPECT_GT(all.same, 15000u);
    EXPECT_LE(all.different.size(), 2u);
    for (const Mode mode : kModes)
      for (const BenchView& view : views)
        for (const BenchWalker& walker : walkers()) {
          if (!walker.has(mode)) continue;
          std::vector<PassageSum> right(view.passages.size()), sums(view.passages.size());
          reference().walk(mesh, view, mode, right);
          walker.walk(mesh, view, mode, sums);
          EXPECT_EQ(problem(walker, mesh, mode, right, sums), "") << view.name;
        }
  }
}

TEST(BenchWalkers, AreFoundOutWhereTheySkipWork) {
  const BenchMesh mesh = make_bench_mesh(generate("box-tetrahedra", {6, 0.2, 2}));
  const BenchView view = make_views(mesh, 32).front();
  std::vector<PassageSum> right(view.passages.size());
  reference().walk(mesh, view, Mode::integral, right);
  std::vector<PassageSum> sums = right;
  sums[7].cells -= 1;
  sums[9].second += 0.1f;
  sums[11].first = std::nanf("");
  const Agreement agreement = compare(mesh, Mode::integral, right, sums);
  EXPECT_EQ(agreement.other_way, 1u);
  EXPECT_EQ(agreement.different, (std::vector<std::uint32_t>{9, 11}));
  EXPECT_NE(problem(reference(), mesh.family, Mode::integral, agreement), "");
  EXPECT_EQ(problem(reference(), mesh, Mode::integral, right, right), "");
}

TEST(BenchMeshes, AGridsTetrahedraFillIt) {
  const Mesh grid = generate("blunt-body", {16, 0, 1});
  const Mesh cut = cut_into_tetrahedra(grid);
  EXPECT_EQ(cut.cell_count(), 6 * grid.cell_count());
  const BenchMesh mesh = make_bench_mesh(cut);
  // All faces of neighbours match: what is left is two triangles for each of the grid's faces.
  const auto& n = grid.dimensions;
  const std::int64_t a = n[0] - 1, b = n[1] - 1, c = n[2] - 1;
  EXPECT_EQ(mesh.tets.boundary.size(), static_cast<std::size_t>(4 * (a * b + b * c + c * a)));
  EXPECT_EQ(mesh.tets.findings.size(), 0u);
}

}  // namespace
}  // namespace plume::bench
