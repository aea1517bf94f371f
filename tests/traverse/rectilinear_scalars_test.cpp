// What the scalar is along a ray through a rectilinear grid, for every order.

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "rectilinear_meshes.h"

namespace plume::test {
namespace {

constexpr ScalarOrder kOrders[] = {ScalarOrder::linear, ScalarOrder::quadratic, ScalarOrder::cubic};

std::vector<Segment> segments_of(const Mesh& mesh, const Ray& ray, ScalarOrder order) {
  const WalkableRectilinear grid = make_walkable_rectilinear(mesh, select_field(mesh));
  const BoundaryIndex<RectilinearWalker> boundary(grid);
  std::vector<Segment> segments;
  auto keep = [&](const Segment& segment) {
    segments.push_back(segment);
    return true;
  };
  trace(grid, boundary, ray, keep, order);
  return segments;
}

// The textbook's trilinear interpolant of a cell, from the user's mesh.
double trilinear(const Mesh& mesh, std::uint32_t cell, const Ray& ray, double t) {
  std::vector<std::uint32_t> ids;
  CellReader(mesh).points(cell, ids);
  // VTK's hexahedron: bits of the corners.
  constexpr unsigned kCorner[8] = {0, 1, 3, 2, 4, 5, 7, 6};
  const Place low = point_at(mesh, ids[0]), high = point_at(mesh, ids[6]);
  long double sum = 0;
  for (std::size_t v = 0; v < 8; ++v) {
    long double weight = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const long double x = ray.origin[a] + static_cast<long double>(t) * ray.direction[a];
      const long double share = (x - low[a]) / (static_cast<long double>(high[a]) - low[a]);
      weight *= (kCorner[v] >> a & 1) != 0 ? share : 1 - share;
    }
    sum += weight * mesh.fields[0].values.at<double>(ids[v]);
  }
  return static_cast<double>(sum);
}

// The polynomial that a segment stands for, at a share of its length: Lagrange's.
double along(const Segment& s, double at) {
  std::vector<double> values{s.s_in};
  for (int i = 1; i < static_cast<int>(s.order); ++i) values.push_back(s.inner[i - 1]);
  values.push_back(s.s_out);
  const double n = static_cast<double>(values.size() - 1);
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double term = values[i];
    for (std::size_t j = 0; j < values.size(); ++j)
      if (j != i)
        term *=
            (at * n - static_cast<double>(j)) / (static_cast<double>(i) - static_cast<double>(j));
    sum += term;
  }
  return sum;
}

const GridCase kCases[] = {{"regular", {5, 5, 5}},
                           {"uneven", {4, 5, 6}, 0.9, 5},
                           {"tiny", {4, 5, 6}, 0.5, 2, 1e-9},
                           {"huge", {4, 5, 6}, 0.5, 2, 1e9},
                           {"shifted", {4, 5, 6}, 0.5, 3, 1, 1e7}};

TEST(RectilinearScalars, AreTheTrilinearInterpolantsAtTheirPlaces) {
  for (const GridCase& c : kCases) {
    const Mesh mesh = rectilinear(c);
    const Bounds bounds = check_structure(mesh);
    RectilinearRays make_ray(mesh, bounds, 4);
    // Where the coordinates are large, the ray's places are rounded.
    const double bound = 3e-7 + 1e-13 * std::abs(c.offset);
    for (std::uint64_t i = 0; i < 600; ++i) {
      Ray ray = make_ray(i);
      if (i % 2 == 1) {  // from inside, to inside
        ray.t_min = (1.7 + 0.001 * static_cast<double>(i % 97)) * bounds.diagonal();
        ray.t_max = ray.t_min + 0.4 * bounds.diagonal();
      }
      for (const ScalarOrder order : kOrders)
        for (const Segment& s : segments_of(mesh, ray, order)) {
          ASSERT_EQ(s.order, order);
          const bool cut = s.t_in == ray.t_min || s.t_out == ray.t_max;
          if (order == ScalarOrder::linear && cut) continue;
          auto expect = [&](double share, float value) {
            ASSERT_NEAR(value, trilinear(mesh, s.cell, ray, s.t_in + share * (s.t_out - s.t_in)),
                        bound)
                << c.name << " ray " << i << " order " << static_cast<int>(order);
          };
          expect(0, s.s_in);
          expect(1, s.s_out);
          if (order == ScalarOrder::quadratic) expect(0.5, s.inner[0]);
          if (order == ScalarOrder::cubic) {
            expect(1.0 / 3, s.inner[0]);
            expect(2.0 / 3, s.inner[1]);
            // Everywhere else too: along a line the interpolant is a cubic.
            for (const double share : {0.1, 0.45, 0.9})
              expect(share, static_cast<float>(along(s, share)));
          }
          if (HasFatalFailure()) return;
        }
    }
  }
}

