#include "plume/lib/camera.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "plume/mesh/error.h"

namespace plume {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector sum(const Vector& a, double factor, const Vector& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
double length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }
// Zero stays zero.
Vector normalized(const Vector& a) {
  const double l = length(a);
  if (!(l > 0)) return a;
  const double scale = 1 / l;
  return {a[0] * scale, a[1] * scale, a[2] * scale};
}
double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Rodrigues' rotation of `v` around the unit axis.
Vector rotated(const Vector& v, const Vector& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Vector across = cross(axis, v);
  const double along = dot(axis, v) * (1 - c);
  return {c * v[0] + s * across[0] + along * axis[0], c * v[1] + s * across[1] + along * axis[1],
          c * v[2] + s * across[2] + along * axis[2]};
}

const std::vector<std::pair<std::string, Vector>>& views() {
  static const std::vector<std::pair<std::string, Vector>> all{
      {"+x", {1, 0, 0}}, {"-x", {-1, 0, 0}}, {"+y", {0, 1, 0}},    {"-y", {0, -1, 0}},
      {"+z", {0, 0, 1}}, {"-z", {0, 0, -1}}, {"iso", {-1, -1, -1}}};
  return all;
}

}  // namespace

Camera fitted_camera(const Bounds& bounds, const Vector& direction, const Vector& view_up,
                     double aspect_ratio) {
  const Vector forward = normalized(direction);
  if (!(length(forward) > 0) || !std::isfinite(length(forward)))
    throw Error(fmt::format("a camera cannot look along ({}, {}, {})", direction[0], direction[1],
                            direction[2]));
  Camera camera;
  camera.view_up = view_up;
  if (length(view_up) == 0)
    camera.view_up = std::abs(forward[2]) > 0.99 ? Vector{0, 1, 0} : Vector{0, 0, 1};
  camera.focal_point = bounds.center();

  // The least distance, and the least scale, at which every corner of the bounds is seen.
  const Vector right = normalized(cross(forward, camera.view_up));
  const Vector up = cross(right, forward);
  const double slope_y = std::tan(radians(0.5 * camera.view_angle));
  const double slope_x = slope_y * aspect_ratio;
  double distance = 0, scale = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Vector arm;
    for (std::size_t a = 0; a < 3; ++a)
      arm[a] = ((corner >> a & 1) != 0 ? bounds.high[a] : bounds.low[a]) - camera.focal_point[a];
    const double x = std::abs(dot(arm, right)), y = std::abs(dot(arm, up));
    distance = std::fmax(distance, std::fmax(x / slope_x, y / slope_y) - dot(arm, forward));
    scale = std::fmax(scale, std::fmax(x / aspect_ratio, y));
  }
  constexpr double kMargin = 1.05;
  if (!(scale > 0)) scale = distance = 1;  // bounds of a single point, or a line seen end-on
  camera.position = sum(camera.focal_point, -distance * kMargin, forward);
  camera.parallel_scale = scale * kMargin;
  return camera;
}

std::vector<std::string> view_names() {
  std::vector<std::string> names;
  for (const auto& view : views()) names.push_back(view.first);
  return names;
}

Camera named_view(const std::string& name, const Bounds& bounds, double aspect_ratio) {
  for (const auto& [view, direction] : views())
    if (view == name) return fitted_camera(bounds, direction, {0, 0, 0}, aspect_ratio);
  throw Error(fmt::format("no view '{}'; there are: {}", name, fmt::join(view_names(), " ")));
}

void orbit(Camera& camera, double azimuth, double elevation) {
  Vector arm = sum(camera.position, -1, camera.focal_point);
  arm = rotated(arm, normalized(camera.view_up), radians(azimuth));
  const Vector right = normalized(cross(camera.view_up, arm));
  arm = rotated(arm, right, radians(-elevation));
  camera.view_up = rotated(camera.view_up, right, radians(-elevation));
  camera.position = sum(camera.focal_point, 1, arm);
}

void zoom(Camera& camera, double factor) {
  if (!(factor > 0) || !std::isfinite(factor))
    throw Error(fmt::format("a zoom of {}; it must be above 0", factor));
  camera.view_angle /= factor;
  camera.parallel_scale /= factor;
}

PixelRays::PixelRays(const Camera& camera, int width, int height) {
  for (const Vector& v : {camera.position, camera.focal_point, camera.view_up})
    if (!std::isfinite(length(v)))
      throw Error(fmt::format("camera: ({}, {}, {}) is not finite", v[0], v[1], v[2]));
  for (const double center : camera.window_center)
    if (!std::isfinite(center))
      throw Error(fmt::format("camera: the window centre ({}, {}) is not finite",
                              camera.window_center[0], camera.window_center[1]));
  lens_.forward = normalized(sum(camera.focal_point, -1, camera.position));
  if (!(length(lens_.forward) > 0))
    throw Error(fmt::format("camera: the position ({}, {}, {}) is the focal point",
                            camera.position[0], camera.position[1], camera.position[2]));
  lens_.right = cross(lens_.forward, normalized(camera.view_up));
  if (!(length(lens_.right) > 1e-9))
    throw Error(fmt::format("camera: view up ({}, {}, {}) lies along the line of sight",
                            camera.view_up[0], camera.view_up[1], camera.view_up[2]));
  lens_.right = normalized(lens_.right);
  lens_.up = cross(lens_.right, lens_.forward);
  if (camera.parallel) {
    if (!(camera.parallel_scale > 0) || !std::isfinite(camera.parallel_scale))
      throw Error(
          fmt::format("camera: a parallel scale of {}; it must be above 0", camera.parallel_scale));
    lens_.half_height = camera.parallel_scale;
  } else {
    if (!(camera.view_angle > 0 && camera.view_angle < 180))
      throw Error(fmt::format("camera: a view angle of {} degrees; it must be between 0 and 180",
                              camera.view_angle));
    lens_.half_height = std::tan(radians(0.5 * camera.view_angle));
  }
  lens_.pixels_x = width;
  lens_.pixels_y = height;
  lens_.half_width = lens_.half_height * lens_.pixels_x / lens_.pixels_y;
  lens_.position = camera.position;
  lens_.window_center = camera.window_center;
  lens_.parallel = camera.parallel;
}

Ray PixelRays::operator()(double x, double y) const {
  const double across = (2 * x / lens_.pixels_x - 1 + lens_.window_center[0]) * lens_.half_width;
  const double upward = (1 - 2 * y / lens_.pixels_y + lens_.window_center[1]) * lens_.half_height;
  Ray ray;
  if (lens_.parallel) {
    ray.origin = sum(sum(lens_.position, across, lens_.right), upward, lens_.up);
    ray.direction = lens_.forward;
  } else {
    ray.origin = lens_.position;
    // At least as long as `lens_.forward`, which is 1: squares neither underflow nor need care.
    const Vector d = sum(sum(lens_.forward, across, lens_.right), upward, lens_.up);
    const double scale = 1 / std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    ray.direction = {d[0] * scale, d[1] * scale, d[2] * scale};
  }
  return ray;
}

}  // namespace plume
