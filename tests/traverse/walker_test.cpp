// Every ray comes out, whatever it is aimed at and however bad the mesh.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/tests/reference/brute_force.h"
#include "traced.h"

namespace plume::test {
namespace {

Mesh moved(Mesh mesh, double scale, double offset) {
  std::vector<double> points(mesh.points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = mesh.points.at<double>(i) * scale + offset;
  mesh.points = Array::own(std::move(points));
  return mesh;
}

struct Case {
  const char* name;
  double jitter, scale, offset;
};
// Inverted: points moved by up to three cell edges. Shifted: where single precision has one digit.
const Case kCases[] = {{"clean", 0.0, 1, 0},    {"jittered", 0.2, 1, 0},
                       {"inverted", 3.0, 1, 0}, {"shifted", 0.2, 1, 1e7},
                       {"tiny", 0.2, 1e-9, 0},  {"huge and inverted", 3.0, 1e9, 1e9},
                       {"small", 0.2, 1e-6, 0}, {"large", 0.2, 1e6, 0}};

Mesh box(const std::string& name, const Case& c, int size = 12) {
  return moved(generate(name, {size, c.jitter, 7}), c.scale, c.offset);
}

// The mesh with each point put where `place` says.
template <class PlaceOf>
Mesh with_points(Mesh mesh, const PlaceOf& place) {
  std::vector<double> points;
  for (std::size_t p = 0; p < mesh.point_count(); ++p)
    for (const double x : place(p, point_at(mesh, p))) points.push_back(x);
  mesh.points = Array::own(std::move(points));
  return mesh;
}

// Together more than a million rays.
TEST(Walkers, LoseNoRayThroughTetrahedra) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const Mesh mesh = box("box-tetrahedra", c);
    expect_no_ray_lost(trace_as_tets(mesh), mesh, 80000, 11, c.jitter > 0.3);
    if (HasFatalFailure()) return;
  }
}

TEST(Walkers, LoseNoRayThroughAGrid) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const Mesh mesh = box("box-hexahedra", c);
    expect_no_ray_lost(trace_as_grid(mesh), mesh, 30000, 12, c.jitter > 0.3);
    if (HasFatalFailure()) return;
  }
}

TEST(Walkers, LoseNoRayThroughMixedCells) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const Mesh mesh = box("box-mixed", c);
    expect_no_ray_lost(trace_as_cells(mesh), mesh, 10000, 13, c.jitter > 0.3);
    if (HasFatalFailure()) return;
  }
}

TEST(Walkers, LoseNoRayThroughTwistedAndTouchingCells) {
  const Mesh twisted = generate("twisted", {16, 0.2, 1});
  expect_no_ray_lost(trace_as_grid(twisted), twisted, 50000, 14, false);
  const Mesh blocks = generate("two-blocks", {8, 0.2, 1});
  expect_no_ray_lost(trace_as_cells(blocks), blocks, 50000, 15, false);
}

TEST(Walkers, LoseNoRayThroughCellsOfEveryKind) {
  // Hexahedra, wedges, polyhedra; pyramids are among the mixed cells.
  for (const char* name : {"two-blocks", "box-wedges", "box-polyhedra", "box-mixed"})
    for (const Case& c : kCases) {
      SCOPED_TRACE(std::string(name) + ", " + c.name);
      const Mesh mesh = box(name, c, 6);
      expect_no_ray_lost(trace_as_cells(mesh), mesh, 4000, 16, c.jitter > 0.3);
      if (HasFatalFailure()) return;
    }
}

TEST(Walkers, LoseNoRayInTheOtherFormsOfAGrid) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    const Mesh mesh = box("box-hexahedra", c, 8);
    expect_no_ray_lost(trace_as_grid<HybridGridWalker>(mesh), mesh, 8000, 18, c.jitter > 0.3);
    expect_no_ray_lost(trace_as_grid<PluckerGridWalker>(mesh), mesh, 8000, 19, c.jitter > 0.3);
    if (HasFatalFailure()) return;
  }
}

