#include "plume/traverse/opaque_triangles.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "plume/mesh/error.h"

namespace plume {
namespace {

using Vector = std::array<double, 3>;

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Bounds bounds_of_points(std::span<const Vector> points) {
  if (points.empty()) return {};
  Bounds bounds{points[0], points[0]};
  for (const Vector& point : points)
    for (std::size_t a = 0; a < 3; ++a) {
      bounds.low[a] = std::min(bounds.low[a], point[a]);
      bounds.high[a] = std::max(bounds.high[a], point[a]);
    }
  return bounds;
}

}  // namespace

struct OpaqueTriangles::Index {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Index() = default;
  Index(const Index&) = delete;
  Index& operator=(const Index&) = delete;
  ~Index() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

OpaqueTriangles::OpaqueTriangles(std::span<const Vector> points,
                                 std::span<const std::array<std::uint32_t, 3>> triangles)
    : points_(points.begin(), points.end()),
      triangles_(triangles.begin(), triangles.end()),
      bounds_(bounds_of_points(points_)),
      frame_(LocalFrame::of(bounds_)),
      index_(std::make_unique<Index>()) {
  index_->device = rtcNewDevice(nullptr);
  if (index_->device == nullptr) throw Error("Embree cannot start on this processor");
  index_->scene = rtcNewScene(index_->device);
  rtcSetSceneFlags(index_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(index_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), points_.size()));
  auto* const indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), triangles_.size()));
  if (vertices != nullptr && indices != nullptr) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto local = frame_.local(points_[i][0], points_[i][1], points_[i][2], 0);
      std::copy_n(local.position, 3, vertices + 3 * i);
    }
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      std::copy_n(triangles_[i].begin(), 3, indices + 3 * i);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(index_->scene, geometry);
    rtcCommitScene(index_->scene);
  }
  rtcReleaseGeometry(geometry);
  const RTCError error = rtcGetDeviceError(index_->device);
  if (error != RTC_ERROR_NONE)
    throw Error("Embree could not index the " + std::to_string(triangles_.size()) +
                " triangles of a surface (error " + std::to_string(static_cast<int>(error)) +
                (error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory)" : ")"));
}

OpaqueTriangles::~OpaqueTriangles() = default;
OpaqueTriangles::OpaqueTriangles(OpaqueTriangles&&) noexcept = default;
OpaqueTriangles& OpaqueTriangles::operator=(OpaqueTriangles&&) noexcept = default;

Vector OpaqueTriangles::normal(std::uint32_t triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  return cross(points_[b] - points_[a], points_[c] - points_[a]);
}

std::optional<TriangleHit> OpaqueTriangles::first_hit(const Ray& ray) const {
  // From a sphere around the triangles on, so that a far camera costs no digits.
  const Vector center = frame_.center;
  const double length = std::sqrt(dot(ray.direction, ray.direction));
  if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  const double radius = 0.5 * bounds_.diagonal();
  const double nearest = dot(center - ray.origin, ray.direction) / (length * length);
  const double margin = 1.001 * radius / length + std::numeric_limits<double>::min();
  const double from = std::max(ray.t_min, nearest - margin);
  const double to = std::min(ray.t_max, nearest + margin);
  if (!(from <= to)) return std::nullopt;
  RTCRayHit query{};
  float* const origin = &query.ray.org_x;
  float* const direction = &query.ray.dir_x;
  for (std::size_t a = 0; a < 3; ++a) {
    origin[a] =
        static_cast<float>((ray.origin[a] + from * ray.direction[a] - center[a]) * frame_.scale);
    direction[a] = static_cast<float>(ray.direction[a] / length);
  }
  query.ray.tnear = 0;
  query.ray.tfar = static_cast<float>((to - from) * length * frame_.scale);
  query.ray.mask = 0xFFFFFFFFu;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(index_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const auto& [a, b, c] = triangles_[query.hit.primID];
  const double u = query.hit.u, v = query.hit.v;
  TriangleHit hit{
      from + query.ray.tfar / (frame_.scale * length), query.hit.primID, {1 - u - v, u, v}};
  const Vector across = normal(query.hit.primID);
  const double t = dot(points_[a] - ray.origin, across) / dot(ray.direction, across);
  // Seen edge-on, the plane says nothing.
  if (std::isfinite(t) && std::abs(t - hit.t) <= 1e-5 * radius / length) hit.t = t;
  return hit;
}

}  // namespace plume
