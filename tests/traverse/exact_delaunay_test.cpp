// The walk through Delaunay tetrahedra, against one that is decided exactly.
//
// Coordinates are multiples of 2^-20 or 2^-24 in [-1, 1], about a centre of exactly zero, which are
// floats; the ends of rays and their differences are doubles. So walker and oracle are given the
// same numbers, bit for bit.

#include "plume/tests/reference/exact_delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plume/mesh/validate.h"
#include "plume/tests/reference/brute_force.h"
#include "plume/traverse/trace.h"

namespace plume::test {
namespace {

using reference::ExactDelaunay;
using Point = ExactDelaunay::Point;
using Line = ExactDelaunay::Segment;

// By how much rounding may move a point against the ray, in a mesh of half-width one. In the
// sheared frame (sheared_frame.h), where distances are no shorter than in space, half a unit in the
// last place is at most: 6e-8 of the offset (up to 2), 3e-8 of the slope (up to 1, at |z| <= 1),
// 1.2e-7 of point - offset (up to 3), 3e-8 of slope * z, 1.2e-7 of the difference (up to 4), which
// makes 3.6e-7 in y. In x, the products of an edge's ends add 6e-8 of x (up to 4): 6e-7, and 7e-7
// together. Nothing else that the walker decides by is rounded.
constexpr double kRounding = 1e-6;
// What double may add to a length.
constexpr double kTiny = 1e-12;

class Random {
 public:
  explicit Random(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }
  /// In [-size, size], a multiple of 2^-20.
  double coordinate(double size) {
    const double uniform = static_cast<double>(random_() >> 11) * 0x1p-53;
    return on_grid((2 * uniform - 1) * size);
  }
  Point in_cube(double size) { return {coordinate(size), coordinate(size), coordinate(size)}; }
  /// Further than `least` from the centre, no further than `most`.
  Point in_ball(double least, double most) {
    for (;;) {
      const Point p = in_cube(most);
      const double r = std::hypot(p[0], p[1], p[2]);
      if (r > least && r <= most) return p;
    }
  }
  static double on_grid(double x) { return std::round(x * 0x1p20) * 0x1p-20; }

