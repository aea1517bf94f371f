/// Opaque triangles among a volume: where a ray meets the first of them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plume/mesh/local_frame.h"
#include "plume/traverse/ray.h"

namespace plume {

/// Where a ray meets a triangle.
struct TriangleHit {
  double t;  ///< along the ray, in world units
  std::uint32_t triangle;
  /// Of the triangle's three points; their sum is 1.
  std::array<double, 3> weights;
};

/// An index over triangles, through Embree. Immutable; safe to ask from several threads.
///
/// Which triangle is met first is decided by Embree in single precision (robust mode: a ray through
/// an edge that two triangles share meets one of them); where, is then computed in double on that
/// triangle's plane. Single precision is that of a local frame about the triangles: surfaces closer
/// than some 1e-6 of their extent are not told apart.
class OpaqueTriangles {
 public:
  /// Copies both. Requires finite points, and numbers of points that there are. Triangles without
  /// area are never met. Throws Error where Embree has no memory for the index.
  OpaqueTriangles(std::span<const std::array<double, 3>> points,
                  std::span<const std::array<std::uint32_t, 3>> triangles);
  ~OpaqueTriangles();
  OpaqueTriangles(OpaqueTriangles&&) noexcept;
  OpaqueTriangles& operator=(OpaqueTriangles&&) noexcept;

  /// The first triangle between the ray's t_min and t_max, whichever of its sides is seen.
  std::optional<TriangleHit> first_hit(const Ray& ray) const;

  const std::vector<std::array<double, 3>>& points() const { return points_; }
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }
  /// Of the triangles' points.
  const Bounds& bounds() const { return bounds_; }

  /// Across a triangle, by the order of its points; of any length, zero where it has no area.
  std::array<double, 3> normal(std::uint32_t triangle) const;

 private:
  struct Index;

  std::vector<std::array<double, 3>> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  Bounds bounds_;
  LocalFrame frame_;
  std::unique_ptr<Index> index_;
};

}  // namespace plume
