// Isosurfaces found through a hierarchy of cells: what a walk finds, bit for bit, or the ray is
// declined.

#include "plume/traverse/cell_search.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "hwy/targets.h"
#include "plume/datasets/generate.h"
#include "plume/mesh/boundary_clusters.h"
#include "plume/mesh/leaf_cells.h"
#include "plume/traverse/leaf_cache.h"
#include "plume/traverse/packets.h"
#include "traced.h"

namespace plume::test {
namespace {

struct SoughtIsovalue {
  float value = 0;
  bool opaque = false;  // nothing behind it matters
};
struct Sought {
  std::vector<SoughtIsovalue> values;
  double connected = 0;
};

bool differ(const Sought& sought, float a, float b) {
  if (!std::isfinite(a) || !std::isfinite(b)) return false;
  for (const SoughtIsovalue& s : sought.values)
    if ((a >= s.value) != (b >= s.value)) return true;
  return false;
}
bool ends_at(const Sought& sought, const Segment& segment) {
  for (const SoughtIsovalue& s : sought.values)
    if (s.opaque && (segment.s_in >= s.value) != (segment.s_out >= s.value)) return true;
  return false;
}

// What a consumer of all segments sees of isosurfaces: the segments that cross one, to the first
// that is opaque. Whether two passages that are connected have one between them.
struct Expected {
  std::vector<Segment> segments;
  bool between = false;
};
Expected walked(const Traced<TetWalker>& traced, const Ray& ray, const Sought& sought) {
  Expected expected;
  double end = -std::numeric_limits<double>::infinity();
  float last = std::numeric_limits<float>::quiet_NaN();
  trace(traced.mesh, traced.boundary, ray, [&](const Segment& segment) {
    if (segment.t_in - end <= sought.connected && differ(sought, last, segment.s_in))
      expected.between = true;
    end = segment.t_out;
    last = segment.s_out;
    if (!differ(sought, segment.s_in, segment.s_out)) return true;
    expected.segments.push_back(segment);
    return !ends_at(sought, segment);
  });
  return expected;
}

struct Tally {
  std::size_t rays = 0, declined = 0, segments = 0;
};

// Rays in bundles, as they come; those of a bundle need have nothing to do with each other.
void expect_as_walked(const Traced<TetWalker>& traced, const std::vector<Ray>& rays,
                      const Sought& sought, Tally& tally, const std::string& which) {
  const CellHierarchy hierarchy = make_cell_hierarchy(traced.mesh);
  LeafCache leaves(traced.mesh, hierarchy);
  std::vector<ShearedFrame> frames(rays.size());
  std::vector<SearchedRay> found(RayBundle::kRays);
  RayBundle bundle;
  std::vector<std::size_t> in_bundle;
  std::vector<ScalarWindow> windows;
  for (const SoughtIsovalue& s : sought.values) windows.push_back({s.value, s.value});
  const SoughtSegments segments{
      windows, [&](const Segment& s) { return ends_at(sought, s) ? 1 : 0; }, 0, sought.connected};
  auto flush = [&] {
    find_segments(leaves, segments, bundle, found);
    for (std::size_t i = 0; i < in_bundle.size(); ++i) {
      const std::string where = which + ", ray " + std::to_string(in_bundle[i]);
      ++tally.rays;
      if (found[i].declined()) {
        ++tally.declined;
        continue;
      }
      const Expected expected = walked(traced, rays[in_bundle[i]], sought);
      ASSERT_FALSE(expected.between) << where;
      // Behind an opaque one there may be more; nobody looks at these.
      std::size_t size = 0;
      for (const Segment& segment : found[i].segments()) {
        ++size;
        if (ends_at(sought, segment)) break;
      }
      ASSERT_EQ(size, expected.segments.size()) << where;
      for (std::size_t s = 0; s < size; ++s) {
        const Segment& a = found[i].segments()[s];
        const Segment& b = expected.segments[s];
        ASSERT_EQ(a.cell, b.cell) << where;
        ASSERT_EQ(a.t_in, b.t_in) << where;
        ASSERT_EQ(a.t_out, b.t_out) << where;
        ASSERT_EQ(a.s_in, b.s_in) << where;
        ASSERT_EQ(a.s_out, b.s_out) << where;
        ++tally.segments;
      }
    }
    bundle.clear();
    in_bundle.clear();
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int sign : {-1, 1})
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (axis == 0 && sign == -1) frames[i].set(rays[i], traced.mesh.frame);
        if (frames[i].axis() != axis || frames[i].sign() != sign) continue;
        if (bundle.full() || !bundle.takes(frames[i])) flush();
        if (testing::Test::HasFatalFailure()) return;
        bundle.add(rays[i], frames[i]);
        in_bundle.push_back(i);
      }
  flush();
}

std::vector<Ray> adversarial(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
  AdversarialRays make_ray(mesh, bounds_of(mesh.points), seed);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) rays.push_back(make_ray(i));
  return rays;
}

