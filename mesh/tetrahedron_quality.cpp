#include "plume/mesh/tetrahedron_quality.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace plume {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }

// Each edge, and the other two points.
constexpr std::size_t kEdges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                                      {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};

}  // namespace

TetrahedronQuality quality_of(const std::array<Vector, 4>& points) {
  const Vector u = minus(points[1], points[0]), v = minus(points[2], points[0]),
               w = minus(points[3], points[0]);
  const Vector vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const double six_volumes = dot(u, vw);
  Vector to_center{};  // from the first point, times twice the six volumes
  for (std::size_t a = 0; a < 3; ++a)
    to_center[a] = dot(u, u) * vw[a] + dot(v, v) * wu[a] + dot(w, w) * uv[a];
  double shortest = std::numeric_limits<double>::infinity(), angle = std::numbers::pi;
  for (const auto& [i, j, k, l] : kEdges) {
    const Vector edge = minus(points[j], points[i]);
    shortest = std::min(shortest, length(edge));
    const Vector a = cross(edge, minus(points[k], points[i]));
    const Vector b = cross(edge, minus(points[l], points[i]));
    angle = std::min(angle, std::atan2(length(cross(a, b)), dot(a, b)));
  }
  return {six_volumes / 6, length(to_center) / (2 * std::abs(six_volumes)) / shortest,
          angle * 180 / std::numbers::pi};
}

}  // namespace plume