 private:
  std::mt19937_64 random_;
};

// In a ball, and the tips of an octahedron, which fix the bounds. `gather` 0: evenly; else the more
// towards the centre, where cells are then down to 1e-4 and less.
std::vector<Point> scattered(std::size_t count, double gather, std::uint64_t seed) {
  std::set<Point> points;
  for (std::size_t a = 0; a < 3; ++a)
    for (const double tip : {-1.0, 1.0}) {
      Point p{0, 0, 0};
      p[a] = tip;
      points.insert(p);
    }
  Random random(seed);
  while (points.size() < count) {
    Point p = random.in_ball(0, 0.97);
    const double shrink = std::pow(std::hypot(p[0], p[1], p[2]), gather);
    for (double& x : p) x = Random::on_grid(x * shrink);
    points.insert(p);
  }
  return {points.begin(), points.end()};
}

// 17^3 points that fill the cube, those inside moved by up to `shake` in each coordinate. Unmoved,
// any eight neighbours lie on a sphere, and lines and planes hold many points.
std::vector<Point> lattice(double shake, std::uint64_t seed) {
  constexpr int kIntervals = 16;
  Random random(seed);
  std::vector<Point> points;
  for (int i = 0; i <= kIntervals; ++i)
    for (int j = 0; j <= kIntervals; ++j)
      for (int k = 0; k <= kIntervals; ++k) {
        Point p{i / 8.0 - 1, j / 8.0 - 1, k / 8.0 - 1};
        const bool outside = i % kIntervals == 0 || j % kIntervals == 0 || k % kIntervals == 0;
        if (!outside)
          for (double& x : p) x += random.coordinate(shake);
        points.push_back(p);
      }
  return points;
}

// n^3 points of a cubic lattice that is turned at random and rounded to float: planes of the
// lattice hold many slivers, most of them thinner than what rounding moves by two orders of
// magnitude.
std::vector<Point> turned_lattice(int n) {
  // The columns of the rotation by the quaternion (2, 1, -1.4, 1.2).
  constexpr double w = 2, x = 1, y = -1.4, z = 1.2, norm = w * w + x * x + y * y + z * z;
  constexpr std::array<Point, 3> axes{
      {{1 - 2 * (y * y + z * z) / norm, 2 * (x * y + w * z) / norm, 2 * (x * z - w * y) / norm},
       {2 * (x * y - w * z) / norm, 1 - 2 * (x * x + z * z) / norm, 2 * (y * z + w * x) / norm},
       {2 * (x * z + w * y) / norm, 2 * (y * z - w * x) / norm, 1 - 2 * (x * x + y * y) / norm}}};
  std::vector<Point> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        Point p{0, 0, 0};
        for (std::size_t a = 0; a < 3; ++a) {
          p[a] = (2 * i - n + 1) * axes[0][a] + (2 * j - n + 1) * axes[1][a] +
                 (2 * k - n + 1) * axes[2][a];
          p[a] = std::round(p[a] * 0.56 / (n - 1) * 0x1p24) * 0x1p-24;
        }
        points.push_back(p);
      }
  return points;
}

Mesh as_mesh(const ExactDelaunay& exact) {
  std::vector<double> points, x;
  for (const Point& p : exact.points()) {
    points.insert(points.end(), p.begin(), p.end());
    x.push_back(p[0]);
  }
  std::vector<std::int32_t> ids;
  for (const auto& tetrahedron : exact.tetrahedra())
    for (const std::uint32_t id : tetrahedron) ids.push_back(static_cast<std::int32_t>(id));
  Mesh mesh;
  mesh.points = Array::own(std::move(points));
  mesh.cells.types =
      Array::own(std::vector<std::uint8_t>{static_cast<std::uint8_t>(CellType::tetrahedron)});
  mesh.cells.connectivity = Array::own(std::move(ids));
  mesh.fields.push_back({"x", Association::point, 1, Array::own(std::move(x))});
  return mesh;
}

WalkableTets as_walkable(const ExactDelaunay& exact) {
  const Mesh mesh = as_mesh(exact);
  return make_walkable_tets(mesh, select_field(mesh), check_structure(mesh), true);
}

// Lines and pieces of lines, given by exactly representable ends whose difference is one too.
class Lines {
 public:
  Lines(const ExactDelaunay& exact, std::uint64_t seed) : exact_(exact), random_(seed) {}

  /// From outside to outside.
  Line across() { return through(random_.in_ball(0, 1)); }
  /// With one or both ends inside the ball.
  Line piece() {
    Line line{random_.in_ball(0, 0.7), random_.in_ball(0, 0.7)};
    if (random_.below(2) == 0) line.to = random_.in_ball(4, 8);
    return line;
  }

  /// One that meets vertices or edges, of the kind `kind % kDegenerateKinds`.
  static constexpr std::size_t kDegenerateKinds = 8;
  Line degenerate(std::size_t kind) {
    const auto& cell = exact_.tetrahedra()[random_.below(exact_.tetrahedra().size())];
    const std::size_t first = random_.below(4);
    const Point a = exact_.points()[cell[first]], b = exact_.points()[cell[(first + 1) % 4]],
                c = exact_.points()[cell[(first + 2) % 4]],
                d = exact_.points()[cell[(first + 3) % 4]];
    switch (kind % kDegenerateKinds) {
      case 0:
        return through(a);
      case 1:
        return through(combine(a, 0.5, difference(a, b), 0, {}));
      case 2:
        return along(a, difference(a, b));
      case 3: {  // in a face's plane, through the face
        const double i = static_cast<double>(1 + random_.below(3));
        const double j = static_cast<double>(1 + random_.below(4));
        const Point in_face = combine(a, i / 8, difference(a, b), j / 8, difference(a, c));
        const double m = static_cast<double>(random_.below(5)) - 2;
        return along(in_face, combine({0, 0, 0}, m, difference(a, b), 1, difference(a, c)));
      }
      case 4: {
        Point axis{0, 0, 0};
        axis[random_.below(3)] = random_.below(2) == 0 ? 1 : -1;
        return along(a, axis);
      }
      case 5:
        return along(a, difference(a, any_vertex_but(a)));
      case 6: {  // from an edge to the one across
        const Point middle = combine(a, 0.5, difference(a, b), 0, {});
        return along(middle, difference(middle, combine(c, 0.5, difference(c, d), 0, {})));
      }
      default:
        return {a, any_vertex_but(a)};
    }
  }

