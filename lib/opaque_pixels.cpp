#include "plume/lib/opaque_pixels.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <limits>

#include "plume/lib/frame.h"
#include "plume/lib/scene_body.h"
#include "plume/lib/shading.h"

namespace plume {
namespace {

constexpr std::array<float, 3> kNoColor{-1, -1, -1};

std::array<float, 3> mixed(const std::vector<std::array<float, 3>>& of_points,
                           const std::array<std::uint32_t, 3>& points,
                           const std::array<double, 3>& weights) {
  std::array<float, 3> sum{0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += static_cast<float>(weights[i] * of_points[points[i]][c]);
  return sum;
}

std::array<float, 3> color_at(const SceneSurface& surface, const TriangleHit& hit,
                              const Lighting& lighting, const Ray& ray) {
  const auto& points = surface.index.triangles()[hit.triangle];
  std::array<float, 3> color = surface.color;
  if (!surface.point_colors.empty()) color = mixed(surface.point_colors, points, hit.weights);
  std::array<double, 3> normal = surface.index.normal(hit.triangle);
  if (!surface.point_normals.empty()) {
    const auto smooth = mixed(surface.point_normals, points, hit.weights);
    if (smooth[0] != 0 || smooth[1] != 0 || smooth[2] != 0)
      normal = {smooth[0], smooth[1], smooth[2]};
  }
  const SegmentColor lit =
      shading_of(lighting, normal, ray.direction).applied({color[0], color[1], color[2], 1});
  return {lit.r, lit.g, lit.b};
}

}  // namespace

OpaquePixels find_opaque_pixels(const Frame& frame) {
  OpaquePixels opaque;
  std::vector<const SceneSurface*> surfaces;
  for (const Scene* scene : frame.scenes())
    for (const SceneSurface& surface : scene->body().surfaces) surfaces.push_back(&surface);
  const auto& depth_limit = frame.settings().depth_limit;
  if (surfaces.empty() && depth_limit.empty()) return opaque;
  opaque.limits.assign(frame.pixel_count(), std::numeric_limits<double>::infinity());
  if (!surfaces.empty()) opaque.colors.assign(frame.pixel_count(), kNoColor);
  const Lighting lighting = frame.settings().lighting.value_or(Lighting{});
  const int across = frame.tiles_across();
  auto look = [&](const PixelPlace& pixel) {
    double& limit = opaque.limits[pixel.index];
    Ray ray = frame.ray(pixel);
    if (!depth_limit.empty()) limit = ray.t_max = depth_limit[frame.index_in_picture(pixel)];
    for (const SceneSurface* surface : surfaces)
      if (const auto hit = surface->index.first_hit(ray)) {
        limit = ray.t_max = hit->t;
        opaque.colors[pixel.index] = color_at(*surface, *hit, lighting, ray);
      }
  };
  tbb::parallel_for(tbb::blocked_range<int>(0, across * frame.tiles_down()),
                    [&](const auto& range) {
                      for (int tile = range.begin(); tile != range.end(); ++tile)
                        frame.for_each_pixel({tile % across * kTile, tile / across * kTile}, look);
                    });
  return opaque;
}

}  // namespace plume
