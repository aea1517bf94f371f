// Every ray through a rectilinear grid: where it goes, whatever it is aimed at.

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "plume/tests/reference/box_chord.h"
#include "rectilinear_meshes.h"

namespace plume::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Walk {
  TraceResult result;
  std::vector<Segment> segments;
};

struct Traced {
  WalkableRectilinear mesh;
  BoundaryIndex<RectilinearWalker> boundary{mesh};

  explicit Traced(const Mesh& m) : mesh(make_walkable_rectilinear(m, select_field(m))) {
    check_structure(m);
  }
  Walk operator()(const Ray& ray, ScalarOrder order = ScalarOrder::linear) const {
    Walk walk;
    auto keep = [&](const Segment& segment) {
      walk.segments.push_back(segment);
      return true;
    };
    walk.result = trace(mesh, boundary, ray, keep, order);
    return walk;
  }
};

Ray whole(Ray ray) {
  ray.t_min = -kInfinity;
  return ray;
}
Ray reversed(Ray ray) {
  for (double& x : ray.direction) x = -x;
  return ray;
}

// The box's chord; in a plane of the box all of it or nothing, as rectilinear_walker.h promises.
std::array<double, 2> span_by_rule(const Bounds& box, const Ray& ray) {
  for (std::size_t a = 0; a < 3; ++a)
    if (ray.direction[a] == 0 && ray.origin[a] == box.high[a]) return {kInfinity, -kInfinity};
  return reference::box_span(box.low, box.high, ray.origin, ray.direction);
}

// Bit for bit, through vertices, along edges and in planes too: where the one crosses a plane is
// minus where the other does.
void expect_same_way_back(const Walk& forth, const Walk& back, const std::string& which) {
  ASSERT_EQ(forth.segments.size(), back.segments.size()) << which;
  for (std::size_t s = 0; s < forth.segments.size(); ++s) {
    const Segment& there = forth.segments[s];
    const Segment& here = back.segments[back.segments.size() - 1 - s];
    ASSERT_EQ(there.cell, here.cell) << which;
    ASSERT_EQ(there.t_in, -here.t_out) << which;
    ASSERT_EQ(there.t_out, -here.t_in) << which;
  }
}

const GridCase kCases[] = {{"regular", {8, 8, 8}},
                           {"uneven", {7, 5, 11}, 0.9},
                           {"one cell", {1, 1, 1}},
                           {"flat", {16, 1, 3}, 0.5, 2},
                           {"descending", {6, 9, 4}, 0.7, 7},
                           {"micro", {8, 7, 6}, 0.5, 1, 1e-6},
                           {"mega", {8, 7, 6}, 0.5, 2, 1e6},
                           {"tiny", {8, 7, 6}, 0.5, 4, 1e-9},
                           {"huge", {8, 7, 6}, 0.5, 5, 1e9},
                           {"shifted", {8, 7, 6}, 0.5, 3, 1, 1e7}};

// 20,000 rays through each of the ten.
TEST(RectilinearWalker, LosesNoRay) {
  for (const GridCase& c : kCases) {
    const Mesh mesh = rectilinear(c);
    const Bounds bounds = check_structure(mesh);
    const Traced traced(mesh);
    RectilinearRays make_ray(mesh, bounds, 3);
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const Ray ray = whole(make_ray(i));
      const std::string which = c.name + (" ray " + std::to_string(i));
      const Walk walk = traced(ray);
      ASSERT_EQ(walk.result.end, WalkEnd::left) << which;
      ASSERT_EQ(walk.result.cells, walk.segments.size()) << which;
      ASSERT_EQ(walk.result.entries, walk.segments.empty() ? 0u : 1u) << which;
      double sum = 0;
      for (std::size_t s = 0; s < walk.segments.size(); ++s) {
        const Segment& segment = walk.segments[s];
        ASSERT_LE(segment.t_in, segment.t_out) << which;
        ASSERT_LT(segment.cell, mesh.cell_count()) << which;
        sum += segment.t_out - segment.t_in;
        if (s == 0) continue;
        const Segment& before = walk.segments[s - 1];
        ASSERT_EQ(segment.t_in, before.t_out) << which;
        ASSERT_EQ(segment.s_in, before.s_out) << which;
        bool adjacent = false;
        for (std::uint32_t face = 0; face < 6; ++face)
          adjacent = adjacent || traced.mesh.neighbor(before.cell, face) == segment.cell;
        ASSERT_TRUE(adjacent) << which;
      }
      const auto span = span_by_rule(bounds, ray);
      const double chord = std::max(0.0, span[1] - span[0]);
      const double size = std::max(std::abs(span[0]), std::abs(span[1]));
      ASSERT_NEAR(sum, chord, std::isfinite(size) ? 1e-12 * size : 0) << which;
      expect_same_way_back(walk, traced(reversed(ray)), which);
      if (HasFatalFailure()) return;
    }
  }
}

