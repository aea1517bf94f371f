// Twisted and concave faces are crossed as often as they are: what each cell is seen to hold of a
// ray is what intersecting all its faces says, above all where the ray grazes them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "plume/datasets/generate.h"
#include "plume/tests/reference/cell_distance.h"
#include "plume/tests/traverse/cell_loops.h"
#include "plume/tests/traverse/traced.h"

namespace plume::test {
namespace {

using reference::CellLoops;
using Vector = std::array<double, 3>;

// Rays that touch a face's patch, or nearly: in the tangent plane of a place on it, then moved off
// the patch by a ten-millionth to a tenth of the face's size. Every fourth is any ray.
class SilhouetteRays {
 public:
  SilhouetteRays(const Mesh& mesh, const std::vector<CellLoops>& cells, std::uint64_t seed)
      : cells_(cells), spots_(mesh, bounds_of(mesh.points), seed) {}

  Ray operator()(std::uint64_t i) {
    Ray ray = i % 4 == 0 ? any() : grazing();
    ray.t_min = -std::numeric_limits<double>::infinity();
    return ray;
  }

 private:
  Ray any() {
    const Place from = spots_.around();
    return ray_towards(from, spots_.inside());
  }
  Ray grazing() {
    for (;;) {
      const CellLoops& cell = cells_[spots_.below(cells_.size())];
      const auto& p = cell[spots_.below(cell.size())];
      if (p.size() != 4) continue;
      const double u = spots_.uniform(), v = spots_.uniform(), angle = 6.3 * spots_.uniform();
      const double off =
          std::pow(10.0, -1 - 6 * spots_.uniform()) * (spots_.below(2) == 0 ? 1.0 : -1.0);
      Vector at, along_u, along_v, direction;
      for (std::size_t a = 0; a < 3; ++a) {
        at[a] = (1 - u) * (1 - v) * p[0][a] + u * (1 - v) * p[1][a] + u * v * p[2][a] +
                (1 - u) * v * p[3][a];
        along_u[a] = (1 - v) * (p[1][a] - p[0][a]) + v * (p[2][a] - p[3][a]);
        along_v[a] = (1 - u) * (p[3][a] - p[0][a]) + u * (p[2][a] - p[1][a]);
        direction[a] = std::cos(angle) * along_u[a] + std::sin(angle) * along_v[a];
      }
      const double length = std::hypot(direction[0], direction[1], direction[2]);
      if (length == 0) continue;
      const Vector normal{along_u[1] * along_v[2] - along_u[2] * along_v[1],
                          along_u[2] * along_v[0] - along_u[0] * along_v[2],
                          along_u[0] * along_v[1] - along_u[1] * along_v[0]};
      const double area = std::hypot(normal[0], normal[1], normal[2]);
      if (area == 0) continue;
      Ray ray;
      for (std::size_t a = 0; a < 3; ++a) {
        ray.origin[a] = at[a] + off * normal[a] / std::sqrt(area);
        ray.direction[a] = direction[a] / length;
      }
      return ray;
    }
  }

