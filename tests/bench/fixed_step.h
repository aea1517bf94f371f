/// Ray marching at fixed steps, as most codes do it: what all peers that sample have in common.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "plume/lib/image.h"
#include "plume/tests/bench/peer.h"

namespace plume::bench {

/// A transfer function for quick look-ups: its optics exactly, by an even grid over the scalars
/// that says where to begin looking for the knot below.
class KnotTable {
 public:
  /// Requires !transfer_function.problem().
  explicit KnotTable(const TransferFunction& transfer_function);

  /// Requires a scalar that is a number.
  Optics at(float scalar) const {
    const auto& knots = transfer_function_.knots;
    if (!(scalar > knots.front().scalar)) return knots.front().optics;
    if (!(scalar < knots.back().scalar)) return knots.back().optics;
    const auto bucket = static_cast<std::size_t>((scalar - knots.front().scalar) * per_scalar_);
    std::size_t below = first_[std::min(bucket, first_.size() - 1)];
    while (knots[below + 1].scalar <= scalar) ++below;
    while (knots[below].scalar > scalar) --below;
    const auto &a = knots[below], &b = knots[below + 1];
    const float w = (scalar - a.scalar) / (b.scalar - a.scalar);
    Optics optics;
    optics.extinction = a.optics.extinction + w * (b.optics.extinction - a.optics.extinction);
    for (std::size_t c = 0; c < 3; ++c)
      optics.color[c] = a.optics.color[c] + w * (b.optics.color[c] - a.optics.color[c]);
    return optics;
  }

 private:
  TransferFunction transfer_function_;
  float per_scalar_ = 0;
  std::vector<std::size_t> first_;
};

/// Where a ray is inside of the bounds: from t[0] to t[1]; nowhere where t[0] >= t[1].
std::array<double, 2> inside_of(const Bounds& bounds, const Ray& ray);

/// The steps that are tried, in cells' sizes.
std::vector<double> tried_steps(bool quick);
/// "step 1/4 cell".
std::string step_name(double step);

/// The picture by samples in the middles of steps that are as long as `step` or a little shorter,
/// so that a whole number of them fills the ray's part inside of the bounds. Each is taken as
/// homogeneous: T = exp(-extinction * length). Rays are followed to their end.
///
/// `make_sampler()` makes one sampler for each row of the picture; `sampler(place)` is the scalar
/// there, NaN outside of the mesh.
template <class MakeSampler>
Image march(const PeerScene& scene, const KnotTable& knots, double step,
            MakeSampler&& make_sampler) {
  Image image = empty_picture(scene.size);
  const auto side = static_cast<std::size_t>(scene.size);
  const PixelRays rays(scene.camera, scene.size, scene.size);
  const auto row = [&](std::size_t y) {
    auto sampler = make_sampler();
    for (std::size_t x = 0; x < side; ++x) {
      const Ray ray = rays(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      const std::array<double, 2> t = inside_of(scene.bounds, ray);
      if (!(t[0] < t[1])) continue;
      const double count = std::ceil((t[1] - t[0]) / step), length = (t[1] - t[0]) / count;
      float seen_through = 1, color[3] = {0, 0, 0};
      for (double i = 0.5; i < count; ++i) {
        const double at = t[0] + i * length;
        const float scalar =
            sampler({ray.origin[0] + at * ray.direction[0], ray.origin[1] + at * ray.direction[1],
                     ray.origin[2] + at * ray.direction[2]});
        if (std::isnan(scalar)) continue;
        const Optics optics = knots.at(scalar);
        const float through = std::exp(-optics.extinction * static_cast<float>(length));
        for (std::size_t c = 0; c < 3; ++c)
          color[c] += seen_through * (1 - through) * optics.color[c];
        seen_through *= through;
      }
      float* rgba = &image.rgba[4 * (y * side + x)];
      std::copy_n(color, 3, rgba);
      rgba[3] = 1 - seen_through;
    }
  };
  tbb::task_arena arena(scene.threads);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, side, row); });
  return image;
}

/// A way for each step that is tried. The method is `how` and the step.
template <class MakeSampler>
std::vector<PeerWay> marching_ways(const PeerScene& scene, const std::string& family,
                                   const std::string& how, bool quick, MakeSampler make_sampler) {
  std::vector<PeerWay> ways;
  const auto knots = std::make_shared<const KnotTable>(scene.transfer_function);
  for (const double step : tried_steps(quick)) {
    const auto picture = std::make_shared<Image>();
    ways.push_back({family, how + step_name(step),
                    [&scene, knots, step, make_sampler, picture] {
                      *picture = march(scene, *knots, step * scene.cell_size, make_sampler);
                    },
                    [picture] { return *picture; }});
  }
  return ways;
}

}  // namespace plume::bench