 private:
  static Point difference(const Point& from, const Point& to) {
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  }
  static Point combine(const Point& p, double s, const Point& u, double t, const Point& v) {
    return {p[0] + s * u[0] + t * v[0], p[1] + s * u[1] + t * v[1], p[2] + s * u[2] + t * v[2]};
  }
  Line through(const Point& p) {
    const Point from = random_.in_ball(4, 8);
    return {from, combine(from, 4, difference(from, p), 0, {})};
  }
  // Scaled by a power of two, so that it ends outside.
  static Line along(const Point& p, const Point& direction) {
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    const double far = std::exp2(std::ceil(std::log2(4 / length)));
    return {combine(p, -far, direction, 0, {}), combine(p, far, direction, 0, {})};
  }
  Point any_vertex_but(const Point& p) {
    for (;;) {
      const Point& q = exact_.points()[random_.below(exact_.points().size())];
      if (q != p) return q;
    }
  }

  const ExactDelaunay& exact_;
  Random random_;
};

struct Tally {
  int rays = 0;
  int generic = 0;      // whose cells are beyond doubt
  int well_placed = 0;  // whose length is
  double worst = 0;     // difference of length among these

  void add(const Tally& other) {
    rays += other.rays;
    generic += other.generic;
    well_placed += other.well_placed;
    worst = std::max(worst, other.worst);
  }
};

void record(const Tally& tally) {
  testing::Test::RecordProperty("rays", tally.rays);
  testing::Test::RecordProperty("generic", tally.generic);
  testing::Test::RecordProperty("well_placed", tally.well_placed);
  testing::Test::RecordProperty("worst_length", std::to_string(tally.worst * 1e9) + "e-9");
}

class Comparison {
 public:
  /// With or without the lengths of rays.
  explicit Comparison(const std::vector<Point>& points, bool lengths = true)
      : lengths_(lengths), exact_(points), mesh_(as_walkable(exact_)), boundary_(mesh_) {
    // The local frame changes no coordinate.
    EXPECT_EQ(mesh_.frame.center, (std::array<double, 3>{0, 0, 0}));
    EXPECT_EQ(mesh_.frame.scale, 1);
    EXPECT_EQ(mesh_.cell_count(), exact_.tetrahedra().size());
    std::set<Point> walkable;
    for (const WalkablePoint& p : mesh_.points)
      walkable.insert({p.position[0], p.position[1], p.position[2]});
    EXPECT_EQ(walkable, std::set<Point>(points.begin(), points.end()));
  }

  const ExactDelaunay& exact() const { return exact_; }
  const Tally& tally() const { return tally_; }

