// Packets take the way of their scalar twin, bit for bit, with every instruction set at hand.

#include "plume/traverse/packets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "adversarial_rays.h"
#include "packet_sums.h"
#include "plume/datasets/generate.h"
#include "plume/mesh/validate.h"
#include "plume/traverse/trace.h"

namespace plume::test {
namespace {

// Hands out starts of one axis, each once.
template <class Start>
class Starts : public PacketFeeder {
 public:
  explicit Starts(std::vector<Start> starts) : starts_(std::move(starts)) {}
  const PacketStart* next(const PacketStart*) override {
    return at_ < starts_.size() ? &starts_[at_++] : nullptr;
  }
  void rewind() { at_ = 0; }

 private:
  std::vector<Start> starts_;
  std::size_t at_ = 0;
};

// Packets against Walker on everything that an adversarial ray meets first. Sums of lengths may
// differ by `length_error`, in the local frame's units.
template <class Walker>
void expect_twins(const Mesh& user_mesh, const typename Walker::Mesh& mesh, std::uint64_t rays,
                  double length_error) {
  const ScalarField field = select_field(user_mesh);
  const BoundaryIndex<Walker> boundary(mesh);
  AdversarialRays make_ray(user_mesh, bounds_of(user_mesh.points), 31);

  // The twin's first passage of each ray.
  using Start = StartOf<typename Walker::Mesh>;
  std::vector<std::vector<Start>> starts(3);
  std::vector<std::vector<Segment>> expected;
  std::deque<ShearedFrame> frames;  // starts refer to them
  for (std::uint64_t i = 0; i < rays; ++i) {
    ShearedFrame& frame = frames.emplace_back();
    ASSERT_TRUE(frame.set(make_ray(i), mesh.frame));
    Walker walker(mesh, frame);
    const auto entry = Entries<Walker>().first(boundary, walker, frame);
    if (!entry) continue;
    walker.enter(mesh.boundary[entry->boundary], entry->rank);
    starts[static_cast<std::size_t>(frame.axis())].push_back(
        make_start(mesh, frame, mesh.boundary[entry->boundary], entry->place, entry->rank,
                   static_cast<std::uint32_t>(expected.size())));
    std::vector<Segment> segments;
    double t_in = frame.t(entry->place.z);
    float s_in = entry->place.scalar;
    do {
      const std::uint32_t cell = walker.cell();
      const auto exit = walker.leave();
      ASSERT_TRUE(exit);
      segments.push_back({t_in, std::max(t_in, frame.t(exit->z)), s_in, exit->scalar, cell});
      t_in = segments.back().t_out;
      s_in = exit->scalar;
    } while (walker.advance());
    expected.push_back(std::move(segments));
  }
  ASSERT_GT(expected.size(), rays / 3);

  const InstructionSets sets;
  std::set<std::string> names;
  for (const std::int64_t target : sets.each) {
    limit_packet_instruction_sets(target);
    SCOPED_TRACE(packet_instruction_set());
    names.insert(packet_instruction_set());
    std::vector<std::uint32_t> counts(expected.size(), 0);
    Segments found(expected.size());
    std::vector<PacketIntegral> integrals(expected.size());
    std::vector<PacketHit> hits(expected.size());
    const float isovalue = 0.5f * (field.low + field.high);
    for (int axis = 0; axis < 3; ++axis) {
      Starts<Start> feeder(starts[static_cast<std::size_t>(axis)]);
      count_cells(mesh, axis, feeder, counts);
      feeder.rewind();
      walk_segments(mesh, axis, feeder, found);
      feeder.rewind();
      integrate_scalar(mesh, axis, feeder, integrals);
      feeder.rewind();
      find_isosurface(mesh, axis, isovalue, feeder, hits);
    }
    for (std::size_t ray = 0; ray < expected.size(); ++ray) {
      const auto& mine = found.of_ray[ray];
      const auto& twin = expected[ray];
      ASSERT_EQ(counts[ray], twin.size()) << "ray " << ray;
      ASSERT_EQ(mine.size(), twin.size()) << "ray " << ray;
      double sum = 0, twin_sum = 0;
      for (std::size_t s = 0; s < twin.size(); ++s) {
        ASSERT_EQ(mine[s].cell, twin[s].cell) << "ray " << ray << " step " << s;
        sum += mine[s].length;
        twin_sum += twin[s].t_out - twin[s].t_in;
      }
      ASSERT_NEAR(sum * mesh.frame.scale, twin_sum * mesh.frame.scale, length_error)
          << "ray " << ray;
      expect_sums(integrals[ray], hits[ray], mine, isovalue);
    }
  }
  // At least the baseline and something wider; bits of sets that were not compiled fall back on
  // one.
  EXPECT_GE(names.size(), 2u);
}

// The measurements: single precision against double. Sums telescope, so that only the ends of the
// passage count. Where there are no fused products, slivers near the boundary may lose more of it.
constexpr double kTetLengthError = 8e-6;

void expect_tet_twins(const Mesh& mesh, std::uint64_t rays) {
  for (const TetLinks links : {TetLinks::whole, TetLinks::compact}) {
    SCOPED_TRACE(links == TetLinks::whole ? "whole links" : "compact cells");
    expect_twins<TetWalker>(
        mesh,
        make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), false, false, links),
        rays, kTetLengthError);
  }
}

