// First entries found for sixteen rays at a time are those of single rays, with every instruction
// set.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "adversarial_rays.h"
#include "hwy/targets.h"
#include "plume/datasets/generate.h"
#include "plume/mesh/validate.h"
#include "plume/traverse/boundary.h"
#include "plume/traverse/packets.h"

namespace plume::test {
namespace {

// Of one longest axis, as packets have them, and as they come.
using Groups = std::array<std::vector<Ray>, 4>;

Groups groups_of_rays(const Mesh& mesh) {
  AdversarialRays make_ray(mesh, bounds_of(mesh.points), 17);
  Groups groups;
  for (std::uint64_t i = 0; i < 6000; ++i) {
    const Ray ray = make_ray(i);
    groups[static_cast<std::size_t>(longest_axis(ray.direction))].push_back(ray);
    groups[3].push_back(ray);
  }
  return groups;
}

// Those of each ray by itself, by group.
using Expected = std::array<std::vector<EntryList>, 4>;

template <class Walker>
Expected entries_of_each(const Groups& groups, const typename Walker::Mesh& mesh,
                         const BoundaryIndex<Walker>& boundary) {
  Expected expected;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Ray& ray : groups[g]) {
      ShearedFrame frame;
      EXPECT_TRUE(frame.set(ray, mesh.frame));
      const Walker walker(mesh, frame);
      expected[g].push_back(boundary.next_entries(walker, frame));
    }
  return expected;
}

template <class Walker>
void expect_same_entries(const Groups& groups, const Expected& of_each,
                         const typename Walker::Mesh& mesh, const BoundaryIndex<Walker>& boundary) {
  std::size_t entries = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::vector<Ray>& rays = groups[g];
    std::array<EntryList, FrameLanes::kRays> found;
    for (std::size_t ray = 0; ray < rays.size(); ++ray) {
      const std::size_t i = ray % FrameLanes::kRays;
      if (i == 0) {
        RayLanes lanes;
        for (std::size_t r = ray; r < std::min(ray + FrameLanes::kRays, rays.size()); ++r)
          lanes.add(rays[r]);
        FrameLanes frames;
        frames.set(lanes, mesh.frame);
        boundary.first_entries(frames, found);
      }
      const EntryList& expected = of_each[g][ray];
      ASSERT_EQ(found[i].size, expected.size) << "ray " << ray;
      ASSERT_EQ(found[i].more, expected.more) << "ray " << ray;
      entries += expected.size;
      for (std::uint32_t e = 0; e < expected.size; ++e) {
        ASSERT_EQ(found[i].entries[e].boundary, expected.entries[e].boundary) << "ray " << ray;
        ASSERT_EQ(found[i].entries[e].rank, expected.entries[e].rank) << "ray " << ray;
        ASSERT_EQ(found[i].entries[e].place.z, expected.entries[e].place.z) << "ray " << ray;
        const float scalar = expected.entries[e].place.scalar;
        ASSERT_EQ(found[i].entries[e].place.scalar, scalar) << "ray " << ray;
      }
    }
  }
  EXPECT_GT(entries, 4000u);
}

template <class Walker>
void expect_same_entries(const Mesh& user_mesh, const typename Walker::Mesh& mesh) {
  const BoundaryIndex<Walker> boundary(mesh);
  const Groups groups = groups_of_rays(user_mesh);
  const Expected of_each = entries_of_each<Walker>(groups, mesh, boundary);
  for (std::int64_t all = hwy::SupportedTargets(); all != 0; all &= all - 1) {
    limit_packet_instruction_sets(all & -all);
    SCOPED_TRACE(packet_instruction_set());
    expect_same_entries<Walker>(groups, of_each, mesh, boundary);
  }
  limit_packet_instruction_sets(0);
}

TEST(FirstEntries, AreThoseOfSingleRaysIntoTetrahedra) {
  for (const double jitter : {0.0, 0.25, 3.0}) {
    const Mesh mesh = generate("box-tetrahedra", {6, jitter, 5});
    expect_same_entries<TetWalker>(
        mesh, make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), false));
  }
}

TEST(FirstEntries, AreThoseOfSingleRaysIntoGrids) {
  for (const char* name : {"box-hexahedra", "blunt-body", "o-grid", "sphere"}) {
    SCOPED_TRACE(name);
    Mesh mesh = generate(name, {8, 0.25, 5});
    expect_same_entries<GridWalker>(
        mesh, make_walkable_grid(mesh, select_field(mesh), check_structure(mesh)));
    // Twisted faces at the boundary, too.
    std::vector<std::uint8_t> hidden(mesh.cell_count());
    std::mt19937_64 random(7);
    for (auto& one : hidden) one = random() % 3 == 0;
    mesh.hidden_cells = Array::own(std::move(hidden));
    expect_same_entries<GridWalker>(
        mesh, make_walkable_grid(mesh, select_field(mesh), check_structure(mesh)));
  }
}

TEST(FirstEntries, AreThoseOfSingleRaysIntoCellsOfOtherKinds) {
  for (const char* name : {"box-wedges", "box-mixed", "box-polyhedra", "two-blocks"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = generate(name, {6, 0.25, 5});
    expect_same_entries<CellWalker>(
        mesh, make_walkable_cells(mesh, select_field(mesh), check_structure(mesh), false));
  }
}

}  // namespace
}  // namespace plume::test
