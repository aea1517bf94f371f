/// Point location by Embree: tetrahedra as boxes, a point query at each place.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "plume/mesh/mesh.h"

namespace plume::bench {

/// Tetrahedra as user geometry. A point query of no radius visits the cells whose boxes hold the
/// place; which holds the place itself, its barycentric coordinates say, computed in double.
class EmbreeLocator {
 public:
  /// Requires PeerScene's tetrahedra. Throws Error where Embree has no memory.
  explicit EmbreeLocator(const Mesh& tetrahedra);

  /// For one thread: the cell of the last sample is looked at first, which saves most queries.
  class Sampler {
   public:
    explicit Sampler(const EmbreeLocator& locator) : locator_(&locator) {}
    /// The scalar, linear in the cell; NaN outside of all cells.
    float operator()(const std::array<double, 3>& place);

   private:
    const EmbreeLocator* locator_;
    std::uint32_t last_ = 0;
  };

 private:
  using Corner = std::array<double, 4>;  // x, y, z, scalar
  struct Query;

  // Whether the place is in the cell, its faces included; then the scalar there.
  bool inside(std::uint32_t cell, const std::array<double, 3>& place, float& scalar) const;

  struct Release {
    void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
    void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
  };
  std::vector<Corner> points_;
  std::vector<std::array<std::uint32_t, 4>> cells_;
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
};

}  // namespace plume::bench
