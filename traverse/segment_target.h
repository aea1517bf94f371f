/// What bundles of rays do with cells that may hold scalars that matter.
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

/// A target says which cells matter (windows(), and for each ray limits(): a cell whose key is not
/// below that does not), and takes those that the rays go through. Keys are here where a cell
/// begins along the ray, z * sign. `Cells` says how rays pass through them: TetCells, AnyCells.
template <class Cells>
class SegmentTarget {
 public:
  static constexpr CellKey kKey = CellKey::place;

  SegmentTarget(const Cells& cells, const SoughtSegments& sought, const RayBundle& bundle,
                std::span<SearchedRay> found)
      : cells_(cells), sought_(sought), bundle_(bundle), found_(found) {
    limits_.fill(-kInfinity);
    std::fill_n(limits_.begin(), bundle.size(), kInfinity);
    lasts_.fill(std::numeric_limits<double>::infinity());
    lengths_.fill(0);
    // Half of it, for all rounding.
    if (std::isfinite(sought.greatest_extinction))
      enough_length_ = -0.5 * std::log(sought.least_transmittance) / sought.greatest_extinction;
    transmittances_.fill(1);
    for (std::size_t ray = 0; ray < bundle.size(); ++ray) found[ray].clear();
  }

  std::span<const ScalarWindow> windows() const { return sought_.windows; }
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
    auto pass = [&](const CellCrossing& in, const CellCrossing& out, const auto& is_clear) {
      ray.count();
      const double t_in = frame.t(in.place.z), t_out = frame.t(out.place.z);
      if (!(t_in <= t_out)) return false;
      if (!matters(in.place.scalar, out.place.scalar)) return true;
      ray.add({{t_in, t_out, in.place.scalar, out.place.scalar, cells_.number_of(cell)},
               in.place.z,
               out.place.z,
               -1,
               {in.face, in.rank},
               {out.face, out.rank},
               is_clear()});
      if (sought_.opacity) hide(index);
      return true;
    };
    if (!cells_.pass_through(cell, frame, pass)) ray.decline();
    if (ray.declined()) set_limit(index, -kInfinity);
  }

  /// The ray may cross a face at the boundary: the number of one in the mesh's list.
  void cross_boundary(std::size_t index, std::uint32_t face) {
    if constexpr (Cells::kFacesAreCrossed)
      found_[index].meet_boundary(face);
    else
      cells_.cross_boundary(face, bundle_.frame(index), found_[index]);
    if (found_[index].declined()) set_limit(index, -kInfinity);
  }

  void finish(const SearchedRay::Gaps& gaps) {
    const auto differ = [this](float a, float b) { return matters(a, b); };
    for (std::size_t index = 0; index < bundle_.size(); ++index) {
      SearchedRay& ray = found_[index];
      // Where on its way in and out a ray is that has nothing to show, nobody asks.
      if (Cells::kFacesAreCrossed && ray.passes_once()) continue;
      for (const std::uint32_t face : ray.boundary_faces())
        cells_.cross_boundary(face, bundle_.frame(index), ray);
      ray.finish(bundle_.ray(index), lasts_[index], gaps, differ);
      if (!ray.declined() && !is_walked_to(index)) ray.decline();
    }
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  bool matters(float a, float b) const {
    if (!std::isfinite(a) || !std::isfinite(b)) return false;
    const float low = std::min(a, b), high = std::max(a, b);
    for (const ScalarWindow& window : sought_.windows)
      if (low < window.below && high >= window.from) return true;
    return false;
  }

  // What was found last may hide what lies behind it.
  void hide(std::size_t index) {
    SearchedRay& ray = found_[index];
    double& transmittance = transmittances_[index];
    if (lengths_[index] < enough_length_) {
      const FoundSegment& found = ray.segments().back();
      lengths_[index] += found.t_out - found.t_in;
      if (lengths_[index] < enough_length_) return;
      for (FoundSegment& segment : ray.segments()) transmittance *= 1 - ask(segment);
    } else {
      transmittance *= 1 - ask(ray.segments().back());
    }
    if (transmittance > sought_.least_transmittance) return;
    transmittance = ray.drop_hidden(sought_.least_transmittance);
    const FoundSegment& last = ray.segments().back();
    lasts_[index] = last.t_out;
    // What begins at the same place still matters.
    set_limit(index, std::nextafter(static_cast<float>(last.z_out * bundle_.sign()), kInfinity));
  }
  double ask(FoundSegment& segment) const { return segment.opacity = sought_.opacity(segment); }

  // Whether a walk would come into each cell where the ray was found to. Into one that follows
  // another it does if it does there.
  bool is_walked_to(std::size_t index) {
    const std::span<FoundSegment> segments = found_[index].segments();
    for (std::size_t s = 0; s < segments.size(); ++s) {
      segments[s].follows = s > 0 && segments[s - 1].t_out == segments[s].t_in &&
                            cells_.joins(segments[s - 1], segments[s]);
      if (segments[s].follows) continue;
      // Of two that begin and end at one place it is not known which comes first.
      if (s > 0 && segments[s - 1].t_in == segments[s].t_out) return false;
      if (!cells_.comes_from_before(segments[s], bundle_.ray(index), bundle_.frame(index)))
        return false;
    }
    return true;
  }

  void set_limit(std::size_t index, float limit) {
    limits_changed_ = limits_changed_ || limits_[index] == limit_;
    limits_[index] = limit;
  }

  const Cells& cells_;
  const SoughtSegments& sought_;
  const RayBundle& bundle_;
  std::span<SearchedRay> found_;
  alignas(64) std::array<float, RayBundle::kRays> limits_;
  mutable bool limits_changed_ = false;
  mutable float limit_ = kInfinity;
  double enough_length_ = 0;  // shorter ones together cannot hide enough
  std::array<double, RayBundle::kRays> lasts_, transmittances_, lengths_;
};

}  // namespace plume
