#include <cstddef>

#include "plume/lib/camera.h"
#include "plume/traverse/frame_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plume/lib/pixel_rays.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

// PixelRays::operator(), operation by operation, for sixteen pixels at once.
HWY_BEFORE_NAMESPACE();
namespace plume {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void SetPixelRays(const PixelLens& lens, const double* x, const double* y, RayLanes& rays) {
  const HWY_CAPPED(double, 8) d;
  using V = hn::Vec<decltype(d)>;
  auto of = [&](double value) HWY_ATTR { return hn::Set(d, value); };
  const V one = of(1), two = of(2);
  for (std::size_t i = 0; i < RayLanes::kRays; i += hn::Lanes(d)) {
    const V along = hn::Div(hn::Mul(two, hn::LoadU(d, x + i)), of(lens.pixels_x));
    const V down = hn::Div(hn::Mul(two, hn::LoadU(d, y + i)), of(lens.pixels_y));
    const V across =
        hn::Mul(hn::Add(hn::Sub(along, one), of(lens.window_center[0])), of(lens.half_width));
    const V upward =
        hn::Mul(hn::Add(hn::Sub(one, down), of(lens.window_center[1])), of(lens.half_height));
    auto place = [&](const std::array<double, 3>& from, std::size_t axis) HWY_ATTR {
      const V beside = hn::Add(of(from[axis]), hn::Mul(across, of(lens.right[axis])));
      return hn::Add(beside, hn::Mul(upward, of(lens.up[axis])));
    };
    if (lens.parallel) {
      for (std::size_t a = 0; a < 3; ++a) {
        hn::Store(place(lens.position, a), d, rays.origin[a] + i);
        hn::Store(of(lens.forward[a]), d, rays.direction[a] + i);
      }
      continue;
    }
    const V d0 = place(lens.forward, 0), d1 = place(lens.forward, 1), d2 = place(lens.forward, 2);
    const V length2 = hn::Add(hn::Add(hn::Mul(d0, d0), hn::Mul(d1, d1)), hn::Mul(d2, d2));
    const V scale = hn::Div(one, hn::Sqrt(length2));
    hn::Store(hn::Mul(d0, scale), d, rays.direction[0] + i);
    hn::Store(hn::Mul(d1, scale), d, rays.direction[1] + i);
    hn::Store(hn::Mul(d2, scale), d, rays.direction[2] + i);
    for (std::size_t a = 0; a < 3; ++a) hn::Store(of(lens.position[a]), d, rays.origin[a] + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace plume
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace plume {

HWY_EXPORT(SetPixelRays);

void PixelRays::set(RayLanes& rays, const std::array<double, 16>& x,
                    const std::array<double, 16>& y, std::size_t size) const {
  static_assert(RayLanes::kRays == 16);
  HWY_DYNAMIC_DISPATCH(SetPixelRays)(lens_, x.data(), y.data(), rays);
  rays.size = size;
}

}  // namespace plume
#endif  // HWY_ONCE