// Where nothing is rounded, as widths and directions are small integers, many rays pass through
// vertices, along edges and in planes.
TEST(RectilinearWalker, TakesTheSameWayBack) {
  Mesh mesh = rectilinear({"", {8, 8, 8}});
  for (unsigned descending = 0; descending < 8; ++descending) {
    for (std::size_t a = 0; a < 3; ++a) {
      std::vector<double> axis{0, 1, 2, 3, 4, 5, 6, 7, 8};
      if ((descending >> a & 1) != 0) std::reverse(axis.begin(), axis.end());
      mesh.axes[a] = Array::own(std::move(axis));
    }
    const Traced traced(mesh);
    std::mt19937_64 random(descending);
    auto integer = [&](int low, int high) {
      return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    std::size_t ties = 0;
    for (int i = 0; i < 5000; ++i) {
      Ray ray;
      for (std::size_t a = 0; a < 3; ++a) {
        ray.origin[a] = integer(-4, 20) * 0.5;
        const int power = integer(-2, 1);
        ray.direction[a] = power < -1           ? 0
                           : integer(0, 1) == 0 ? std::exp2(power)
                                                : -std::exp2(power);
      }
      ray = whole(ray);
      const Walk forth = traced(ray);
      expect_same_way_back(forth, traced(reversed(ray)), "ray " + std::to_string(i));
      if (HasFatalFailure()) return;
      for (const Segment& s : forth.segments) ties += s.t_in == s.t_out ? 1 : 0;
    }
    EXPECT_GT(ties, 1000u);
  }
}

// Every cell clipped for itself: no order, no adjacency.
TEST(RectilinearWalker, FindsTheCellsThatClippingFinds) {
  for (const GridCase& c : kCases) {
    const Mesh mesh = rectilinear(c);
    const Bounds bounds = check_structure(mesh);
    const CellReader cells(mesh);
    std::vector<Bounds> boxes;
    std::vector<std::uint32_t> ids;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      cells.points(cell, ids);
      Bounds box{point_at(mesh, ids[0]), point_at(mesh, ids[0])};
      for (std::size_t a = 0; a < 3; ++a) {
        const double other = point_at(mesh, ids[6])[a];  // the opposite corner
        box.low[a] = std::min(box.low[a], other);
        box.high[a] = std::max(box.high[a], other);
      }
      boxes.push_back(box);
    }
    const Traced traced(mesh);
    RectilinearRays make_ray(mesh, bounds, 5);
    for (std::uint64_t i = 0; i < 600; ++i) {
      const Ray ray = whole(make_ray(i));
      const bool in_a_plane =
          ray.direction[0] == 0 || ray.direction[1] == 0 || ray.direction[2] == 0;
      if (in_a_plane) continue;  // two cells beside the ray would claim it
      const double resolved = 1e-13 * (bounds.diagonal() + std::abs(bounds.center()[0]));
      std::map<std::uint32_t, Segment> found;
      for (const Segment& s : traced(ray).segments)
        if (s.t_out - s.t_in > 100 * resolved) found[s.cell] = s;
      std::size_t expected = 0;
      for (std::uint32_t cell = 0; cell < boxes.size(); ++cell) {
        const auto span =
            reference::box_span(boxes[cell].low, boxes[cell].high, ray.origin, ray.direction);
        if (span[1] - span[0] < 200 * resolved) continue;
        ++expected;
        ASSERT_TRUE(found.contains(cell)) << c.name << " ray " << i << " cell " << cell;
        ASSERT_NEAR(found[cell].t_in, span[0], resolved) << c.name << " ray " << i;
        ASSERT_NEAR(found[cell].t_out, span[1], resolved) << c.name << " ray " << i;
      }
      ASSERT_LE(found.size(), expected + 1) << c.name << " ray " << i;
    }
  }
}

