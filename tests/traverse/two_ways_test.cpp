// A tetrahedron all of whose faces wind about the ray has two ways in and two ways out. Exact
// arithmetic knows no such thing (a loop of four edges winds once at most); rounding does, where
// the ray lies in the plane of a sliver. What matters then is that each way in has a way out of its
// own, the same whichever of the walkers asks, and the same backwards.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "hwy/targets.h"
#include "plume/traverse/packets.h"
#include "plume/traverse/tet_walker.h"

namespace plume::test {
namespace {

using Vector = std::array<double, 3>;

// Cell 0 of points 0 to 3, behind each face a neighbour: cell 1 + r, with point 4 + r, lies across
// the face that leaves out point r.
WalkableTets surrounded(const std::array<Vector, 4>& corners) {
  WalkableTets mesh;
  for (const Vector& p : corners) mesh.points.push_back(mesh.frame.local(p[0], p[1], p[2], 0));
  mesh.cells.resize(5);
  for (std::uint32_t r = 0; r < 4; ++r) {
    mesh.points.push_back(mesh.frame.local(r == 0, r == 1, r == 2, 0));
    mesh.cells[0][r] = {1 + r, 4 + r};
    mesh.cells[1 + r] = {{{kNone, 0}, {kNone, 0}, {kNone, 0}, {0, r}}};
  }
  return mesh;
}

// The central cell's faces as if they were the boundary, by the point that they leave out; oriented
// alike, so that each edge is run through once in each direction.
std::array<WalkableTets::Boundary, 4> faces_of_the_cell() {
  return {{{0, 0, {1, 2, 3}}, {0, 1, {0, 3, 2}}, {0, 2, {0, 1, 3}}, {0, 3, {0, 2, 1}}}};
}

// Slivers about a ray: four points in a plane that the ray lies in, but for rounding, on both sides
// of the ray.
class Slivers {
 public:
  struct Sliver {
    Ray ray;
    std::array<Vector, 4> corners;
  };

  // Every second ray runs along an axis through the origin: then shearing does not round, and what
  // rounding the products of coordinates does weighs as much as where the points are.
  Sliver operator()() {
    Sliver made;
    const bool along_axis = random_() % 2 == 0;
    made.ray.origin = along_axis ? Vector{0, 0, 0} : vector(0.3);
    made.ray.direction = along_axis ? Vector{0, 0, 0} : vector(1);
    if (along_axis) made.ray.direction[random_() % 3] = random_() % 2 == 0 ? 1 : -1;
    const Vector across = vector(1);
    for (Vector& corner : made.corners) {
      const double along = 0.3 * uniform(), aside = 0.3 * uniform();
      for (std::size_t a = 0; a < 3; ++a)
        corner[a] = made.ray.origin[a] + along * made.ray.direction[a] + aside * across[a];
    }
    return made;
  }

 private:
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-52 - 1; }  // [-1, 1)
  Vector vector(double size) { return {size * uniform(), size * uniform(), size * uniform()}; }

  std::mt19937_64 random_{4};
};

// One step from a face of the cell: the face by which the ray goes out.
std::uint32_t way_out(const WalkableTets& mesh, const ShearedFrame& frame,
                      const WalkableTets::Boundary& face) {
  TetWalker walker(mesh, frame);
  walker.enter(face, 0);
  EXPECT_EQ(walker.cell(), 0u);
  EXPECT_TRUE(walker.leave());
  EXPECT_TRUE(walker.advance());
  return walker.cell() - 1;
}

class Starts : public PacketFeeder {
 public:
  std::vector<TetStart> starts;
  const PacketStart* next(const PacketStart*) override {
    return at_ < starts.size() ? &starts[at_++] : nullptr;
  }