TEST(TetPackets, TakeTheWayOfTheirTwinThroughCleanCells) {
  expect_tet_twins(generate("box-tetrahedra", {10, 0, 5}), 20000);
}
TEST(TetPackets, TakeTheWayOfTheirTwinThroughJitteredCells) {
  expect_tet_twins(generate("box-tetrahedra", {10, 0.25, 5}), 20000);
}
TEST(TetPackets, TakeTheWayOfTheirTwinThroughInvertedCells) {
  expect_tet_twins(generate("box-tetrahedra", {10, 3, 5}), 20000);
}

TEST(TetPackets, WalkAsFewRaysAsOne) {
  expect_tet_twins(generate("box-tetrahedra", {3, 0.2, 5}), 3);
  const WalkableTets none;
  Starts<TetStart> nothing({});
  std::vector<std::uint32_t> counts;
  count_cells(none, 0, nothing, counts);
}

// With one point of the grid moved by almost half an edge.
Mesh dented(Mesh mesh, const std::array<std::size_t, 3>& index) {
  std::vector<double> points(mesh.points.size());
  for (std::size_t x = 0; x < points.size(); ++x) points[x] = mesh.points.at<double>(x);
  const auto& n = mesh.dimensions;
  const auto point = index[0] + static_cast<std::size_t>(n[0]) *
                                    (index[1] + static_cast<std::size_t>(n[1]) * index[2]);
  const double edge = points[3] - points[0];
  points[3 * point] += 0.4 * edge;
  points[3 * point + 1] -= 0.45 * edge;
  points[3 * point + 2] += 0.3 * edge;
  mesh.points = Array::own(std::move(points));
  return mesh;
}

void expect_grid_twins(const Mesh& mesh, std::uint64_t rays) {
  expect_twins<GridWalker>(
      mesh, make_walkable_grid(mesh, select_field(mesh), check_structure(mesh)), rays, 8e-6);
}

