// Packets take the way of their scalar twin, bit for bit, with every instruction set at hand.

#include "plume/traverse/tet_packets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "adversarial_rays.h"
#include "hwy/targets.h"
#include "plume/datasets/generate.h"
#include "plume/mesh/validate.h"
#include "plume/traverse/trace.h"

namespace plume::test {
namespace {

// Hands out starts of one axis, each once.
class Starts : public PacketFeeder {
 public:
  explicit Starts(std::vector<PacketStart> starts) : starts_(std::move(starts)) {}
  const PacketStart* next(const PacketStart*) override {
    return at_ < starts_.size() ? &starts_[at_++] : nullptr;
  }
  void rewind() { at_ = 0; }

 private:
  std::vector<PacketStart> starts_;
  std::size_t at_ = 0;
};

class Segments : public PacketSegmentSink {
 public:
  explicit Segments(std::size_t rays) : of_ray(rays) {}
  void take(const PacketSegment& segment) override { of_ray[segment.ray].push_back(segment); }
  std::vector<std::vector<PacketSegment>> of_ray;
};

// Restores all instruction sets at the end of a scope.
struct InstructionSets {
  std::vector<std::int64_t> each;
  InstructionSets() {
    for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1)
      each.push_back(all & -all);
  }
  ~InstructionSets() { limit_packet_instruction_sets(0); }
};

struct Case {
  const char* name;
  int size;
  double jitter;
  std::uint64_t rays;
};

// The other instantiations of the walk come to what its segments do.
void expect_sums(const PacketIntegral& integral, const PacketHit& hit,
                 const std::vector<PacketSegment>& segments, float isovalue) {
  double length = 0, sum = 0;
  for (const PacketSegment& s : segments) {
    length += s.length;
    sum += 0.5 * s.length * (static_cast<double>(s.s_in) + s.s_out);
  }
  const auto count = static_cast<std::uint32_t>(segments.size());
  ASSERT_EQ(integral.cells, count);
  // Half a unit in the last place of the sum (at most 4 for lengths, 16 for integrals) for each
  // addition.
  ASSERT_NEAR(integral.length, length, 2.4e-7 * (count + 1));
  ASSERT_NEAR(integral.integral, sum, 1e-6 * (count + 1));

  double way = 0;
  std::uint32_t cells = 0;
  for (const PacketSegment& s : segments) {
    ++cells;
    if ((s.s_in < isovalue) != (s.s_out < isovalue)) {
      ASSERT_EQ(hit.cells, cells);
      ASSERT_NEAR(hit.distance,
                  way + s.length * (s.s_in - isovalue) / static_cast<double>(s.s_in - s.s_out),
                  2.4e-7 * (count + 1));
      return;
    }
    way += s.length;
  }
  ASSERT_EQ(hit.cells, count);
  ASSERT_EQ(hit.distance, std::numeric_limits<float>::infinity());
}

void expect_twins(const Case& c) {
  SCOPED_TRACE(c.name);
  const Mesh mesh = generate("box-tetrahedra", {c.size, c.jitter, 5});
  const ScalarField field = select_field(mesh);
  const WalkableTets tets = make_walkable_tets(mesh, field, check_structure(mesh), false);
  const BoundaryIndex<TetWalker> boundary(tets);
  AdversarialRays make_ray(mesh, bounds_of(mesh.points), 31);

  // The twin's first passage of each ray.
  std::vector<std::vector<PacketStart>> starts(3);
  std::vector<std::vector<Segment>> expected;
  for (std::uint64_t i = 0; i < c.rays; ++i) {
    ShearedFrame frame;
    ASSERT_TRUE(frame.set(make_ray(i), tets.frame));
    TetWalker walker(tets, frame);
    const auto entry = Entries<TetWalker>().first(boundary, walker, frame);
    if (!entry) continue;
    walker.enter(tets.boundary[entry->boundary], entry->rank);
    starts[static_cast<std::size_t>(frame.axis())].push_back(
        make_start(tets, frame, tets.boundary[entry->boundary], entry->place,
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
  ASSERT_GT(expected.size(), c.rays / 2);

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
      Starts feeder(starts[static_cast<std::size_t>(axis)]);
      count_cells(tets, axis, feeder, counts);
      feeder.rewind();
      walk_segments(tets, axis, feeder, found);
      feeder.rewind();
      integrate_scalar(tets, axis, feeder, integrals);
      feeder.rewind();
      find_isosurface(tets, axis, isovalue, feeder, hits);
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
      // The measurements: single precision against double. Sums telescope, so that only the ends
      // of the passage count. Where there are no fused products, slivers near the boundary may
      // lose more of it.
      ASSERT_NEAR(sum, twin_sum, 4e-6) << "ray " << ray;
      expect_sums(integrals[ray], hits[ray], mine, isovalue);
    }
  }
  // At least the baseline and something wider; bits of sets that were not compiled fall back on
  // one.
  EXPECT_GE(names.size(), 2u);
}

TEST(TetPackets, TakeTheWayOfTheirTwinThroughCleanCells) { expect_twins({"clean", 10, 0, 20000}); }
TEST(TetPackets, TakeTheWayOfTheirTwinThroughJitteredCells) {
  expect_twins({"jittered", 10, 0.25, 20000});
}
TEST(TetPackets, TakeTheWayOfTheirTwinThroughInvertedCells) {
  expect_twins({"inverted", 10, 3, 20000});
}

TEST(TetPackets, WalkAsFewRaysAsOne) {
  expect_twins({"three rays", 3, 0.2, 3});
  const WalkableTets none;
  Starts nothing({});
  std::vector<std::uint32_t> counts;
  count_cells(none, 0, nothing, counts);
}

// Three coordinates next to zero have a product that single precision does not know.
void expect_needle_measured(double width) {
  SCOPED_TRACE(width);
  Mesh mesh = generate("box-tetrahedra", {1, 0, 1});
  std::vector<double> points;
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    for (std::size_t a = 0; a < 3; ++a)
      points.push_back((mesh.points.at<double>(3 * p + a) - 0.5) * (a == 2 ? 1 : width));
  mesh.points = Array::own(std::move(points));
  const WalkableTets tets =
      make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), false);
  const BoundaryIndex<TetWalker> boundary(tets);
  ShearedFrame frame;
  ASSERT_TRUE(frame.set({{0.1 * width, -0.2 * width, -3}, {0, 0, 1}}, tets.frame));
  TetWalker walker(tets, frame);
  const auto entry = Entries<TetWalker>().first(boundary, walker, frame);
  ASSERT_TRUE(entry);
  const InstructionSets sets;
  for (const std::int64_t target : sets.each) {
    limit_packet_instruction_sets(target);
    SCOPED_TRACE(packet_instruction_set());
    Starts feeder({make_start(tets, frame, tets.boundary[entry->boundary], entry->place, 0)});
    Segments found(1);
    walk_segments(tets, frame.axis(), feeder, found);
    double sum = 0;
    for (const PacketSegment& s : found.of_ray[0]) sum += s.length;
    EXPECT_NEAR(sum, 1, 4e-6);
  }
}

TEST(TetPackets, MeasureANeedleThatTheRayRunsThrough) {
  for (const double width : {1e-8, 1e-14, 1e-16, 1e-18}) expect_needle_measured(width);
}

}  // namespace
}  // namespace plume::test