// Quadratic is the best of its kind: the cubic's own values at the ends and half way.
TEST(RectilinearScalars, OrdersAgreeWhereTheyMeet) {
  const Mesh mesh = rectilinear({"", {6, 5, 4}, 0.7, 6});
  RectilinearRays make_ray(mesh, check_structure(mesh), 14);
  for (std::uint64_t i = 0; i < 600; ++i) {
    const Ray ray = make_ray(i);
    const auto linear = segments_of(mesh, ray, kOrders[0]);
    const auto quadratic = segments_of(mesh, ray, kOrders[1]);
    const auto cubic = segments_of(mesh, ray, kOrders[2]);
    ASSERT_EQ(linear.size(), quadratic.size());
    ASSERT_EQ(linear.size(), cubic.size());
    for (std::size_t s = 0; s < linear.size(); ++s) {
      for (const auto* other : {&quadratic, &cubic}) {
        ASSERT_EQ(linear[s].s_in, (*other)[s].s_in);
        ASSERT_EQ(linear[s].s_out, (*other)[s].s_out);
        ASSERT_EQ(linear[s].t_out, (*other)[s].t_out);
      }
      ASSERT_NEAR(quadratic[s].inner[0], along(cubic[s], 0.5), 1e-6);
    }
  }
}

TEST(RectilinearScalars, NoNumberMakesWhatItTakesPartInNone) {
  Mesh mesh = rectilinear({"", {4, 4, 4}, 0.5, 1});
  const std::uint32_t bad = 2 + 5 * (2 + 5 * 2);
  auto values = mesh.fields[0].values.visit(
      [](auto all) { return std::vector<float>(all.begin(), all.end()); });
  values[bad] = std::numeric_limits<float>::quiet_NaN();
  mesh.fields[0].values = Array::own(std::move(values));
  const CellReader cells(mesh);
  RectilinearRays make_ray(mesh, check_structure(mesh), 4);
  std::size_t found = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Ray ray = make_ray(i);
    const auto segments = segments_of(mesh, ray, ScalarOrder::cubic);
    std::vector<std::uint32_t> before, here;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      before = std::exchange(here, {});
      cells.points(segments[s].cell, here);
      auto holds = [&](const auto& ids) {
        return std::find(ids.begin(), ids.end(), bad) != ids.end();
      };
      ASSERT_EQ(std::isnan(segments[s].inner[0]), holds(here));
      ASSERT_EQ(std::isnan(segments[s].inner[1]), holds(here));
      // A face's points are those of the cells on both sides.
      if (s > 0) {
        ASSERT_EQ(std::isnan(segments[s].s_in), holds(here) && holds(before));
        ASSERT_EQ(std::isnan(segments[s - 1].s_out), holds(here) && holds(before));
      }
      found += holds(here) ? 1 : 0;
    }
  }
  EXPECT_GT(found, 100u);
}

TEST(RectilinearScalars, OfCellsAreConstant) {
  const Mesh mesh = rectilinear({"", {4, 6, 5}, 0.5, 2}, Association::cell);
  RectilinearRays make_ray(mesh, check_structure(mesh), 4);
  for (std::uint64_t i = 0; i < 1000; ++i)
    for (const ScalarOrder order : kOrders) {
      Ray ray = make_ray(i);
      ray.t_min = 2;
      ray.t_max = 3;
      for (const Segment& s : segments_of(mesh, ray, order)) {
        ASSERT_EQ(s.s_in, mesh.fields[0].values.at<float>(s.cell));
        ASSERT_EQ(s.s_out, s.s_in);
        ASSERT_EQ(s.order, ScalarOrder::linear);
      }
    }
}

}  // namespace
}  // namespace plume::test