TEST(GridPackets, TakeTheWayOfTheirTwinThroughCleanCells) {
  expect_grid_twins(generate("box-hexahedra", {10, 0, 5}), 20000);
}
TEST(GridPackets, TakeTheWayOfTheirTwinThroughJitteredCells) {
  expect_grid_twins(generate("box-hexahedra", {10, 0.25, 5}), 20000);
}
TEST(GridPackets, TakeTheWayOfTheirTwinThroughInvertedCells) {
  expect_grid_twins(generate("box-hexahedra", {10, 3, 5}), 20000);
}
TEST(GridPackets, TakeTheWayOfTheirTwinThroughTwistedCells) {
  expect_grid_twins(generate("twisted", {10}), 20000);
}
TEST(GridPackets, TakeTheWayOfTheirTwinThroughCollapsedCells) {
  expect_grid_twins(generate("o-grid", {6}), 20000);
  expect_grid_twins(generate("sphere", {6}), 20000);
}
// Twisted faces around one point: lanes in the cells there ask their twin, at the boundary, too.
TEST(GridPackets, TakeTheWayOfTheirTwinAroundADent) {
  for (const std::array<std::size_t, 3>& dent :
       {std::array<std::size_t, 3>{5, 5, 5}, {0, 5, 5}, {10, 10, 4}}) {
    const Mesh mesh = dented(generate("box-hexahedra", {10, 0, 5}), dent);
    const WalkableGrid grid = make_walkable_grid(mesh, select_field(mesh), check_structure(mesh));
    EXPECT_GT(grid.twisted.cell_count(), 0u);
    EXPECT_LE(grid.twisted.cell_count(), 8u);
    expect_grid_twins(mesh, 20000);
  }
}
TEST(GridPackets, TakeTheWayOfTheirTwinThroughACurvedGrid) {
  expect_grid_twins(generate("blunt-body", {20}), 20000);
}

TEST(GridPackets, TakeTheWayOfTheirTwinAroundHiddenCells) {
  Mesh mesh = generate("box-hexahedra", {10, 0.2, 5});
  std::vector<std::uint8_t> hidden(mesh.cell_count());
  std::mt19937_64 random(7);
  for (auto& one : hidden) one = random() % 5 == 0;
  mesh.hidden_cells = Array::own(std::move(hidden));
  expect_grid_twins(mesh, 20000);
}

TEST(GridPackets, WalkAsFewRaysAsOne) {
  expect_grid_twins(generate("box-hexahedra", {3, 0.2, 5}), 3);
}

WalkableCells cells_of(const Mesh& mesh) {
  WalkableCells cells = make_walkable_cells(mesh, select_field(mesh), check_structure(mesh), false);
  prepare_packets(cells);
  return cells;
}

void expect_cell_twins(const Mesh& mesh, std::uint64_t rays) {
  expect_twins<CellWalker>(mesh, cells_of(mesh), rays, 8e-6);
}

TEST(CellPackets, TakeTheWayOfTheirTwinThroughWedges) {
  expect_cell_twins(generate("box-wedges", {8, 0, 5}), 10000);
  expect_cell_twins(generate("box-wedges", {8, 0.25, 5}), 10000);
}
TEST(CellPackets, TakeTheWayOfTheirTwinThroughMixedCells) {
  expect_cell_twins(generate("box-mixed", {8, 0, 5}), 10000);
  expect_cell_twins(generate("box-mixed", {8, 0.25, 5}), 10000);
}
TEST(CellPackets, TakeTheWayOfTheirTwinThroughInvertedCells) {
  expect_cell_twins(generate("box-mixed", {6, 3, 5}), 5000);
}
TEST(CellPackets, TakeTheWayOfTheirTwinThroughTwoBlocksOfHexahedra) {
  expect_cell_twins(generate("two-blocks", {8, 0.25, 5}), 10000);
}

// Cells that packets know nothing of, as polyhedra, among others.
TEST(CellPackets, AskTheirTwinInPolyhedra) {
  const Mesh mesh = generate("box-mixed", {8, 0.25, 5});
  WalkableCells cells = cells_of(mesh);
  auto is_other = [](std::uint32_t cell) { return cell % 5 == 0; };
  for (std::uint32_t c = 0; c < cells.cell_count(); ++c) {
    CornerCell& cell = cells.corner_cells[c];
    for (std::uint32_t& link : cell.links)
      if (link != kNone && is_other(link / 8)) link |= kNoCorners;
    if (!is_other(c)) continue;
    cell.points.fill(0);
    cell.links.fill(kNone);
    cell.other = 1;
  }
  expect_twins<CellWalker>(mesh, cells, 10000, 8e-6);
}