Mesh with_values(Mesh mesh, const std::function<float(const std::array<double, 3>&)>& value) {
  std::vector<float> values;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) values.push_back(value(point_at(mesh, p)));
  mesh.fields = {{"made", Association::point, 1, Array::own(std::move(values))}};
  mesh.active_field = "made";
  return mesh;
}

// Opaque, see-through, several, and values that are those of points.
std::vector<Sought> several_sought(const Traced<TetWalker>& traced) {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const WalkablePoint& p : traced.mesh.points) {
    low = std::min(low, p.scalar);
    high = std::max(high, p.scalar);
  }
  const float middle = 0.5f * (low + high), quarter = low + 0.25f * (high - low);
  const float of_point = traced.mesh.points[traced.mesh.points.size() / 3].scalar;
  std::vector<Sought> made{{{{middle, true}}},
                           {{{quarter, false}, {middle, true}}},
                           {{{quarter, false}, {middle, false}}}};
  if (of_point != quarter && of_point != middle) made.push_back({{{of_point, true}}});
  return made;
}

void expect_all_as_walked(const Mesh& mesh, std::size_t rays, const std::string& which,
                          double most_declined) {
  const auto traced = trace_as_tets(mesh);
  const auto list = adversarial(mesh, rays, 11);
  Tally tally;
  for (const Sought& sought : several_sought(traced)) {
    expect_as_walked(traced, list, sought, tally, which);
    if (testing::Test::HasFatalFailure()) return;
  }
  // Where all rays are declined, nothing was found.
  EXPECT_TRUE(tally.segments > 0 || most_declined == 1) << which;
  EXPECT_LE(tally.declined, most_declined * static_cast<double>(tally.rays)) << which;
}

TEST(CellSearch, FindsWhatAWalkFinds) {
  expect_all_as_walked(generate("box-tetrahedra", {12, 0.0, 7}), 3000, "clean", 0.5);
  expect_all_as_walked(generate("box-tetrahedra", {14, 0.2, 7}), 3000, "jittered", 0.5);
  expect_all_as_walked(generate("ball-tetrahedra", {8, 0.1, 7}), 3000, "ball", 0.5);
}

TEST(CellSearch, IsRightOrDeclinesInTangledMeshes) {
  const auto mesh = generate("box-tetrahedra", {10, 3.0, 7});
  expect_all_as_walked(mesh, 3000, "inverted", 1);
  expect_all_as_walked(generate("box-tetrahedra", {10, 0.7, 7}), 3000, "some inverted", 1);
}

TEST(CellSearch, IsRightOrDeclinesInFlatMeshes) {
  auto mesh = generate("box-tetrahedra", {10, 0.2, 7});
  std::vector<double> points(mesh.points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = mesh.points.at<double>(i) * (i % 3 == 2 ? 1e-6 : 1);
  mesh.points = Array::own(std::move(points));
  expect_all_as_walked(mesh, 3000, "flat", 1);
}

// A plateau at the isovalue is above it; a field of NaN here and there has no surface there.
TEST(CellSearch, TakesPlateausAndNotANumber) {
  const auto box = generate("box-tetrahedra", {12, 0.2, 7});
  const auto plateau = with_values(box, [](const auto& p) {
    return p[0] < 0.4 ? 1.0f : p[0] < 0.6 ? 2.0f : 0.5f;
  });
  const auto holes = with_values(box, [](const auto& p) {
    return std::fmod(7 * p[1], 1.0) < 0.2 ? std::numeric_limits<float>::quiet_NaN()
                                          : static_cast<float>(p[0] + p[1]);
  });
  for (const Mesh& mesh : {plateau, holes}) {
    const auto traced = trace_as_tets(mesh);
    Tally tally;
    for (const float value : {1.0f, 2.0f, 0.75f, 0.5f})
      expect_as_walked(traced, adversarial(mesh, 3000, 3), {{{value, true}}}, tally, "plateau");
    EXPECT_GT(tally.segments, 0u);
    EXPECT_LT(tally.declined, tally.rays / 2);
  }
}

// Values around 1 that differ in their last digits: there rounding a scalar decides.
TEST(CellSearch, TakesValuesThatHardlyDiffer) {
  const auto mesh = with_values(generate("box-tetrahedra", {12, 0.2, 7}), [](const auto& p) {
    return 1 + std::round(8 * static_cast<float>(p[0] + 0.3 * p[1])) * 0x1p-23f;
  });
  expect_all_as_walked(mesh, 3000, "hardly", 0.5);
}

TEST(CellSearch, DeclinesFewRaysOfAPicture) {
  const auto mesh = generate("box-tetrahedra", {16, 0.2, 7});
  const auto traced = trace_as_tets(mesh);
  std::vector<Ray> rays;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      Ray ray;
      ray.origin = {-2.0, 0.5, 0.4};
      ray.direction = {1, (x - 31.7) / 90, (y - 31.7) / 90};
      const double length = std::hypot(ray.direction[0], ray.direction[1], ray.direction[2]);
      for (double& d : ray.direction) d /= length;
      rays.push_back(ray);
    }
  Tally tally;
  for (const Sought& sought : several_sought(traced))
    expect_as_walked(traced, rays, sought, tally, "picture");
  EXPECT_GT(tally.segments, 500u);
  EXPECT_LT(tally.declined, tally.rays / 200);
}

