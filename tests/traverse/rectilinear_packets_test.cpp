// Packets take RectilinearWalker's way, bit for bit, with every instruction set at hand.

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <set>
#include <string>
#include <vector>

#include "packet_sums.h"
#include "plume/traverse/rectilinear_start.h"
#include "rectilinear_meshes.h"

namespace plume::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Hands out rays, each once; those that are not for packets are left out.
class Rays : public PacketFeeder {
 public:
  explicit Rays(const WalkableRectilinear& mesh) : mesh_(mesh) {}

  // The number of a ray that is ready has the next free one.
  RectilinearRay add(const Ray& ray) {
    RectilinearStart& start = starts_.emplace_back();
    const RectilinearRay answer = set_start(start, walkers_.emplace_back(mesh_), mesh_, ray,
                                            static_cast<std::uint32_t>(starts_.size() - 1));
    if (answer == RectilinearRay::ready) return answer;
    starts_.pop_back();
    walkers_.pop_back();
    return answer;
  }
  std::size_t size() const { return starts_.size(); }
  void rewind() { at_ = 0; }
  const PacketStart* next(const PacketStart*) override {
    return at_ < starts_.size() ? &starts_[at_++] : nullptr;
  }

 private:
  const WalkableRectilinear& mesh_;
  std::deque<RectilinearWalker> walkers_;  // starts refer to them
  std::deque<RectilinearStart> starts_;
  std::size_t at_ = 0;
};

std::vector<Segment> segments_of(const WalkableRectilinear& mesh, const Ray& ray) {
  std::vector<Segment> segments;
  const BoundaryIndex<RectilinearWalker> boundary(mesh);
  trace(mesh, boundary, ray, [&](const Segment& segment) {
    segments.push_back(segment);
    return true;
  });
  return segments;
}

// What one ray's packet met, against its twin. A length is the difference of two ways from the
// entry, each rounded to a float; a scalar between 0 and 1 is that of weights that are off by 3
// units in the last place at the most, and by as many roundings of its own.
void expect_segments(const std::vector<PacketSegment>& mine, const std::vector<Segment>& twin,
                     bool on_points) {
  ASSERT_EQ(mine.size(), twin.size());
  for (std::size_t s = 0; s < twin.size(); ++s) {
    ASSERT_EQ(mine[s].cell, twin[s].cell) << "step " << s;
    const double way = twin[s].t_out - twin[0].t_in;
    ASSERT_NEAR(mine[s].length, twin[s].t_out - twin[s].t_in, 0x1p-23 * way) << "step " << s;
    ASSERT_GE(mine[s].length, 0) << "step " << s;
    if (!on_points) continue;
    ASSERT_NEAR(mine[s].s_in, twin[s].s_in, 6e-7) << "step " << s;
    ASSERT_NEAR(mine[s].s_out, twin[s].s_out, 6e-7) << "step " << s;
  }
}