// The same points one by one. Single precision moves the curvilinear grid's planes by some 3e-7 of
// its size, and where they are seen at a cosine of at least 0.1 the crossings by ten times that.
TEST(RectilinearWalker, SeesWhatTheCurvilinearGridSees) {
  Mesh mesh = rectilinear({"", {9, 7, 8}, 0.6, 2});
  std::vector<float> smooth;
  for (std::size_t p = 0; p < mesh.point_count(); ++p) {
    const auto [x, y, z] = point_at(mesh, p);
    smooth.push_back(static_cast<float>(std::sin(3 * x) * std::cos(2 * y) + z * x));
  }
  mesh.fields[0].values = Array::own(std::move(smooth));
  const Bounds bounds = check_structure(mesh);
  const Traced traced(mesh);
  const WalkableGrid grid = make_walkable_grid(with_points(mesh), select_field(mesh), bounds);
  const BoundaryIndex<GridWalker> boundary(grid);
  AdversarialRays make_ray(mesh, bounds, 8);
  std::size_t compared = 0;
  for (std::uint64_t i = 0; i < 6000; ++i) {
    const Ray ray = make_ray(i);
    if (!std::all_of(ray.direction.begin(), ray.direction.end(),
                     [](double d) { return std::abs(d) > 0.1; }))
      continue;
    std::map<std::uint32_t, Segment> theirs;
    double lengths = 0;
    trace(grid, boundary, ray, [&](const Segment& s) {
      if (s.t_out - s.t_in > 2e-5) theirs[s.cell] = s;
      lengths += s.t_out - s.t_in;
      return true;
    });
    for (const Segment& s : traced(ray).segments) {
      lengths -= s.t_out - s.t_in;
      if (s.t_out - s.t_in < 4e-5) continue;
      ASSERT_TRUE(theirs.contains(s.cell)) << i;
      const Segment& other = theirs[s.cell];
      ASSERT_NEAR(s.t_in, other.t_in, 1e-5) << i;
      ASSERT_NEAR(s.t_out, other.t_out, 1e-5) << i;
      ASSERT_NEAR(s.s_in, other.s_in, 2e-5) << i;
      ASSERT_NEAR(s.s_out, other.s_out, 2e-5) << i;
      ++compared;
    }
    ASSERT_NEAR(lengths, 0, 1e-5) << i;
  }
  EXPECT_GT(compared, 10000u);
}

