/// What tests of pictures through the hierarchy of cells share.
#pragma once

#include <cstring>
#include <utility>
#include <vector>

#include "plume/lib/make_tiles.h"
#include "plume/lib/plume.h"
#include "plume/lib/tiles.h"
#include "plume/preint/integrator.h"

namespace plume::test {

/// Bits, as NaN is equal to nothing.
inline bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// Through the hierarchy, whether that pays or not.
inline RenderResult search(const Scene& scene, const Camera& camera,
                           const RenderSettings& settings) {
  RenderResult result;
  Frame frame(scene, camera, settings);
  const Integrator integrator = make_integrator(scene.transfer_function(), settings.integrator);
  const auto maker = searched_tiles(frame, integrator);
  make_tiles(frame, *maker, {}, result.statistics);
  frame.shade_raw(result.statistics);
  result.image = std::move(frame.image());
  return result;
}

}  // namespace plume::test
