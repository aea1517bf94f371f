#include "cell_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plume::reference {
namespace {

Point3 minus(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point3 plus(const Point3& a, const Point3& b, double share) {
  return {a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]};
}
double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point3& a) { return std::sqrt(dot(a, a)); }

// All relative to the place.
double solid_angle(const Point3& a, const Point3& b, const Point3& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  return 2 * std::atan2(dot(a, cross(b, c)),
                        la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

double to_edge(const Point3& a, const Point3& b) {
  const Point3 way = minus(b, a);
  const double length2 = dot(way, way);
  const double share = length2 > 0 ? std::clamp(-dot(a, way) / length2, 0.0, 1.0) : 0;
  return length(plus(a, way, share));
}

double to_triangle(const Point3& a, const Point3& b, const Point3& c) {
  const double to_edges = std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
  const Point3 normal = cross(minus(b, a), minus(c, a));
  const double area = length(normal);
  if (!(area > 0)) return to_edges;
  const double height = dot(a, normal) / area;
  const Point3 foot{height * normal[0] / area, height * normal[1] / area,
                    height * normal[2] / area};
  auto left = [&](const Point3& p, const Point3& q) {
    return dot(cross(minus(q, p), minus(foot, p)), normal) >= 0;
  };
  return left(a, b) && left(b, c) && left(c, a) ? std::abs(height) : to_edges;
}

Point3 on_patch(const std::vector<Point3>& p, double u, double v) {
  Point3 at;
  for (std::size_t a = 0; a < 3; ++a)
    at[a] = (1 - u) * (1 - v) * p[0][a] + u * (1 - v) * p[1][a] + u * v * p[2][a] +
            (1 - u) * v * p[3][a];
  return at;
}

// Gauss and Newton's method from nine places of the patch, kept inside of it.
double to_patch(const std::vector<Point3>& p) {
  double nearest = std::min(
      {to_edge(p[0], p[1]), to_edge(p[1], p[2]), to_edge(p[2], p[3]), to_edge(p[3], p[0])});
  for (int start = 0; start < 9; ++start) {
    double u = 0.5 * (start % 3), v = 0.5 * static_cast<int>(start / 3);
    for (int step = 0; step < 30; ++step) {
      const Point3 at = on_patch(p, u, v);
      const Point3 along_u = minus(on_patch(p, 1, v), on_patch(p, 0, v));
      const Point3 along_v = minus(on_patch(p, u, 1), on_patch(p, u, 0));
      const double uu = dot(along_u, along_u), uv = dot(along_u, along_v);
      const double vv = dot(along_v, along_v), det = uu * vv - uv * uv;
      nearest = std::min(nearest, length(at));
      if (!(det > 0)) break;
      const double by_u = dot(at, along_u), by_v = dot(at, along_v);
      const double next_u = std::clamp(u - (vv * by_u - uv * by_v) / det, 0.0, 1.0);
      const double next_v = std::clamp(v - (uu * by_v - uv * by_u) / det, 0.0, 1.0);
      if (next_u == u && next_v == v) break;
      u = next_u;
      v = next_v;
    }
    nearest = std::min(nearest, length(on_patch(p, u, v)));
  }
  return nearest;
}

// Of the patch cut into 2 x parts x parts triangles.
double solid_angle(const std::vector<Point3>& p, int parts) {
  double angle = 0;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j) {
      auto corner = [&](int a, int b) {
        return on_patch(p, static_cast<double>(i + a) / parts, static_cast<double>(j + b) / parts);
      };
      angle += solid_angle(corner(0, 0), corner(1, 0), corner(1, 1));
      angle += solid_angle(corner(0, 0), corner(1, 1), corner(0, 1));
    }
  return angle;
}

// The largest distance of a patch from its triangles times the square of `parts`.
double twist(const std::vector<Point3>& p) {
  Point3 by;
  for (std::size_t a = 0; a < 3; ++a) by[a] = p[0][a] - p[1][a] + p[2][a] - p[3][a];
  return 0.25 * length(by);
}

}  // namespace

double distance_outside(const CellLoops& cell, const Point3& place) {
  double angle = 0, nearest = std::numeric_limits<double>::infinity();
  std::vector<Point3> p;
  for (const auto& loop : cell) {
    p.clear();
    for (const Point3& corner : loop) p.push_back(minus(corner, place));
    if (p.size() == 3) {
      angle += solid_angle(p[0], p[1], p[2]);
      nearest = std::min(nearest, to_triangle(p[0], p[1], p[2]));
    } else if (p.size() == 4) {
      constexpr int kParts = 4, kMostParts = 128;
      const double distance = to_patch(p);
      const bool close = distance < 2 * twist(p) / (kParts * kParts);
      angle += solid_angle(p, close ? kMostParts : kParts);
      nearest = std::min(nearest, distance);
    } else {
      Point3 center{0, 0, 0};
      for (const Point3& q : p) center = plus(center, q, 1 / static_cast<double>(p.size()));
      for (std::size_t i = 0; i < p.size(); ++i) {
        const Point3& q = p[(i + 1) % p.size()];
        angle += solid_angle(center, p[i], q);
        nearest = std::min(nearest, to_triangle(center, p[i], q));
      }
    }
  }
  constexpr double kHalf = 6.283185307179586;  // of a whole solid angle
  return std::abs(angle) > kHalf ? 0 : nearest;
}

}  // namespace plume::reference