// All cells by their records of corners and edges, whatever they are.
WalkableCells edge_cells_of(const Mesh& mesh) {
  WalkableCells cells = make_walkable_cells(mesh, select_field(mesh), check_structure(mesh), false);
  cells.edge_cells = make_edge_cells(cells);
  return cells;
}

void expect_edge_twins(const Mesh& mesh, std::uint64_t rays) {
  expect_twins<CellWalker>(mesh, edge_cells_of(mesh), rays, 8e-6);
}

TEST(EdgePackets, TakeTheWayOfTheirTwinThroughPolyhedra) {
  expect_cell_twins(generate("box-polyhedra", {8, 0, 5}), 10000);
  expect_cell_twins(generate("box-polyhedra", {8, 0.25, 5}), 10000);
}
TEST(EdgePackets, TakeTheWayOfTheirTwinThroughConcaveAndTangledPolyhedra) {
  expect_cell_twins(generate("box-polyhedra", {6, 1, 5}), 5000);
  expect_cell_twins(generate("box-polyhedra", {6, 3, 5}), 5000);
}
TEST(EdgePackets, TakeTheWayOfTheirTwinThroughCellsOfAnyKind) {
  expect_edge_twins(generate("box-mixed", {8, 0, 5}), 5000);
  expect_edge_twins(generate("box-mixed", {8, 0.25, 5}), 5000);
  expect_edge_twins(generate("box-tetrahedra", {6, 0.25, 5}), 5000);
  expect_edge_twins(generate("two-blocks", {8, 0.25, 5}), 5000);
}
TEST(EdgePackets, AskTheirTwinInCellsWithoutARecord) {
  const Mesh mesh = generate("box-polyhedra", {8, 0.25, 5});
  WalkableCells cells = edge_cells_of(mesh);
  for (std::size_t c = 0; c < cells.cell_count(); c += 5) cells.edge_cells.begin[c] = kNone;
  expect_twins<CellWalker>(mesh, cells, 5000, 8e-6);
}
TEST(EdgePackets, WalkAsFewRaysAsOne) {
  expect_cell_twins(generate("box-polyhedra", {3, 0.2, 5}), 3);
}

TEST(CellPackets, WalkAsFewRaysAsOne) { expect_cell_twins(generate("box-mixed", {3, 0.2, 5}), 3); }

// Of a linear field, what is measured where the ray crosses a face is its value there: also where
// the ray lies in a face's plane, which gives no place by its corners' weights.
TEST(TetPackets, MeasureALinearFieldWhereTheRayIs) {
  for (const double jitter : {0.0, 0.25}) {
    SCOPED_TRACE(jitter);
    const Mesh user_mesh = generate("box-tetrahedra", {8, jitter, 5});
    const WalkableTets mesh = make_walkable_tets(user_mesh, select_field(user_mesh, {"linear", {}}),
                                                 check_structure(user_mesh), false);
    const BoundaryIndex<TetWalker> boundary(mesh);
    AdversarialRays make_ray(user_mesh, bounds_of(user_mesh.points), 37);
    std::vector<std::vector<TetStart>> starts(3);
    std::vector<Ray> rays;
    std::vector<double> entries;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const Ray ray = make_ray(i);
      ShearedFrame frame;
      ASSERT_TRUE(frame.set(ray, mesh.frame));
      TetWalker walker(mesh, frame);
      const auto entry = Entries<TetWalker>().first(boundary, walker, frame);
      if (!entry) continue;
      starts[static_cast<std::size_t>(frame.axis())].push_back(
          make_start(mesh, frame, mesh.boundary[entry->boundary], entry->place, entry->rank,
                     static_cast<std::uint32_t>(rays.size())));
      rays.push_back(ray);
      entries.push_back(frame.t(entry->place.z));
    }
    const InstructionSets sets;
    for (const std::int64_t target : sets.each) {
      limit_packet_instruction_sets(target);
      SCOPED_TRACE(packet_instruction_set());
      Segments found(rays.size());
      for (int axis = 0; axis < 3; ++axis) {
        Starts<TetStart> feeder(starts[static_cast<std::size_t>(axis)]);
        walk_segments(mesh, axis, feeder, found);
      }
      for (std::size_t i = 0; i < rays.size(); ++i) {
        double t = entries[i];
        const auto& d = rays[i].direction;
        const double unit = 1 / std::hypot(d[0], d[1], d[2]);
        for (const PacketSegment& segment : found.of_ray[i]) {
          t += segment.length * unit;
          double value = 0;
          for (std::size_t a = 0; a < 3; ++a)
            value += static_cast<double>(a + 1) * (rays[i].origin[a] + t * d[a]);
          // The field runs from 0 to 6; single precision, and a step along the ray for each cell.
          ASSERT_NEAR(segment.s_out, value, 2e-5) << "ray " << i;
        }
      }
    }
  }
}

