// Viskores' ConnectivityTracer (through ConnectivityProxy, whose header documents it): a walk from
// cell to cell that samples at fixed steps, and bumps rays that it loses at faces.
//
// Debian 12 has no Viskores: this has NOT been compiled or run against the library here, only read
// against its sources (version 1). It looks samples up in a map of kColors entries, without
// interpolation, for one length: alpha is that of one step.

#include <viskores/cont/ArrayHandle.h>
#include <viskores/cont/DataSetBuilderExplicit.h>
#include <viskores/rendering/ConnectivityProxy.h>
#include <viskores/rendering/raytracing/RayOperations.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "plume/tests/bench/fixed_step.h"
#include "plume/tests/bench/peer.h"

namespace plume::bench {
namespace {

constexpr viskores::Id kColors = 4096;

viskores::cont::DataSet data_of(const Mesh& tetrahedra) {
  std::vector<viskores::Vec3f_64> points;
  tetrahedra.points.visit([&](auto values) {
    for (std::size_t p = 0; p + 2 < values.size(); p += 3)
      points.emplace_back(static_cast<double>(values[p]), static_cast<double>(values[p + 1]),
                          static_cast<double>(values[p + 2]));
  });
  std::vector<viskores::Id> ids;
  tetrahedra.cells.connectivity.visit([&](auto values) {
    for (const auto id : values) ids.push_back(static_cast<viskores::Id>(id));
  });
  std::vector<viskores::Float32> scalars;
  tetrahedra.fields.front().values.visit([&](auto values) {
    for (const auto value : values) scalars.push_back(static_cast<float>(value));
  });
  viskores::cont::DataSet data =
      viskores::cont::DataSetBuilderExplicit::Create(points, viskores::CellShapeTagTetra{}, 4, ids);
  data.AddPointField(PeerScene::kField, scalars);
  return data;
}

// The middles of even steps over the knots' range, each for one step along a ray.
viskores::cont::ArrayHandle<viskores::Vec4f_32> colors_of(const TransferFunction& function,
                                                          double step) {
  const float low = function.knots.front().scalar;
  const float width = function.knots.back().scalar - low;
  viskores::cont::ArrayHandle<viskores::Vec4f_32> colors;
  colors.Allocate(kColors);
  auto portal = colors.WritePortal();
  for (viskores::Id i = 0; i < kColors; ++i) {
    const float share = (static_cast<float>(i) + 0.5f) / static_cast<float>(kColors);
    const Optics optics = function.at(low + share * width);
    portal.Set(i, viskores::Vec4f_32(optics.color[0], optics.color[1], optics.color[2],
                                     static_cast<float>(-std::expm1(-optics.extinction * step))));
  }
  return colors;
}

// The rays through the middles of the pixels: its own camera looks through their corners.
viskores::rendering::raytracing::Ray<viskores::Float64> rays_of(const PeerScene& scene) {
  viskores::rendering::raytracing::Ray<viskores::Float64> rays;
  const int count = scene.size * scene.size;
  viskores::rendering::raytracing::RayOperations::Resize(rays, count);
  const PixelRays pixels(scene.camera, scene.size, scene.size);
  auto ox = rays.OriginX.WritePortal(), oy = rays.OriginY.WritePortal();
  auto oz = rays.OriginZ.WritePortal(), dx = rays.DirX.WritePortal();
  auto dy = rays.DirY.WritePortal(), dz = rays.DirZ.WritePortal();
  auto least = rays.MinDistance.WritePortal(), greatest = rays.MaxDistance.WritePortal();
  auto distance = rays.Distance.WritePortal();
  auto hit = rays.HitIdx.WritePortal(), index = rays.PixelIdx.WritePortal();
  for (int pixel = 0; pixel < count; ++pixel) {
    const Ray ray = pixels(pixel % scene.size + 0.5, pixel / scene.size + 0.5);
    ox.Set(pixel, ray.origin[0]);
    oy.Set(pixel, ray.origin[1]);
    oz.Set(pixel, ray.origin[2]);
    dx.Set(pixel, ray.direction[0]);
    dy.Set(pixel, ray.direction[1]);
    dz.Set(pixel, ray.direction[2]);
    least.Set(pixel, 0);
    greatest.Set(pixel, std::numeric_limits<double>::infinity());
    distance.Set(pixel, std::numeric_limits<double>::infinity());
    hit.Set(pixel, -2);  // as its camera leaves it
    index.Set(pixel, pixel);
  }
  rays.Buffers.at(0).InitConst(0);
  return rays;
}

}  // namespace

std::vector<PeerWay> viskores_ways(const PeerScene& scene, bool quick) {
  const viskores::cont::DataSet data = data_of(scene.tetrahedra);
  const auto& knots = scene.transfer_function.knots;
  std::vector<PeerWay> ways;
  for (const double cells : tried_steps(quick)) {
    const double step = cells * scene.cell_size;
    const auto proxy =
        std::make_shared<viskores::rendering::ConnectivityProxy>(data, PeerScene::kField);
    auto colors = colors_of(scene.transfer_function, step);
    proxy->SetSampleDistance(static_cast<viskores::Float32>(step));
    proxy->SetScalarRange(viskores::Range(knots.front().scalar, knots.back().scalar));
    proxy->SetColorMap(colors);
    const auto picture = std::make_shared<Image>();
    ways.push_back({"Viskores",
                    "ConnectivityTracer" + scene.on_tetrahedra() + ": " + step_name(cells),
                    [&scene, proxy, picture] {
                      auto rays = rays_of(scene);
                      proxy->Trace(rays);
                      // What meets the mesh is left, in an order of its own.
                      *picture = empty_picture(scene.size);
                      const auto index = rays.PixelIdx.ReadPortal();
                      const auto rgba = rays.Buffers.at(0).Buffer.ReadPortal();
                      for (viskores::Id ray = 0; ray < rays.NumRays; ++ray)
                        for (viskores::Id c = 0; c < 4; ++c)
                          picture->rgba[static_cast<std::size_t>(4 * index.Get(ray) + c)] =
                              static_cast<float>(rgba.Get(4 * ray + c));
                    },
                    [picture] { return *picture; }});
  }
  return ways;
}

}  // namespace plume::bench
