// Where rays meet triangles, against all triangles one by one in double.

#include "plume/traverse/opaque_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace plume::test {
namespace {

using Point = std::array<double, 3>;

// Moeller and Trumbore's test, with `inside` as the least of the three weights that still counts.
std::optional<double> hit_one(const Ray& ray, const Point& a, const Point& b, const Point& c,
                              double inside) {
  auto minus = [](const Point& p, const Point& q) {
    return Point{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  };
  auto cross = [](const Point& p, const Point& q) {
    return Point{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  };
  auto dot = [](const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; };
  const Point u = minus(b, a), v = minus(c, a), p = cross(ray.direction, v);
  const double determinant = dot(u, p);
  if (determinant == 0) return std::nullopt;
  const Point s = minus(ray.origin, a), q = cross(s, u);
  const double x = dot(s, p) / determinant, y = dot(ray.direction, q) / determinant;
  if (std::min({x, y, 1 - x - y}) < inside) return std::nullopt;
  return dot(v, q) / determinant;
}

struct Soup {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Soup random_soup(std::mt19937_64& random, const Point& center, double size) {
  std::uniform_real_distribution<double> near(-1, 1);
  Soup soup;
  for (std::uint32_t i = 0; i < 60; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      Point point;
      for (std::size_t a = 0; a < 3; ++a) point[a] = center[a] + size * near(random);
      soup.points.push_back(point);
    }
    soup.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

TEST(OpaqueTriangles, MeetTheNearestOfAllTriangles) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> near(-1, 1);
  for (const auto& [center, size] : {std::pair{Point{0, 0, 0}, 1.0},
                                     {Point{1e7, -2e7, 3}, 1.0},
                                     {Point{0, 0, 0}, 1e-9},
                                     {Point{3, 4, 5}, 1e9}}) {
    SCOPED_TRACE(size);
    const Soup soup = random_soup(random, center, size);
    const OpaqueTriangles index(soup.points, soup.triangles);
    // Of what a far-away coordinate can tell.
    const double rounding = 1e-6 * size + 1e-15 * 1e8 * (center[0] > 1e6 ? 1 : 0);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
      Ray ray;
      double length = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        ray.direction[a] = near(random);
        length += ray.direction[a] * ray.direction[a];
        ray.origin[a] = center[a] + 100 * size * near(random) * (i % 2);
      }
      for (double& d : ray.direction) d /= std::sqrt(length);
      if (i % 2 == 1)  // from afar towards the middle
        for (std::size_t a = 0; a < 3; ++a) {
          const double distance = std::hypot(ray.origin[0] - center[0], ray.origin[1] - center[1],
                                             ray.origin[2] - center[2]);
          ray.direction[a] = (center[a] + 0.3 * size * near(random) - ray.origin[a]) / distance;
        }
      std::optional<double> surely, perhaps;
      for (const auto& [a, b, c] : soup.triangles) {
        auto take = [&](std::optional<double>& nearest, double inside) {
          const auto t = hit_one(ray, soup.points[a], soup.points[b], soup.points[c], inside);
          if (t && *t >= 0 && (!nearest || *t < *nearest)) nearest = t;
        };
        take(surely, 1e-4);
        take(perhaps, -1e-4);
      }
      const auto found = index.first_hit(ray);
      if (surely) {
        ++hits;
        ASSERT_TRUE(found) << i;
        ASSERT_LE(found->t, *surely + rounding) << i;
      }
      if (found) {
        ASSERT_TRUE(perhaps) << i;
        ASSERT_GE(found->t, *perhaps - rounding) << i;
        Point there{0, 0, 0};
        double weights = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          weights += found->weights[k];
          for (std::size_t a = 0; a < 3; ++a)
            there[a] += found->weights[k] * soup.points[soup.triangles[found->triangle][k]][a];
        }
        ASSERT_NEAR(weights, 1, 1e-12);
        for (std::size_t a = 0; a < 3; ++a)
          ASSERT_NEAR(there[a], ray.origin[a] + found->t * ray.direction[a],
                      2e-5 * size + 1e-7 * std::abs(center[a]) * 1e-1);
        // Nothing is nearer than a range begins, or farther than it ends.
        ray.t_max = 0.99 * found->t;
        ASSERT_TRUE(!index.first_hit(ray) || index.first_hit(ray)->t <= ray.t_max + rounding);
      }
    }
    EXPECT_GT(hits, 1000);
  }
}

TEST(OpaqueTriangles, LetNoRayThroughASharedEdgeOrVertex) {
  // A closed octahedron, from its middle.
  const std::vector<Point> points{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                  {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t x : {0u, 1u})
    for (std::uint32_t y : {2u, 3u})
      for (std::uint32_t z : {4u, 5u}) triangles.push_back({x, y, z});
  const OpaqueTriangles index(points, triangles);
  std::vector<Point> directions = points;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      if (i / 2 != j / 2)
        for (int part = 1; part < 32; ++part) {
          Point direction;
          for (std::size_t a = 0; a < 3; ++a)
            direction[a] = points[i][a] * part / 32 + points[j][a] * (32 - part) / 32;
          directions.push_back(direction);
        }
  for (const Point& direction : directions) {
    const auto hit = index.first_hit({{0, 0, 0}, direction});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, 1, 1e-12);
  }
}

TEST(OpaqueTriangles, WithoutAreaAreNeverMet) {
  const std::vector<Point> points{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 0, 1}};
  const OpaqueTriangles index(points, triangles);
  for (int i = 0; i < 100; ++i)
    EXPECT_FALSE(index.first_hit({{0.02 * i, 0.02 * i, -1}, {0, 0, 1}}));
  EXPECT_FALSE(index.first_hit({{0, 0, -1}, {0, 0, 0}}));
}

}  // namespace
}  // namespace plume::test