// Boxes of hexahedra with faces and cells that have no area or volume, or are inside out.
std::vector<std::pair<const char*, Mesh>> degenerate_boxes() {
  constexpr int kSize = 6;
  const auto lattice = [](double x) { return std::round(x * kSize); };
  std::vector<std::pair<const char*, Mesh>> meshes;
  // Points on a lattice: edges, faces and whole cells collapse, and points coincide.
  meshes.emplace_back(
      "snapped",
      with_points(generate("box-hexahedra", {kSize, 0.8, 3}), [&](std::size_t, const Place& p) {
        return Place{lattice(p[0]) / kSize, lattice(p[1]) / kSize, lattice(p[2]) / kSize};
      }));
  // Every second layer of points lies on the one below.
  meshes.emplace_back(
      "flat layers",
      with_points(generate("box-hexahedra", {kSize, 0, 1}), [&](std::size_t, const Place& p) {
        const double layer = lattice(p[2]);
        const bool down = std::fmod(layer, 2) == 1;
        return Place{p[0], p[1], down ? (layer - 1) / kSize : p[2]};
      }));
  // A corner pushed past the middle of a cell, which becomes concave.
  meshes.emplace_back("dented", with_points(generate("box-hexahedra", {3, 0, 1}),
                                            [](std::size_t i, const Place& p) {
                                              return i == 21 ? Place{0.52, 0.54, 0.5} : p;
                                            }));
  // Two points that are joined by an edge change places: the faces at that edge become bow-ties.
  meshes.emplace_back(
      "bow-ties",
      with_points(generate("box-hexahedra", {3, 0, 1}), [](std::size_t i, const Place& p) {
        const double other = 1 - p[0];
        return i == 21 || i == 22 ? Place{other, p[1], p[2]} : p;
      }));
  return meshes;
}

TEST(Walkers, LoseNoRayThroughCollapsedConcaveAndTangledHexahedra) {
  for (const auto& [name, mesh] : degenerate_boxes()) {
    SCOPED_TRACE(name);
    expect_no_ray_lost(trace_as_grid(mesh), mesh, 20000, 22, true);
    expect_no_ray_lost(trace_as_grid<PluckerGridWalker>(mesh), mesh, 10000, 23, true);
    expect_no_ray_lost(trace_as_grid<HybridGridWalker>(mesh), mesh, 10000, 24, true);
    expect_no_ray_lost(trace_as_cells(mesh), mesh, 10000, 25, true);
    if (HasFatalFailure()) return;
  }
}

// A convex prism or a convex ball: what is covered is one interval (but for `gap`), though the seam
// is left and entered again. Segments never overlap.
template <class Walker>
void expect_one_interval(const Traced<Walker>& traced, const Mesh& mesh, double gap) {
  AdversarialRays make_ray(mesh, bounds_of(mesh.points), 17);
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Walk walk = traced(make_ray(i));
    ASSERT_EQ(walk.result.end, WalkEnd::left) << "ray " << i;
    for (std::size_t s = 1; s < walk.segments.size(); ++s) {
      const double apart = walk.segments[s].t_in - walk.segments[s - 1].t_out;
      ASSERT_GE(apart, 0) << "ray " << i;
      ASSERT_LE(apart, gap) << "ray " << i;
    }
  }
}

