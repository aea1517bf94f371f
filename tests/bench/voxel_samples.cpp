// Resampling onto a regular grid once, then fixed steps through its voxels.

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>

#include "plume/tests/bench/embree_locator.h"
#include "plume/tests/bench/fixed_step.h"
#include "plume/tests/bench/peer.h"

namespace plume::bench {
namespace {

class Voxels {
 public:
  /// `along` points along the longest side of the bounds, and as far apart along the others.
  Voxels(const PeerScene& scene, const EmbreeLocator& locator, int along) : low_(scene.bounds.low) {
    double longest = 0;
    for (std::size_t a = 0; a < 3; ++a)
      longest = std::fmax(longest, scene.bounds.high[a] - low_[a]);
    for (std::size_t a = 0; a < 3; ++a) {
      const double length = scene.bounds.high[a] - low_[a];
      points_[a] = std::max(1L, std::lround(length / longest * (along - 1))) + 1;
      spacing_[a] = length / static_cast<double>(points_[a] - 1);
    }
    step_ = longest / (along - 1);
    values_.resize(static_cast<std::size_t>(points_[0] * points_[1] * points_[2]));
    tbb::parallel_for(0L, points_[2], [&](long k) {
      EmbreeLocator::Sampler sampler(locator);
      for (long j = 0; j < points_[1]; ++j)
        for (long i = 0; i < points_[0]; ++i)
          values_[index(i, j, k)] = sampler({coordinate(0, i), coordinate(1, j), coordinate(2, k)});
    });
  }

  double step() const { return step_; }

  /// Trilinear; NaN where one of the eight points is outside of the mesh.
  float operator()(const std::array<double, 3>& place) const {
    long at[3];
    float w[3];
    for (std::size_t a = 0; a < 3; ++a) {
      const double x = (place[a] - low_[a]) / spacing_[a];
      at[a] = std::clamp(static_cast<long>(x), 0L, points_[a] - 2);
      w[a] = static_cast<float>(x - static_cast<double>(at[a]));
    }
    const float* corner = &values_[index(at[0], at[1], at[2])];
    const long row = points_[0], slice = points_[0] * points_[1];
    const auto along_x = [&](const float* pair) { return pair[0] + w[0] * (pair[1] - pair[0]); };
    const auto in_plane = [&](const float* four) {
      const float near = along_x(four), far = along_x(four + row);
      return near + w[1] * (far - near);
    };
    const float near = in_plane(corner), far = in_plane(corner + slice);
    return near + w[2] * (far - near);
  }

 private:
  std::size_t index(long i, long j, long k) const {
    return static_cast<std::size_t>(i + points_[0] * (j + points_[1] * k));
  }
  // The last is on the bounds, not beyond.
  double coordinate(std::size_t axis, long i) const {
    return low_[axis] + spacing_[axis] * static_cast<double>(i);
  }

  std::array<double, 3> low_, spacing_;
  double step_;
  std::array<long, 3> points_;
  std::vector<float> values_;
};

}  // namespace

std::vector<PeerWay> voxel_ways(const PeerScene& scene, bool quick) {
  const EmbreeLocator locator(scene.tetrahedra);
  const auto knots = std::make_shared<const KnotTable>(scene.transfer_function);
  std::vector<PeerWay> ways;
  for (const int along : quick ? std::vector<int>{32, 128} : std::vector<int>{64, 128, 256, 512}) {
    const auto voxels = std::make_shared<const Voxels>(scene, locator, along);
    const auto picture = std::make_shared<Image>();
    ways.push_back({"fixed-step resampling",
                    fmt::format("{} points along: step 1/2 voxel{}", along, scene.on_tetrahedra()),
                    [&scene, knots, voxels, picture] {
                      *picture = march(scene, *knots, 0.5 * voxels->step(), [&voxels] {
                        return
                            [v = voxels.get()](const std::array<double, 3>& p) { return (*v)(p); };
                      });
                    },
                    [picture] { return *picture; }});
  }
  return ways;
}

}  // namespace plume::bench
