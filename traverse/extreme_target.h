/// What bundles of rays do with cells that may hold the greatest scalar on them, or the least.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "plume/traverse/cell_search.h"
#include "plume/traverse/searched_cells.h"

namespace plume {

/// A target of two passes: over the boundary, which shows the rays that miss the mesh, and over the
/// cells inside. Its keys are the greatest value of a cell times -1, or the least: cells that may
/// have a better one come first, and none follows whose key is not below what was found.
template <class Cells, bool kGreatest>
class ExtremeTarget {
 public:
  static constexpr CellKey kKey = kGreatest ? CellKey::greatest : CellKey::least;

  ExtremeTarget(const Cells& cells, const RayBundle& bundle, std::span<SearchedRay> found)
      : cells_(cells), bundle_(bundle), found_(found) {
    limits_.fill(-kInfinity);
    std::fill_n(limits_.begin(), bundle.size(), kInfinity);
    for (std::size_t ray = 0; ray < bundle.size(); ++ray) found[ray].clear();
  }

  std::span<const ScalarWindow> windows() const { return {}; }
  const float* limits() const { return limits_.data(); }
  float limit() const { return *std::max_element(limits_.begin(), limits_.end()); }

  void go_through(std::size_t index, const typename Cells::Cell& cell) {
    const ShearedFrame& frame = bundle_.frame(index);
    SearchedRay& ray = found_[index];
    auto pass = [&](const CellCrossing& in, const CellCrossing& out, const auto& /*is_clear*/) {
      ray.count();
      if (!(frame.t(in.place.z) <= frame.t(out.place.z))) return false;
      // fmax() passes over NaN.
      const float best = kGreatest ? -std::fmax(in.place.scalar, out.place.scalar)
                                   : std::fmin(in.place.scalar, out.place.scalar);
      limits_[index] = std::fmin(limits_[index], best);
      return true;
    };
    if (cells_.pass_through(cell, frame, pass)) return;
    ray.decline();
    limits_[index] = -kInfinity;
  }

  void cross_boundary(std::size_t index, std::uint32_t face) {
    cells_.cross_boundary(face, bundle_.frame(index), found_[index]);
    if (found_[index].declined()) limits_[index] = -kInfinity;
  }

  /// After the pass over the boundary. Passages that rounding may have overlap are walked.
  void boundary_done() {
    const SearchedRay::Gaps gaps{kSearchRounding / cells_.frame().scale, 0};
    for (std::size_t index = 0; index < bundle_.size(); ++index) {
      found_[index].finish(bundle_.ray(index), kInfinity, gaps, [](float, float) { return true; });
      if (found_[index].declined() || found_[index].entries() == 0) limits_[index] = -kInfinity;
    }
  }

  /// The value of a ray; nothing (an infinite number) where it has none.
  float value(std::size_t index) const {
    if (found_[index].entries() == 0) return kGreatest ? -kInfinity : kInfinity;
    return kGreatest ? -limits_[index] : limits_[index];
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  const Cells& cells_;
  const RayBundle& bundle_;
  std::span<SearchedRay> found_;
  alignas(64) std::array<float, RayBundle::kRays> limits_;
};

}  // namespace plume
