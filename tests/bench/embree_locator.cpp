#include "plume/tests/bench/embree_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plume/mesh/error.h"
#include "plume/tests/bench/fixed_step.h"
#include "plume/tests/bench/peer.h"

namespace plume::bench {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

struct EmbreeLocator::Query {
  const EmbreeLocator& locator;
  const Vector& place;
  bool found = false;
  std::uint32_t cell = 0;
  float scalar = std::numeric_limits<float>::quiet_NaN();
};

EmbreeLocator::EmbreeLocator(const Mesh& tetrahedra) {
  const std::size_t points = tetrahedra.points.size() / 3;
  const std::size_t cells = tetrahedra.cells.connectivity.size() / 4;
  points_.resize(points);
  tetrahedra.points.visit([&](auto values) {
    for (std::size_t i = 0; i < points; ++i)
      for (std::size_t a = 0; a < 3; ++a) points_[i][a] = static_cast<double>(values[3 * i + a]);
  });
  tetrahedra.fields.front().values.visit([&](auto values) {
    for (std::size_t i = 0; i < points; ++i) points_[i][3] = static_cast<double>(values[i]);
  });
  cells_.resize(cells);
  tetrahedra.cells.connectivity.visit([&](auto values) {
    for (std::size_t i = 0; i < cells; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        cells_[i][k] = static_cast<std::uint32_t>(values[4 * i + k]);
  });

  device_.reset(rtcNewDevice(nullptr));
  if (!device_) throw Error("Embree cannot be started");
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(cells));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* args) {
        const auto& self = *static_cast<const EmbreeLocator*>(args->geometryUserPtr);
        float low[3], high[3];
        for (std::size_t a = 0; a < 3; ++a) {
          double least = std::numeric_limits<double>::infinity(), most = -least;
          for (const std::uint32_t point : self.cells_[args->primID]) {
            least = std::min(least, self.points_[point][a]);
            most = std::max(most, self.points_[point][a]);
          }
          // Wide enough for the corners and for the place of a query, both rounded to float.
          const double wider = 2.4e-7 * std::max(std::abs(least), std::abs(most));
          low[a] = static_cast<float>(least - wider);
          high[a] = static_cast<float>(most + wider);
        }
        *args->bounds_o = {low[0], low[1], low[2], 0, high[0], high[1], high[2], 0};
      },
      nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE)
    throw Error("Embree cannot index the tetrahedra");
}

bool EmbreeLocator::inside(std::uint32_t cell, const Vector& place, float& scalar) const {
  const auto& corners = cells_[cell];
  const Corner& origin = points_[corners[0]];
  const auto from_origin = [&](const auto& point) {
    return Vector{point[0] - origin[0], point[1] - origin[1], point[2] - origin[2]};
  };
  const Corner &p1 = points_[corners[1]], &p2 = points_[corners[2]], &p3 = points_[corners[3]];
  const Vector a = from_origin(p1), b = from_origin(p2), c = from_origin(p3);
  const Vector p = from_origin(place);
  const Vector bc = cross(b, c);
  double volume = dot(a, bc);
  double u = dot(p, bc);
  const Vector pa = cross(a, p);  // v = p . (c x a) = c . (a x p); w = p . (a x b) = -b . (a x p)
  double v = dot(c, pa), w = -dot(b, pa);
  if (volume < 0) volume = -volume, u = -u, v = -v, w = -w;
  if (!(u >= 0 && v >= 0 && w >= 0 && u + v + w <= volume) || volume == 0) return false;
  scalar = static_cast<float>(
      origin[3] +
      (u * (p1[3] - origin[3]) + v * (p2[3] - origin[3]) + w * (p3[3] - origin[3])) / volume);
  return true;
}

float EmbreeLocator::Sampler::operator()(const Vector& place) {
  float scalar = 0;
  if (locator_->inside(last_, place, scalar)) return scalar;
  EmbreeLocator::Query asked{*locator_, place};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  RTCPointQuery query{};
  query.x = static_cast<float>(place[0]);
  query.y = static_cast<float>(place[1]);
  query.z = static_cast<float>(place[2]);
  query.radius = 0;
  rtcPointQuery(
      locator_->scene_.get(), &query, &context,
      [](RTCPointQueryFunctionArguments* args) {
        auto& wanted = *static_cast<EmbreeLocator::Query*>(args->userPtr);
        if (!wanted.found && wanted.locator.inside(args->primID, wanted.place, wanted.scalar)) {
          wanted.found = true;
          wanted.cell = args->primID;
        }
        return false;  // the radius has not changed
      },
      &asked);
  if (asked.found) last_ = asked.cell;
  return asked.scalar;
}

std::vector<PeerWay> embree_ways(const PeerScene& scene, bool quick) {
  const auto locator = std::make_shared<const EmbreeLocator>(scene.tetrahedra);
  return marching_ways(scene, "Embree fixed step", "point queries" + scene.on_tetrahedra() + ": ",
                       quick, [locator] { return EmbreeLocator::Sampler(*locator); });
}

}  // namespace plume::bench