TEST(CellSearch, IsTheSameOnEveryInstructionSet) {
  const auto mesh = generate("box-tetrahedra", {12, 0.2, 7});
  const auto traced = trace_as_tets(mesh);
  for (const std::int64_t set : {HWY_AVX3, HWY_AVX2, HWY_SSE4}) {
    if ((hwy::SupportedTargets() & set) == 0) continue;
    limit_packet_instruction_sets(set);
    Tally tally;
    expect_as_walked(traced, adversarial(mesh, 2000, 5), several_sought(traced)[1], tally,
                     packet_instruction_set());
    limit_packet_instruction_sets(0);
    EXPECT_GT(tally.segments, 0u);
  }
}

// All nodes above each face at the boundary have its points in their boxes.
void expect_boundary_held(const WalkableTets& mesh, const ClusterTree& tree) {
  for (std::size_t face = 0; face < mesh.boundary.size(); ++face)
    for (const std::uint32_t point : mesh.boundary[face].loop) {
      std::size_t child = face / kLeafFaces;
      for (std::uint32_t level = 0; level < tree.depth(); ++level) {
        const auto& node = tree.nodes[tree.levels[level] + child / 8];
        EXPECT_LE(node.least[child % 8], node.greatest[child % 8]);
        for (std::size_t a = 0; a < 3; ++a) {
          EXPECT_LE(node.low[a][child % 8], mesh.points[point].position[a]);
          EXPECT_GE(node.high[a][child % 8], mesh.points[point].position[a]);
        }
        child /= 8;
      }
    }
}

// Boxes and ranges hold everything; what is known of a cell is what it is.
TEST(CellHierarchy, HoldsItsCells) {
  for (const int size : {1, 3, 13}) {
    const auto traced = trace_as_tets(generate("box-tetrahedra", {size, 0.4, 7}));
    const WalkableTets& mesh = traced.mesh;
    const CellHierarchy hierarchy = make_cell_hierarchy(mesh);
    EXPECT_LE(static_cast<double>(hierarchy.bytes()),
              4 * static_cast<double>(mesh.cell_count()) + 1024);
    LeafCells cells;
    for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
      const std::size_t leaf = cell / kLeafCells, place = cell % kLeafCells;
      cells.read(mesh, static_cast<std::uint32_t>(leaf));
      const auto points = mesh.points_of(cell);
      for (std::size_t r = 0; r < 4; ++r) {
        const WalkablePoint& p = mesh.points[points[r]];
        EXPECT_EQ(cells.scalar[r][place], p.scalar);
        // All nodes above.
        std::size_t child = leaf;
        for (std::uint32_t level = 0; level < hierarchy.cells.depth(); ++level) {
          const auto& node = hierarchy.cells.nodes[hierarchy.cells.levels[level] + child / 8];
          for (std::size_t a = 0; a < 3; ++a) {
            EXPECT_LE(node.low[a][child % 8], p.position[a]);
            EXPECT_GE(node.high[a][child % 8], p.position[a]);
          }
          EXPECT_LE(node.least[child % 8], p.scalar);
          EXPECT_GE(node.greatest[child % 8], p.scalar);
          child /= 8;
        }
      }
    }
    expect_boundary_held(mesh, hierarchy.boundary);
  }
}

}  // namespace
}  // namespace plume::test