TEST(Walkers, PassAPoleAndASeam) {
  for (const char* name : {"o-grid", "sphere"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = generate(name, {8, 0.2, 1});
    expect_one_interval(trace_as_grid(mesh), mesh, 0);
    expect_one_interval(trace_as_grid<HybridGridWalker>(mesh), mesh, 0);
    expect_one_interval(trace_as_grid<PluckerGridWalker>(mesh), mesh, 0);
    // Here the two faces at a seam are measured from different corners.
    expect_one_interval(trace_as_cells(mesh), mesh, 1e-12);
  }
}

TEST(TetWalker, FindsTheCellsThatClippingFinds) {
  const Mesh mesh = generate("box-tetrahedra", {5, 0.25, 3});
  std::vector<std::array<std::array<double, 3>, 4>> corners(mesh.cell_count());
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (std::size_t v = 0; v < 4; ++v)
      corners[c][v] = point_at(mesh, mesh.cells.connectivity.at<std::size_t>(4 * c + v));
  const auto traced = trace_as_tets(mesh);
  AdversarialRays make_ray(mesh, bounds_of(mesh.points), 5);
  constexpr double kShort = 1e-5;  // spans that rounding may add or take away
  for (std::uint64_t i = 0; i < 600; ++i) {
    const Ray ray = make_ray(6 * i);  // a random one
    const auto expected = reference::clip_tetrahedra(corners, ray.origin, ray.direction, kShort);
    std::vector<Segment> found;
    for (const Segment& s : traced(ray).segments)
      if (s.t_out - s.t_in > kShort) found.push_back(s);
    std::size_t at = 0;
    for (const auto& span : expected) {
      if (span.t_out - span.t_in < 2 * kShort) continue;
      while (at < found.size() && traced.mesh.original_cell(found[at].cell) != span.cell) ++at;
      ASSERT_LT(at, found.size()) << "ray " << i << " misses cell " << span.cell;
      // Single precision moves the ray by some 3e-7 against a mesh of size one.
      ASSERT_NEAR(found[at].t_in, span.t_in, 3e-7 / span.cosine_in) << "ray " << i;
      ASSERT_NEAR(found[at].t_out, span.t_out, 3e-7 / span.cosine_out) << "ray " << i;
    }
    ASSERT_LE(found.size(), expected.size() + 2) << "ray " << i;
  }
}

TEST(Walkers, SeeALinearFieldAsItIs) {
  struct Form {
    const char* name;
    bool grid;
  };
  for (const Form& form :
       {Form{"box-tetrahedra", false}, Form{"box-hexahedra", true}, Form{"box-mixed", false},
        Form{"box-polyhedra", false}, Form{"box-wedges", false}}) {
    SCOPED_TRACE(form.name);
    Mesh mesh = generate(form.name, {6, 0.2, 2});
    mesh.active_field = "linear";
    AdversarialRays make_ray(mesh, bounds_of(mesh.points), 9);
    auto check = [&](const auto& traced) {
      for (std::uint64_t i = 0; i < 3000; ++i) {
        const Ray ray = make_ray(i);
        for (const Segment& s : traced(ray).segments) {
          auto field = [&](double t) {
            return ray.origin[0] + t * ray.direction[0] +
                   2 * (ray.origin[1] + t * ray.direction[1]) +
                   3 * (ray.origin[2] + t * ray.direction[2]);
          };
          ASSERT_NEAR(s.s_in, field(s.t_in), 1e-5) << "ray " << i;
          ASSERT_NEAR(s.s_out, field(s.t_out), 1e-5) << "ray " << i;
        }
      }
    };
    if (form.grid)
      check(trace_as_grid(mesh));
    else if (std::string(form.name) == "box-tetrahedra")
      check(trace_as_tets(mesh));
    else
      check(trace_as_cells(mesh));
  }
}

TEST(Walkers, StartInsideWhereTheRayStarts) {
  const Mesh mesh = generate("box-tetrahedra", {6, 0.2, 2});
  const auto traced = trace_as_tets(mesh);
  AdversarialRays make_ray(mesh, bounds_of(mesh.points), 21);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    Ray ray = make_ray(6 * i);
    const double middle = 2 * bounds_of(mesh.points).diagonal();  // the ray's target is inside
    const Walk whole = traced(ray);
    if (whole.segments.empty()) continue;
    const double begin = whole.segments.front().t_in, end = whole.segments.back().t_out;
    const double start = begin + 0.3 * (end - begin), stop = begin + 0.8 * (end - begin);
    ray.t_min = start;
    ray.t_max = stop;
    const Walk part = traced(ray);
    ASSERT_NEAR(part.sum(), stop - start, 1e-9 * middle) << "ray " << i;
    ASSERT_EQ(part.segments.front().t_in, start);
    ASSERT_EQ(part.segments.back().t_out, stop);
  }
}

TEST(Walkers, MeetNothingWithoutADirection) {
  const Mesh mesh = generate("box-tetrahedra", {2, 0, 1});
  const auto traced = trace_as_tets(mesh);
  Ray ray{{0.5, 0.5, -1}, {0, 0, 0}};
  EXPECT_TRUE(traced(ray).segments.empty());
  ray.direction = {0, std::numeric_limits<double>::quiet_NaN(), 1};
  EXPECT_TRUE(traced(ray).segments.empty());
  ray.direction = {0, 0, 1};
  EXPECT_FALSE(traced(ray).segments.empty());
}

}  // namespace
}  // namespace plume::test