  /// A ray is generic where no rounding of the walker's can change its cells. Those must then be
  /// the same. On any ray, the same must be the cells that no rounding can hide, and there must be
  /// none that no rounding can reach; and the length must be what rounding can make of the true
  /// one.
  void compare(const Line& line) {
    Ray ray;
    ray.origin = line.from;
    for (std::size_t a = 0; a < 3; ++a) {
      ray.direction[a] = line.to[a] - line.from[a];
      ASSERT_EQ(line.from[a] + ray.direction[a], line.to[a]);
    }
    const double length = std::hypot(ray.direction[0], ray.direction[1], ray.direction[2]);
    ray.t_min = 0;
    ray.t_max = 1;  // t counts from one end to the other
    std::vector<std::uint32_t> walked;
    double sum = 0;
    const TraceResult result = trace(mesh_, boundary_, ray, [&](const plume::Segment& segment) {
      walked.push_back(mesh_.original_cell(segment.cell));
      sum += (segment.t_out - segment.t_in) * length;
      return true;
    });
    ASSERT_EQ(result.end, WalkEnd::left);

    const std::vector<std::uint32_t> expected = exact_.cells_along(line);
    const bool generic = exact_.clearance(line, expected) > kRounding;
    if (generic) {
      ASSERT_EQ(walked, expected);
    }
    ASSERT_EQ(deeper(line, walked), deeper(line, expected));
    for (const std::uint32_t cell : walked)
      ASSERT_TRUE(exact_.passes(line, cell, -kRounding)) << "cell " << cell;

    ++tally_.rays;
    tally_.generic += generic ? 1 : 0;
    if (!lengths_) return;
    const double least = exact_.length_in_moved_hull(line, -kRounding);
    const double most = exact_.length_in_moved_hull(line, kRounding);
    const double true_length = exact_.length_in_hull(line);
    ASSERT_GE(sum, least - kTiny) << "true: " << true_length;
    ASSERT_LE(sum, most + kTiny) << "true: " << true_length;
    if (most - least > kWellPlaced) return;
    ++tally_.well_placed;
    tally_.worst = std::max(tally_.worst, std::abs(sum - true_length));
  }

  // A length is well placed where rounding can change it by no more: in and out at more than 20
  // degrees or so.
  static constexpr double kWellPlaced = 12 * kRounding;

 private:
  std::vector<std::uint32_t> deeper(const Line& line,
                                    const std::vector<std::uint32_t>& cells) const {
    std::vector<std::uint32_t> deep;
    for (const std::uint32_t cell : cells)
      if (exact_.passes(line, cell, kRounding)) deep.push_back(cell);
    return deep;
  }

  bool lengths_;
  ExactDelaunay exact_;
  WalkableTets mesh_;
  BoundaryIndex<TetWalker> boundary_;
  Tally tally_;
};

struct Case {
  const char* name;
  std::vector<Point> points;
  bool thin_slivers = false;  // thinner than what rounding moves
};
std::vector<Case> cases() {
  return {{"scattered, 500 points", scattered(500, 0, 1)},
          {"scattered, 5,000 points", scattered(5000, 0, 2)},
          {"scattered, 20,000 points", scattered(20000, 0, 3)},
          {"gathered, 5,000 points", scattered(5000, 2, 4)},
          {"lattice", lattice(0, 5)},
          {"lattice, shaken a little", lattice(4e-6, 6)},
          {"lattice, turned", turned_lattice(17), true}};
}

}  // namespace

TEST(TetWalker, WalksTheCellsThatExactPredicatesFind) {
  Tally total;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    Comparison comparison(c.points);
    Lines lines(comparison.exact(), 31);
    for (int i = 0; i < 1000; ++i) {
      SCOPED_TRACE("ray " + std::to_string(i));
      comparison.compare(i % 4 == 3 ? lines.piece() : lines.across());
      if (HasFatalFailure()) return;
    }
    const Tally& tally = comparison.tally();
    EXPECT_GE(tally.generic, 0.9 * tally.rays);
    EXPECT_GE(tally.well_placed, 0.9 * tally.rays);
    total.add(tally);
  }
  record(total);
}

TEST(TetWalker, WalksTheExactLengthThroughVerticesAndEdges) {
  Tally total;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    Comparison comparison(c.points);
    // The last kind has ends. Along a sliver that holds the ray, up to rounding, any place is where
    // the ray crosses it, so whether that is before an end or behind it is nobody's to say.
    const std::size_t kinds = Lines::kDegenerateKinds - (c.thin_slivers ? 1 : 0);
    Lines lines(comparison.exact(), 32);
    for (std::size_t i = 0; i < 100 * kinds; ++i) {
      SCOPED_TRACE("ray " + std::to_string(i));
      comparison.compare(lines.degenerate(i % kinds));
      if (HasFatalFailure()) return;
    }
    const Tally& tally = comparison.tally();
    EXPECT_EQ(tally.generic, 0);
    EXPECT_GE(tally.well_placed, 0.7 * tally.rays);
    total.add(tally);
  }
  record(total);
}