TEST(RectilinearWalker, ResolvesTiesAsItSays) {
  Mesh mesh = rectilinear({"", {2, 2, 2}});
  for (const bool descending : {false, true}) {
    for (Array& axis : mesh.axes)
      axis = Array::own(descending ? std::vector<double>{2, 1, 0} : std::vector<double>{0, 1, 2});
    const Traced traced(mesh);
    // The number of the cell with these lower corners.
    auto cell = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
      const std::uint32_t number = x + 2 * y + 4 * z;
      return descending ? 7 - number : number;
    };
    auto cells = [&](const Ray& ray) {
      std::vector<std::uint32_t> list;
      for (const Segment& s : traced(whole(ray)).segments) list.push_back(s.cell);
      return list;
    };
    using List = std::vector<std::uint32_t>;
    // Along the line in the middle, in planes, on the outside.
    EXPECT_EQ(cells({{1, 1, -5}, {0, 0, 1}}), (List{cell(1, 1, 0), cell(1, 1, 1)}));
    EXPECT_EQ(cells({{1, 1, 5}, {0, 0, -1}}), (List{cell(1, 1, 1), cell(1, 1, 0)}));
    EXPECT_EQ(cells({{0, 0, -5}, {0, 0, 1}}), (List{cell(0, 0, 0), cell(0, 0, 1)}));
    EXPECT_EQ(cells({{2, 1, -5}, {0, 0, 1}}), List{});
    EXPECT_EQ(cells({{1, 2, -5}, {0, 0, 1}}), List{});
    // Diagonals: x before y before z going up, the other way going down.
    EXPECT_EQ(cells({{-1, -1, -1}, {1, 1, 1}}),
              (List{cell(0, 0, 0), cell(1, 0, 0), cell(1, 1, 0), cell(1, 1, 1)}));
    EXPECT_EQ(cells({{3, -1, 0.5}, {-1, 1, 0}}),
              (List{cell(1, 0, 0), cell(1, 1, 0), cell(0, 1, 0)}));
    // What only touches: an edge of the box, a corner of it.
    EXPECT_EQ(cells({{-1, 1, 0.5}, {1, -1, 0}}), List{});
    EXPECT_EQ(cells({{-1, 1, -1}, {1, -1, 1}}), List{});
  }
}

TEST(RectilinearWalker, GridsThatMeetAreSeenOnce) {
  Mesh low = rectilinear({"", {3, 3, 3}}), high = low;
  high.axes[1] = Array::own(std::vector<double>{1, 1.5, 1.75, 2});
  const Traced below(low), above(high);
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    Ray ray{{uniform(), 1, uniform()}, {uniform() - 0.5, 0, uniform() - 0.5}};
    ray.t_min = -kInfinity;
    EXPECT_TRUE(below(ray).segments.empty()) << i;
    EXPECT_FALSE(above(ray).segments.empty()) << i;
  }
}

// An axis that descends is the same axis, its cells counted from the other end.
TEST(RectilinearWalker, DescendsAsItAscends) {
  const GridCase c{"", {6, 5, 7}, 0.8};
  const Mesh up = rectilinear(c);
  for (unsigned flip = 1; flip < 8; ++flip) {
    Mesh down = up;
    for (std::size_t a = 0; a < 3; ++a)
      if ((flip >> a & 1) != 0) {
        auto axis = up.axes[a].visit(
            [](auto values) { return std::vector<double>(values.begin(), values.end()); });
        std::reverse(axis.begin(), axis.end());
        down.axes[a] = Array::own(std::move(axis));
      }
    auto mirrored = [flip](std::size_t i, const std::array<std::size_t, 3>& n) {
      std::array<std::size_t, 3> at{i % n[0], i / n[0] % n[1], i / n[0] / n[1]};
      for (std::size_t a = 0; a < 3; ++a)
        if ((flip >> a & 1) != 0) at[a] = n[a] - 1 - at[a];
      return at[0] + n[0] * (at[1] + n[1] * at[2]);
    };
    std::vector<float> values(up.point_count());
    for (std::size_t p = 0; p < values.size(); ++p)
      values[p] = up.fields[0].values.at<float>(mirrored(p, {7, 6, 8}));
    down.fields[0].values = Array::own(std::move(values));
    const Traced a(up), b(down);
    RectilinearRays make_ray(up, check_structure(up), 6);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Ray ray = whole(make_ray(i));
      const Walk one = a(ray, ScalarOrder::cubic), other = b(ray, ScalarOrder::cubic);
      ASSERT_EQ(one.segments.size(), other.segments.size()) << i;
      for (std::size_t s = 0; s < one.segments.size(); ++s) {
        ASSERT_EQ(one.segments[s].cell, mirrored(other.segments[s].cell, {6, 5, 7})) << i;
        ASSERT_EQ(one.segments[s].t_out, other.segments[s].t_out) << i;
        ASSERT_EQ(one.segments[s].s_out, other.segments[s].s_out) << i;
        ASSERT_EQ(one.segments[s].inner[1], other.segments[s].inner[1]) << i;
      }
    }
  }
}