 private:
  std::size_t at_ = 0;
};

class Cells : public PacketSegmentSink {
 public:
  std::array<std::vector<std::uint32_t>, 4> of_ray;
  void take(const PacketSegment& segment) override { of_ray[segment.ray].push_back(segment.cell); }
};

struct AllInstructionSetsAtTheEnd {
  ~AllInstructionSetsAtTheEnd() { limit_packet_instruction_sets(0); }
};

// Packets that start at all faces at once leave by those of `expected`.
void expect_packets(const WalkableTets& mesh, const ShearedFrame& frame,
                    const std::array<std::uint32_t, 4>& expected) {
  const AllInstructionSetsAtTheEnd restore;
  for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) {
    limit_packet_instruction_sets(all & -all);
    SCOPED_TRACE(packet_instruction_set());
    Starts feeder;
    for (const WalkableTets::Boundary& face : faces_of_the_cell()) {
      const Crossing place = TetWalker(mesh, frame).measure_boundary(face, 1);
      feeder.starts.push_back(make_start(mesh, frame, face, place, 0, face.apex));
    }
    Cells cells;
    walk_segments(mesh, frame.axis(), feeder, cells);
    for (std::uint32_t face = 0; face < 4; ++face) {
      ASSERT_EQ(cells.of_ray[face].size(), 2u);
      ASSERT_EQ(cells.of_ray[face][0], 0u);
      ASSERT_EQ(cells.of_ray[face][1], 1 + expected[face]);
    }
  }
}

TEST(TwoWaysThroughATetrahedron, AreOneToOneAndTheSameForPacketsAndBackwards) {
  const auto faces = faces_of_the_cell();
  Slivers next;
  std::size_t all_wind = 0, twisted = 0;
  for (std::size_t tried = 0; tried < 400000; ++tried) {
    const Slivers::Sliver sliver = next();
    const WalkableTets mesh = surrounded(sliver.corners);
    ShearedFrame frame;
    ASSERT_TRUE(frame.set(sliver.ray, mesh.frame));
    const TetWalker walker(mesh, frame);
    std::array<int, 4> winding;
    int sum = 0, wind = 0;
    for (std::uint32_t face = 0; face < 4; ++face) {
      winding[face] = walker.boundary_winding(faces[face]);
      sum += winding[face];
      wind += winding[face] != 0 ? 1 : 0;
    }
    ASSERT_EQ(sum, 0) << "sliver " << tried;
    ASSERT_TRUE(wind == 0 || wind == 2 || wind == 4) << "sliver " << tried;
    if (wind == 0) continue;

    std::array<std::uint32_t, 4> out{};
    for (std::uint32_t face = 0; face < 4; ++face)
      if (winding[face] != 0) out[face] = way_out(mesh, frame, faces[face]);
    for (std::uint32_t face = 0; face < 4; ++face) {
      if (winding[face] == 0) continue;
      ASSERT_LT(out[face], 4u) << "sliver " << tried;
      // What is a way in is a way out for the ray turned around; turned around, a ray that came in
      // by this face comes back to it. So no two ways in have the same way out.
      ASSERT_EQ(winding[out[face]], -winding[face]) << "sliver " << tried;
      ASSERT_EQ(out[out[face]], face) << "sliver " << tried;
    }
    if (wind < 4) continue;
    ++all_wind;
    SCOPED_TRACE(tried);
    expect_packets(mesh, frame, out);
    if (HasFatalFailure()) return;
    // Of the two pairings that there could be, the one that the points' numbers say.
    const bool first_two_alike = winding[0] == winding[1];
    const std::uint32_t other = first_two_alike ? 1 : winding[0] == winding[2] ? 2 : 3;
    std::uint32_t smallest_out = 1;
    while (smallest_out == other) ++smallest_out;
    ASSERT_EQ(out[0], smallest_out) << "sliver " << tried;
    if (first_two_alike) ++twisted;
  }
  // The search finds what it is for, in more than one arrangement.
  EXPECT_GT(all_wind, 500u);
  EXPECT_GT(twisted, 100u);
}

}  // namespace
}  // namespace plume::test