// A box of this width and length 1, for rays that run along it.
Mesh needle(const std::string& generator, double width) {
  Mesh mesh = generate(generator, {1, 0, 1});
  std::vector<double> points;
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    for (std::size_t a = 0; a < 3; ++a)
      points.push_back((mesh.points.at<double>(3 * p + a) - 0.5) * (a == 2 ? 1 : width));
  mesh.points = Array::own(std::move(points));
  return mesh;
}

template <class Walker>
void expect_needle_measured(const typename Walker::Mesh& mesh, double width) {
  SCOPED_TRACE(width);
  const BoundaryIndex<Walker> boundary(mesh);
  ShearedFrame frame;
  ASSERT_TRUE(frame.set({{0.1 * width, -0.2 * width, -3}, {0, 0, 1}}, mesh.frame));
  Walker walker(mesh, frame);
  const auto entry = Entries<Walker>().first(boundary, walker, frame);
  ASSERT_TRUE(entry);
  walker.enter(mesh.boundary[entry->boundary], entry->rank);
  float s_out = 0;
  do {
    const auto exit = walker.leave();
    ASSERT_TRUE(exit);
    s_out = exit->scalar;
  } while (walker.advance());
  const InstructionSets sets;
  for (const std::int64_t target : sets.each) {
    limit_packet_instruction_sets(target);
    SCOPED_TRACE(packet_instruction_set());
    Starts<StartOf<typename Walker::Mesh>> feeder(
        {make_start(mesh, frame, mesh.boundary[entry->boundary], entry->place, entry->rank, 0)});
    Segments found(1);
    walk_segments(mesh, frame.axis(), feeder, found);
    double sum = 0;
    for (const PacketSegment& s : found.of_ray[0]) sum += s.length;
    EXPECT_NEAR(sum, 1, 4e-6);
    ASSERT_FALSE(found.of_ray[0].empty());
    EXPECT_NEAR(found.of_ray[0].back().s_out, s_out, 1e-6);
  }
}

// Three coordinates next to zero have a product that single precision does not know.
TEST(TetPackets, MeasureANeedleThatTheRayRunsThrough) {
  for (const double width : {1e-8, 1e-14, 1e-16, 1e-18}) {
    const Mesh mesh = needle("box-tetrahedra", width);
    expect_needle_measured<TetWalker>(
        make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), false), width);
  }
}

// Products of two products must neither underflow.
TEST(GridPackets, MeasureANeedleThatTheRayRunsThrough) {
  for (const double width : {1e-2, 1e-5, 1e-8, 1e-11, 1e-14}) {
    const Mesh mesh = needle("box-hexahedra", width);
    expect_needle_measured<GridWalker>(
        make_walkable_grid(mesh, select_field(mesh), check_structure(mesh)), width);
  }
}

}  // namespace
}  // namespace plume::test