TEST(RectilinearWalker, SeesTheSegmentsInItsRange) {
  const Mesh mesh = rectilinear({"", {8, 6, 7}, 0.8, 4});
  const Traced traced(mesh);
  RectilinearRays make_ray(mesh, check_structure(mesh), 9);
  std::mt19937_64 random(3);
  auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::size_t seen = 0;
  for (std::uint64_t i = 0; i < 6000; ++i) {
    Ray ray = whole(make_ray(i));
    const Walk all = traced(ray);
    if (all.segments.empty()) continue;
    const double begin = all.segments.front().t_in, end = all.segments.back().t_out;
    ray.t_min = begin + (uniform() - 0.1) * (end - begin);
    ray.t_max = ray.t_min + uniform() * (end - begin);
    // A plane itself, now and then.
    if (i % 3 == 0) ray.t_min = all.segments[i % all.segments.size()].t_in;
    if (i % 5 == 0) ray.t_max = all.segments[i % all.segments.size()].t_out;
    std::vector<Segment> expected;
    for (Segment s : all.segments) {
      // Of zero-length segments there are none at the ends.
      if (!(s.t_out > ray.t_min && s.t_in < ray.t_max)) continue;
      if (ray.t_min < ray.t_max) cut(s, ray.t_min, ray.t_max);
      expected.push_back(s);
    }
    if (!(ray.t_min < ray.t_max)) expected.clear();
    const Walk part = traced(ray);
    ASSERT_EQ(part.segments.size(), expected.size()) << i;
    ASSERT_EQ(part.result.entries, expected.empty() ? 0u : 1u) << i;
    for (std::size_t s = 0; s < expected.size(); ++s, ++seen) {
      ASSERT_EQ(part.segments[s].cell, expected[s].cell) << i;
      ASSERT_EQ(part.segments[s].t_in, expected[s].t_in) << i;
      ASSERT_EQ(part.segments[s].t_out, expected[s].t_out) << i;
      ASSERT_EQ(part.segments[s].s_in, expected[s].s_in) << i;
      ASSERT_EQ(part.segments[s].s_out, expected[s].s_out) << i;
    }
  }
  EXPECT_GT(seen, 10000u);
}

TEST(RectilinearWalker, SeesNoHiddenCell) {
  for (const double share : {0.02, 0.5, 0.98, 1.0}) {
    const Mesh open = rectilinear({"", {8, 6, 7}, 0.8, 1});
    Mesh mesh = open;
    std::mt19937_64 random(4);
    std::vector<std::uint8_t> hidden(mesh.cell_count());
    for (auto& h : hidden) h = static_cast<double>(random() >> 11) * 0x1p-53 < share ? 1 : 0;
    mesh.hidden_cells = Array::own(hidden);
    const Traced traced(mesh), all(open);
    RectilinearRays make_ray(mesh, check_structure(mesh), 9);
    for (std::uint64_t i = 0; i < 4000; ++i) {
      const Ray ray = make_ray(i);
      std::vector<Segment> expected;
      std::uint32_t entries = 0;
      bool inside = false;
      for (const Segment& s : all(ray).segments) {
        const bool visible = hidden[s.cell] == 0;
        if (visible && !inside) ++entries;
        inside = visible;
        if (visible) expected.push_back(s);
      }
      const Walk walk = traced(ray);
      ASSERT_EQ(walk.result.entries, entries) << i;
      ASSERT_EQ(walk.segments.size(), expected.size()) << i;
      for (std::size_t s = 0; s < expected.size(); ++s) {
        ASSERT_EQ(walk.segments[s].cell, expected[s].cell) << i;
        ASSERT_EQ(walk.segments[s].t_in, expected[s].t_in) << i;
        ASSERT_EQ(walk.segments[s].t_out, expected[s].t_out) << i;
        ASSERT_EQ(walk.segments[s].s_in, expected[s].s_in) << i;
        ASSERT_EQ(walk.segments[s].s_out, expected[s].s_out) << i;
      }
    }
  }
}

