/// What bundles of rays do with cells that may hold an isosurface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "plume/traverse/cell_search.h"
#include "plume/traverse/searched_cells.h"

namespace plume {

/// A target says which cells matter (windows(), and for each ray limits(): a cell whose key is not
/// below that does not), and takes those that the rays go through. Keys are here where a cell
/// begins along the ray, z * sign. `Cells` says how rays pass through them: TetCells, AnyCells.
template <class Cells>
class IsosurfaceTarget {
 public:
  static constexpr CellKey kKey = CellKey::place;

  IsosurfaceTarget(const Cells& cells, std::span<const SoughtIsovalue> isovalues,
                   const RayBundle& bundle, std::span<SearchedRay> found)
      : cells_(cells), isovalues_(isovalues), bundle_(bundle), found_(found) {
    for (const SoughtIsovalue& sought : isovalues) windows_.push_back({sought.value, sought.value});
    limits_.fill(-kInfinity);
    std::fill_n(limits_.begin(), bundle.size(), kInfinity);
    lasts_.fill(std::numeric_limits<double>::infinity());
    for (std::size_t ray = 0; ray < bundle.size(); ++ray) found[ray].clear();
  }

  std::span<const ScalarWindow> windows() const { return windows_; }
  const float* limits() const { return limits_.data(); }
  /// The greatest of them, or more.
  float limit() const {
    if (limits_changed_) limit_ = *std::max_element(limits_.begin(), limits_.end());
    limits_changed_ = false;
    return limit_;
  }

  /// The ray may go through the cell.
  void go_through(std::size_t index, const typename Cells::Cell& cell) {
    const ShearedFrame& frame = bundle_.frame(index);
    SearchedRay& ray = found_[index];
    auto pass = [&](const Crossing& in, const Crossing& out, const auto& comes_from_before) {
      ray.count();
      const double t_in = frame.t(in.z), t_out = frame.t(out.z);
      if (!(t_in <= t_out)) return false;
      const Between between = crossed(in.scalar, out.scalar);
      if (!between.any) return true;
      if (!comes_from_before()) return false;
      ray.add({t_in, t_out, in.scalar, out.scalar, cells_.number_of(cell)});
      if (between.opaque && t_out < lasts_[index]) {
        lasts_[index] = t_out;
        // What begins at the same place still matters.
        set_limit(index, std::nextafter(static_cast<float>(out.z * frame.sign()), kInfinity));
      }
      return true;
    };
    if (!cells_.pass_through(cell, bundle_.ray(index), frame, pass)) ray.decline();
    if (ray.declined()) set_limit(index, -kInfinity);
  }

  /// The ray may cross a face at the boundary: the number of one in the mesh's list.
  void cross_boundary(std::size_t index, std::uint32_t face) {
    cells_.cross_boundary(face, bundle_.frame(index), found_[index]);
    if (found_[index].declined()) set_limit(index, -kInfinity);
  }

  void finish(const SearchedRay::Gaps& gaps) {
    const auto differ = [this](float a, float b) { return crossed(a, b).any; };
    for (std::size_t index = 0; index < bundle_.size(); ++index)
      found_[index].finish(bundle_.ray(index), lasts_[index], gaps, differ);
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  struct Between {
    bool any = false, opaque = false;
  };
  Between crossed(float a, float b) const {
    if (!std::isfinite(a) || !std::isfinite(b)) return {};
    const float low = std::min(a, b), high = std::max(a, b);
    Between between;
    for (const SoughtIsovalue& sought : isovalues_) {
      if (!(low < sought.value && sought.value <= high)) continue;
      between.any = true;
      between.opaque = between.opaque || sought.opaque;
    }
    return between;
  }

  void set_limit(std::size_t index, float limit) {
    limits_changed_ = limits_changed_ || limits_[index] == limit_;
    limits_[index] = limit;
  }

  const Cells& cells_;
  std::span<const SoughtIsovalue> isovalues_;
  const RayBundle& bundle_;
  std::span<SearchedRay> found_;
  std::vector<ScalarWindow> windows_;
  alignas(64) std::array<float, RayBundle::kRays> limits_;
  mutable bool limits_changed_ = false;
  mutable float limit_ = kInfinity;
  std::array<double, RayBundle::kRays> lasts_;
};

}  // namespace plume