  const std::vector<CellLoops>& cells_;
  MeshSpots spots_;
};

struct Compared {
  std::size_t grazes = 0;     // patches crossed twice, once for each cell
  std::size_t reentries = 0;  // rays that come in through the boundary more than once
  std::size_t different = 0;  // rays of which some cell holds another length
  double worst = 0;           // how far outside of the range, in the mesh's diagonals
};

// Rounding of the vertices, of the ray and of shearing moves the ray against the mesh by up to
// 5e-7 of its diagonal. What rays within that distance see of a cell is therefore right; on top of
// it, a millionth for where the range is not seen whole by the nine rays that make it up.
constexpr double kMoved = 5e-7, kSlack = 1e-6;

template <class Walker>
Compared compare(const Traced<Walker>& traced, const Mesh& mesh,
                 const std::vector<CellLoops>& cells, std::uint64_t rays, std::uint64_t seed) {
  const double diagonal = bounds_of(mesh.points).diagonal();
  const auto patches = loops_of(mesh);
  SilhouetteRays make_ray(mesh, patches, seed);
  Compared result;
  for (std::uint64_t i = 0; i < rays; ++i) {
    const Ray ray = make_ray(i);
    const auto expected =
        reference::line_length_range(cells, ray.origin, ray.direction, kMoved * diagonal);
    result.grazes += expected.grazes;
    const Walk walk = traced(ray);
    EXPECT_EQ(walk.result.end, WalkEnd::left) << "ray " << i;
    if (walk.result.entries > 1) ++result.reentries;
    auto lengths = [&](const Walk& of) {
      std::vector<double> length(cells.size(), 0.0);
      for (const Segment& s : of.segments)
        length[traced.mesh.original_cell(s.cell)] += s.t_out - s.t_in;
      return length;
    };
    const std::vector<double> length = lengths(walk);
    Ray back = ray;
    for (double& x : back.direction) x = -x;
    const Walk reversed = traced(back);
    EXPECT_EQ(reversed.result.entries, walk.result.entries) << "ray " << i;
    const std::vector<double> length_back = lengths(reversed);
    for (std::size_t c = 0; c < cells.size(); ++c)
      EXPECT_NEAR(length_back[c], length[c], 1e-9 * diagonal) << "ray " << i << ", cell " << c;
    double worst = 0;
    for (std::size_t c = 0; c < cells.size(); ++c)
      worst = std::max({worst, (expected.low[c] - length[c]) / diagonal,
                        (length[c] - expected.high[c]) / diagonal});
    result.worst = std::max(result.worst, worst);
    if (worst > kSlack) ++result.different;
  }
  return result;
}

// The mesh with its coordinates as `change` leaves them.
template <class Change>
Mesh changed(Mesh mesh, const Change& change) {
  std::vector<double> points(mesh.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = mesh.points.at<double>(i);
  change(points);
  mesh.points = Array::own(std::move(points));
  return mesh;
}

// A box of 3 x 3 x 3 hexahedra, one inner point of which is pushed past the middle of the cell in
// the centre: that cell is concave, and all faces around the point are twisted.
Mesh dented() {
  return changed(generate("box-hexahedra", {3, 0, 1}), [](std::vector<double>& points) {
    const std::size_t point = 1 + 4 * (1 + 4);
    points[3 * point] = 0.52;
    points[3 * point + 1] = 0.54;
    points[3 * point + 2] = 0.5;
  });
}

// All points moved by up to a quarter of an edge, those on the boundary too.
Mesh bumpy(Mesh mesh, double edge) {
  return changed(std::move(mesh), [edge](std::vector<double>& points) {
    std::mt19937_64 random(6);
    for (double& x : points)
      x += 0.5 * edge * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
  });
}

// Turned about an axis of no special direction: no coordinate is without rounding any more.
Mesh turned(Mesh mesh) {
  return changed(std::move(mesh), [](std::vector<double>& points) {
    for (std::size_t p = 0; p < points.size(); p += 3) {
      const Vector q{points[p], points[p + 1], points[p + 2]};
      constexpr double c = 0.8, s = 0.6;
      const Vector r{c * q[0] - s * q[1], s * q[0] + c * q[1], q[2]};
      points[p] = r[0];
      points[p + 1] = c * r[1] - s * r[2];
      points[p + 2] = s * r[1] + c * r[2];
    }
  });
}

void expect_as_the_reference(const Compared& compared, std::size_t least_grazes,
                             const std::string& which) {
  EXPECT_GE(compared.grazes, least_grazes) << which;
  EXPECT_EQ(compared.different, 0u) << which << ": worst " << compared.worst;
}

struct Source {
  const char* name;
  Mesh mesh;
};

TEST(TwistedFaces, OfGridsHoldWhatTheReferenceSays) {
  for (const Source& source :
       {Source{"twisted", generate("twisted", {4, 0, 1})},
        Source{"jittered", generate("box-hexahedra", {4, 0.25, 3})}, Source{"dented", dented()},
        Source{"axis", generate("o-grid", {2, 0, 1})},
        Source{"poles", generate("sphere", {2, 0, 1})}}) {
    const auto cells = loops_of(source.mesh);
    const bool collapsed = source.mesh.dimensions[0] != source.mesh.dimensions[1];
    const std::size_t grazes = collapsed ? 0 : 150;  // their faces are planar
    expect_as_the_reference(compare(trace_as_grid(source.mesh), source.mesh, cells, 1500, 31),
                            grazes, source.name);
    expect_as_the_reference(compare(trace_as_cells(source.mesh), source.mesh, cells, 1500, 32),
                            grazes, source.name);
  }
}
// Rays from a corner or the middle of a twisted face's edge to another edge of it run beside the
// patch that spans it and meet it at both ends, where edges decide. What is taken for the inside of
// a cell is there, or as near as rounding puts the ray.
//
// One ray in a thousand is on the other side of the face: an edge's bit comes from products in
// single precision, and may say another thing than the patch where the ray runs through the edge.
TEST(TwistedFaces, PutRaysBetweenTheirEdgesIntoTheRightCell) {
  auto wrong_rays = [](const auto& traced, const Mesh& mesh) {
    constexpr int kRays = 1000;
    const double near = (kMoved + kSlack) * bounds_of(mesh.points).diagonal();
    const auto cells = loops_of(mesh);
    MeshSpots spots(mesh, bounds_of(mesh.points), 41);
    int wrong = 0;
    for (int i = 0; i < kRays; ++i) {
      const CellLoops& cell = cells[spots.below(cells.size())];
      const auto& face = cell[spots.below(cell.size())];
      const std::size_t from = spots.below(face.size()), n = face.size();
      const double share = 0.25 * static_cast<double>(1 + spots.below(3));
      Place start = face[from], end;
      if (i % 2 == 1) start = middle(start, face[(from + n - 1) % n]);
      for (std::size_t a = 0; a < 3; ++a)
        end[a] = (1 - share) * face[(from + 1) % n][a] + share * face[(from + 2) % n][a];
      Ray ray = ray_towards(start, end);
      ray.t_min = -std::numeric_limits<double>::infinity();
      const Walk walk = traced(ray);
      const bool is_wrong =
          std::any_of(walk.segments.begin(), walk.segments.end(), [&](const Segment& s) {
            const double t = 0.5 * (s.t_in + s.t_out);
            Place place;
            for (std::size_t a = 0; a < 3; ++a) place[a] = ray.origin[a] + t * ray.direction[a];
            return s.t_out - s.t_in > near &&
                   reference::distance_outside(cells[traced.mesh.original_cell(s.cell)], place) >
                       near;
          });
      wrong += is_wrong ? 1 : 0;
    }
    return wrong;
  };
  for (const Mesh& mesh :
       {generate("twisted", {4, 0, 1}), dented(), generate("box-hexahedra", {4, 0.2, 7})}) {
    EXPECT_LE(wrong_rays(trace_as_grid(mesh), mesh), 3);
    EXPECT_LE(wrong_rays(trace_as_cells(mesh), mesh), 3);
  }
  const Mesh mixed = generate("box-mixed", {4, 0.2, 7});
  EXPECT_LE(wrong_rays(trace_as_cells(mixed), mixed), 3);
}

// A grazed face of the boundary is a way in and a way out.
TEST(TwistedFaces, OfTheBoundaryHoldWhatTheReferenceSays) {
  const Mesh grid = bumpy(generate("box-hexahedra", {2, 0, 1}), 0.5);
  const auto cells = loops_of(grid);
  for (const Compared& compared : {compare(trace_as_grid(grid), grid, cells, 2000, 37),
                                   compare(trace_as_cells(grid), grid, cells, 2000, 38)}) {
    expect_as_the_reference(compared, 500, "grid");
    EXPECT_GT(compared.reentries, 100u);
  }
  const Mesh prisms = bumpy(generate("box-polyhedra", {2, 0, 1}), 0.25);
  const Compared compared = compare(trace_as_cells(prisms), prisms, loops_of(prisms), 2000, 39);
  expect_as_the_reference(compared, 500, "polyhedra");
  EXPECT_GT(compared.reentries, 100u);
}

// Planar faces take a path of their own, to the cells and the places that patches lead to.
TEST(PlanarFaces, AreMeasuredAsPatchesAre) {
  for (const Mesh& mesh :
       {generate("box-hexahedra", {5, 0, 1}), turned(generate("box-hexahedra", {5, 0, 1})),
        generate("o-grid", {3, 0, 1}), generate("sphere", {3, 0, 1})}) {
    const auto planar = trace_as_grid(mesh);
    ASSERT_EQ(planar.mesh.twisted.cell_count(), 0u);
    const auto patches = trace_as_grid<HybridGridWalker>(mesh);
    const Bounds bounds = bounds_of(mesh.points);
    AdversarialRays make_ray(mesh, bounds, 40);
    for (std::uint64_t i = 0; i < 5000; ++i) {
      // Any ray but those in the plane of a face, all of which is then as right a place.
      const Ray ray = make_ray(6 * i);
      const Walk walk = planar(ray), expected = patches(ray);
      ASSERT_EQ(walk.segments.size(), expected.segments.size()) << "ray " << i;
      for (std::size_t s = 0; s < walk.segments.size(); ++s) {
        ASSERT_EQ(walk.segments[s].cell, expected.segments[s].cell) << "ray " << i;
        // The term left out is 2^-24 of v; both are far below what rounding the vertices does.
        ASSERT_NEAR(walk.segments[s].t_out, expected.segments[s].t_out, 2e-7 * bounds.diagonal());
        ASSERT_NEAR(walk.segments[s].s_out, expected.segments[s].s_out, 3e-7);
      }
    }
  }
}

TEST(TwistedFaces, OfOtherCellsHoldWhatTheReferenceSays) {
  for (const char* name : {"box-wedges", "box-mixed", "box-polyhedra"}) {
    const Mesh mesh = generate(name, {4, 0.25, 3});
    expect_as_the_reference(compare(trace_as_cells(mesh), mesh, loops_of(mesh), 1500, 33), 500,
                            name);
  }
}

TEST(TwistedFaces, CutIntoTrianglesHoldWhatTheReferenceSays) {
  for (const Mesh& mesh : {generate("twisted", {4, 0, 1}), dented()})
    expect_as_the_reference(
        compare(trace_as_grid<PluckerGridWalker>(mesh), mesh, triangles_of(mesh), 1500, 34), 0,
        "triangles");
}

// The two forms to compare with are told from the patch with all its crossings, so the tests above
// would notice.
TEST(TwistedFaces, AreSeenOtherwiseByTheOtherForms) {
  const Mesh mesh = generate("twisted", {4, 0, 1});
  const auto cells = loops_of(mesh);
  EXPECT_GT(compare(trace_as_grid<HybridGridWalker>(mesh), mesh, cells, 500, 35).different, 50u);
  EXPECT_GT(compare(trace_as_grid<PluckerGridWalker>(mesh), mesh, cells, 500, 36).different, 50u);
}

// Four corners anywhere, the ray being the z axis: crossings in either direction as the reference
// finds them by bisection.
TEST(QuadCrossings, AreThoseOfTheBilinearPatch) {
  std::mt19937_64 random(5);
  auto uniform = [&] { return static_cast<float>(random() >> 40) * 0x1p-23f - 1; };  // [-1, 1)
  std::array<std::size_t, 3> seen{0, 0, 0};  // missed, crossed, grazed
  for (int i = 0; i < 200000; ++i) {
    std::array<ShearedPoint, 4> p;
    std::array<Vector, 4> loop;
    for (std::size_t c = 0; c < 4; ++c) {
      p[c] = {uniform(), uniform(), uniform(), 0};
      loop[c] = {p[c].x, p[c].y, p[c].z};
    }
    const Quad quad{p[0], p[1], p[2], p[3]};
    const QuadCrossings found = patch_crossings(quad, winding(quad));
    const auto expected = reference::patch_crossings(loop, {0, 0, 0}, {0, 0, 1});
    std::array<int, 2> count{0, 0};
    for (const int direction : found.direction)
      if (direction != 0) ++count[direction > 0 ? 0 : 1];
    ASSERT_EQ(count, expected) << "quadrilateral " << i;
    ASSERT_EQ(found.direction[0] + found.direction[1], winding(quad)) << "quadrilateral " << i;
    ++seen[static_cast<std::size_t>(count[0] + count[1])];
  }
  for (const std::size_t often : seen) EXPECT_GT(often, 5000u);
}

}  // namespace
}  // namespace plume::test