// Widths from 1e-300 to 1e16 beside each other: planes at the same place as far as a ray can tell.
TEST(RectilinearWalker, PassesCellsOfAnyWidths) {
  Mesh mesh = rectilinear({"", {7, 7, 7}});
  mesh.axes[0] = Array::own(std::vector<double>{-1, 0, 1e-300, 1e-16, 1, 1.5, 2, 1e16});
  mesh.axes[1] = Array::own(std::vector<double>{1e16, 1, 1e-16, 1e-300, 0, -1e-300, -1e-16, -1});
  mesh.axes[2] = Array::own(std::vector<double>{5e-324, 1e-323, 1e-322, 1e-320, 1, 2, 3, 1e3});
  const Bounds bounds = check_structure(mesh);
  const Traced traced(mesh);
  const WalkableRectilinear& grid = traced.mesh;
  std::mt19937_64 random(3);
  auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::size_t seen = 0;
  for (int i = 0; i < 20000; ++i) {
    const Place from{6 * uniform() - 3, 6 * uniform() - 3, 6 * uniform() - 3};
    Place to{uniform() - 0.5, uniform() - 0.5, uniform() - 0.5};
    if (i % 3 == 0)
      for (std::size_t a = 0; a < 3; ++a) to[a] = mesh.axes[a].at<double>(1 + random() % 6);
    const Ray ray = whole(ray_towards(from, to));
    for (const ScalarOrder order : {ScalarOrder::linear, ScalarOrder::cubic}) {
      const Walk walk = traced(ray, order);
      ASSERT_EQ(walk.result.end, WalkEnd::left) << i;
      double sum = 0;
      for (std::size_t s = 0; s < walk.segments.size(); ++s, ++seen) {
        const Segment& segment = walk.segments[s];
        ASSERT_LE(segment.t_in, segment.t_out) << i;
        sum += segment.t_out - segment.t_in;
        for (const float value : {segment.s_in, segment.s_out, segment.inner[0], segment.inner[1]})
          ASSERT_TRUE(value >= 0 && value <= 1) << i << ' ' << value;
        if (s == 0) continue;
        ASSERT_EQ(segment.t_in, walk.segments[s - 1].t_out) << i;
        bool adjacent = false;
        for (std::uint32_t face = 0; face < 6; ++face)
          adjacent = adjacent || grid.neighbor(walk.segments[s - 1].cell, face) == segment.cell;
        ASSERT_TRUE(adjacent) << i;
      }
      const auto span = span_by_rule(bounds, ray);
      const double chord = std::max(0.0, span[1] - span[0]);
      ASSERT_NEAR(sum, chord, 1e-12 * std::max(std::abs(span[0]), std::abs(span[1]))) << i;
    }
  }
  EXPECT_GT(seen, 10000u);
}

TEST(RectilinearWalker, MeetsNothingWithoutADirection) {
  const Traced traced(rectilinear({"", {2, 2, 2}}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::array<double, 3>& d :
       {std::array<double, 3>{0, 0, 0}, {0, nan, 1}, {kInfinity, 0, 1}, {0, 1e-320, 0}})
    EXPECT_TRUE(traced(whole({{0.5, 0.5, 0.5}, d})).segments.empty());
  EXPECT_TRUE(traced(whole({{nan, 0.5, 0.5}, {0, 0, 1}})).segments.empty());
  // A component too small to be divided by is as good as zero.
  EXPECT_EQ(traced(whole({{0.25, 0.25, 0.25}, {1e-320, -1e-310, 1}})).segments.size(), 2u);
}

}  // namespace
}  // namespace plume::test