// The bits come from products of floats. Where a face is seen edge-on they may contradict products
// in double: barycentric coordinates from those, clamped, once put the crossing off the ray by up
// to the face's size, in some two of a thousand such rays.
TEST(TetWalker, WalksTheExactLengthInThePlaneOfThinSlivers) {
  for (const int n : {4, 9, 17}) {
    SCOPED_TRACE("lattice of " + std::to_string(n));
    Comparison comparison(turned_lattice(n));
    Lines lines(comparison.exact(), 34);
    for (std::size_t i = 0; i < 250 * Lines::kDegenerateKinds; ++i) {
      SCOPED_TRACE("ray " + std::to_string(i));
      comparison.compare(lines.degenerate(i));
      if (HasFatalFailure()) return;
    }
  }
}

// The oracle itself: by trying every cell, and by adding up what clipping leaves of each.
TEST(ExactDelaunay, FindsWhatTryingEveryCellFinds) {
  const ExactDelaunay exact(scattered(500, 0, 1));
  std::vector<std::array<Point, 4>> corners;
  for (const auto& cell : exact.tetrahedra())
    corners.push_back({exact.points()[cell[0]], exact.points()[cell[1]], exact.points()[cell[2]],
                       exact.points()[cell[3]]});
  Lines lines(exact, 33);
  for (std::size_t i = 0; i < 60 * Lines::kDegenerateKinds; ++i) {
    SCOPED_TRACE("line " + std::to_string(i));
    const bool across = i % 2 == 0;
    const Line line = across ? lines.across() : lines.degenerate(i / 2);
    std::set<std::uint32_t> passed;
    for (std::uint32_t cell = 0; cell < exact.tetrahedra().size(); ++cell)
      if (exact.passes(line, cell, kRounding)) passed.insert(cell);
    const std::vector<std::uint32_t> along = exact.cells_along(line);
    const std::set<std::uint32_t> found(along.begin(), along.end());
    ASSERT_EQ(found.size(), along.size());
    ASSERT_TRUE(std::includes(found.begin(), found.end(), passed.begin(), passed.end()));
    for (const std::uint32_t cell : along) ASSERT_TRUE(exact.passes(line, cell, -kTiny));
    if (!across) continue;  // in a face's plane, clipping finds the cells on both sides
    Point direction;
    for (std::size_t a = 0; a < 3; ++a) direction[a] = line.to[a] - line.from[a];
    double sum = 0;
    for (const auto& span : reference::clip_tetrahedra(corners, line.from, direction, 0))
      sum += span.t_out - span.t_in;
    ASSERT_NEAR(exact.length_in_hull(line),
                sum * std::hypot(direction[0], direction[1], direction[2]), kTiny);
  }
}

TEST(ExactDelaunay, TellsExactlyWhatTouches) {
  const ExactDelaunay exact({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  // Along an edge, in a side's plane, and next to both by the smallest of steps.
  EXPECT_EQ(exact.length_in_hull({{-1, 0, 0}, {3, 0, 0}}), 1);
  EXPECT_EQ(exact.length_in_hull({{-1, 0, -0x1p-1000}, {3, 0, -0x1p-1000}}), 0);
  EXPECT_EQ(exact.length_in_hull({{-1, 0.25, 0}, {3, 0.25, 0}}), 0.75);
  EXPECT_EQ(exact.length_in_hull({{0.25, 0.25, 0.125}, {0.25, 0.25, 7}}), 0.375);
  EXPECT_EQ(exact.length_in_hull({{1, -1, 0}, {1, 1, 0}}), 0);
  EXPECT_EQ(exact.length_in_hull({{-1, 2, 0}, {2, -1, 0}}), std::sqrt(2.0));
  EXPECT_THROW(ExactDelaunay({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), std::invalid_argument);
  EXPECT_THROW(ExactDelaunay({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}}),
               std::invalid_argument);
}

}  // namespace plume::test