void expect_twins(const GridCase& c, Association association, std::uint64_t rays) {
  SCOPED_TRACE(c.name);
  const Mesh user_mesh = rectilinear(c, association);
  const Bounds bounds = check_structure(user_mesh);
  const WalkableRectilinear mesh = make_walkable_rectilinear(user_mesh, select_field(user_mesh));
  RectilinearRays make_ray(user_mesh, bounds, 3);
  Rays feeder(mesh);
  std::vector<std::vector<Segment>> expected;
  for (std::uint64_t i = 0; i < rays; ++i) {
    Ray ray = make_ray(i);
    ray.t_min = -kInfinity;
    std::vector<Segment> segments = segments_of(mesh, ray);
    ASSERT_EQ(feeder.add(ray), segments.empty() ? RectilinearRay::misses : RectilinearRay::ready);
    if (!segments.empty()) expected.push_back(std::move(segments));
  }
  ASSERT_EQ(expected.size(), feeder.size());
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
    const float isovalue = association == Association::point ? 0.5f : -1;
    feeder.rewind();
    count_cells(mesh, feeder, counts);
    feeder.rewind();
    walk_segments(mesh, feeder, found);
    feeder.rewind();
    integrate_scalar(mesh, feeder, integrals);
    feeder.rewind();
    find_isosurface(mesh, isovalue, feeder, hits);
    for (std::size_t ray = 0; ray < expected.size(); ++ray) {
      SCOPED_TRACE("ray " + std::to_string(ray));
      ASSERT_EQ(counts[ray], expected[ray].size());
      expect_segments(found.of_ray[ray], expected[ray], association == Association::point);
      expect_sums(integrals[ray], hits[ray], found.of_ray[ray], isovalue, c.scale);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_GE(names.size(), 2u);  // the baseline and something wider
}

const GridCase kCases[] = {{"regular", {8, 8, 8}},
                           {"uneven", {7, 5, 11}, 0.9},
                           {"one cell", {1, 1, 1}},
                           {"flat", {16, 1, 3}, 0.5, 2},
                           {"descending", {6, 9, 4}, 0.7, 7},
                           {"one axis descending", {6, 9, 4}, 0.7, 2},
                           {"tiny", {8, 7, 6}, 0.5, 4, 1e-9},
                           {"huge", {8, 7, 6}, 0.5, 5, 1e9},
                           {"shifted", {8, 7, 6}, 0.5, 3, 1, 1e7},
                           {"long", {300, 200, 2}, 0.9, 1}};

TEST(RectilinearPackets, TakeTheWayOfTheirTwin) {
  for (const GridCase& c : kCases) {
    expect_twins(c, Association::point, 12000);
    if (HasFatalFailure()) return;
  }
}

// Where there are so many values that packets ask ahead.
TEST(RectilinearPackets, TakeTheWayOfTheirTwinThroughManyCells) {
  expect_twins({"many", {90, 80, 75}, 0.5, 2}, Association::point, 3000);
}

TEST(RectilinearPackets, CountAndMeasureCellsWithoutValuesOnPoints) {
  expect_twins({"uneven", {7, 5, 11}, 0.9}, Association::cell, 6000);
}

TEST(RectilinearPackets, WalkAsFewRaysAsOneAndNone) {
  expect_twins({"uneven", {7, 5, 11}, 0.9}, Association::point, 1);
  const WalkableRectilinear none;
  Rays nothing(none);
  std::vector<std::uint32_t> counts;
  count_cells(none, nothing, counts);
}

TEST(RectilinearPackets, DeclineRaysThatStartOrEndInside) {
  const Mesh user_mesh = rectilinear({"regular", {4, 4, 4}});
  const WalkableRectilinear mesh = make_walkable_rectilinear(user_mesh, select_field(user_mesh));
  Rays rays(mesh);
  const Ray along{{-1, 0.3, 0.6}, {1, 0, 0}};
  auto from_to = [&](double t_min, double t_max) {
    Ray ray = along;
    ray.t_min = t_min;
    ray.t_max = t_max;
    return rays.add(ray);
  };
  EXPECT_EQ(from_to(0, kInfinity), RectilinearRay::ready);
  EXPECT_EQ(from_to(1, 2.5), RectilinearRay::ready);
  EXPECT_EQ(from_to(1.1, kInfinity), RectilinearRay::declined);
  EXPECT_EQ(from_to(0, 1.9), RectilinearRay::declined);
  EXPECT_EQ(from_to(0, 0.9), RectilinearRay::misses);
  EXPECT_EQ(from_to(2, kInfinity), RectilinearRay::misses);
}

TEST(RectilinearPackets, AreNotForGridsWithHiddenCells) {
  Mesh user_mesh = rectilinear({"regular", {4, 4, 4}});
  auto walked = [&] {
    return walked_by_packets(make_walkable_rectilinear(user_mesh, select_field(user_mesh)));
  };
  EXPECT_TRUE(walked());
  std::vector<std::uint8_t> hidden(user_mesh.cell_count());
  hidden[5] = 1;
  user_mesh.hidden_cells = Array::own(std::move(hidden));
  EXPECT_FALSE(walked());
}

}  // namespace
}  // namespace plume::test
